//! One value for each group, without an index that could be out of range.

use crate::services::configuration::Group;

/// One value for each group.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct PerGroup<T> {
    mot: T,
    plan: T,
}

impl<T> PerGroup<T> {
    pub(crate) const fn new(mot: T, plan: T) -> Self {
        Self { mot, plan }
    }

    pub(crate) const fn get(&self, group: Group) -> &T {
        match group {
            Group::Mot => &self.mot,
            Group::Plan => &self.plan,
        }
    }

    pub(crate) const fn get_mut(&mut self, group: Group) -> &mut T {
        match group {
            Group::Mot => &mut self.mot,
            Group::Plan => &mut self.plan,
        }
    }
}
