//! Both requesters, led along a drive side by side.

use mufasa::offloading::requester as implementation;
use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{Action, Parameters, Requester};

use super::fallback::{Followed, Follower, Hold, RequesterRun};
use super::judge::{Judged, is_safe};
use super::sides::{self, Table};
use crate::drive::DriveCycle;

/// The model's requester and the implementation's, each with the verdicts of its side.
pub(super) struct Requesters<'t> {
    model: Follower<Requester>,
    /// Its complaint, where it could not begin.
    implementation: Result<Follower<implementation::Requester<'t>>, String>,
    /// Whether all verdicts were the same.
    same_verdicts: bool,
    alike: bool,
    complaint: Option<String>,
}

impl<'t> Requesters<'t> {
    pub(super) fn new(profile: Profile, parameters: &Parameters, table: &'t mut Table) -> Self {
        let implementation = sides::implementation(profile, parameters, table).map(Follower::new);
        let complaint = implementation.as_ref().err().map(|it| format!("implementation: {it}"));
        Self {
            model: Follower::new(Requester::new(profile, *parameters)),
            implementation,
            same_verdicts: true,
            alike: true,
            complaint,
        }
    }

    /// Leads both through a cycle; what it did to their waiting times, if it is unsafe. After a
    /// complaint nothing is followed.
    pub(super) fn follow(&mut self, made: &DriveCycle, judged: &Judged) -> [Option<Hold>; 2] {
        let (None, Ok(implementation)) = (&self.complaint, &mut self.implementation) else {
            return [None; 2];
        };
        let [model_safe, safe] = [&judged.model, &judged.implementation].map(is_safe);
        let both =
            (self.model.follow(&made.cycle, model_safe), implementation.follow(&made.cycle, safe));
        let (model, followed) = match both {
            (Ok(model), Ok(followed)) => (model, followed),
            (Err(it), _) => {
                self.complaint = Some(format!("model: {it}"));
                return [None; 2];
            }
            (_, Err(it)) => {
                self.complaint = Some(format!("implementation: {it}"));
                return [None; 2];
            }
        };
        let do_same = model == followed && self.model.run() == implementation.run();
        self.same_verdicts &= model_safe == safe;
        self.alike &= do_same;
        if self.same_verdicts && !do_same {
            self.complaint = Some(difference(&made.id, &model, &followed));
        }
        [model.hold, followed.hold]
    }

    pub(super) fn runs(&self) -> [RequesterRun; 2] {
        let implementation = self.implementation.as_ref().map(Follower::run);
        [self.model.run(), implementation.unwrap_or_default()]
    }

    pub(super) fn are_alike(&self) -> bool {
        self.alike
    }

    pub(super) fn complaint(self) -> Option<String> {
        self.complaint
    }
}

/// The first action in which two requesters differ.
fn difference(id: &str, model: &Followed, implementation: &Followed) -> String {
    let length = model.actions.len().max(implementation.actions.len());
    let action = |of: &Followed, index: usize| -> Option<Action> { of.actions.get(index).copied() };
    let first = (0..length)
        .map(|index| (action(model, index), action(implementation, index)))
        .find(|(model, implementation)| model != implementation);
    match first {
        Some((model, implementation)) => format!(
            "the requesters differ in cycle {id}: model {model:?}, implementation {implementation:?}"
        ),
        None => format!("the requesters act the same in cycle {id} but count differently"),
    }
}

#[cfg(test)]
mod tests {
    use mufasa_model::offloading::requester::Group;

    use super::*;

    #[test]
    fn the_first_different_action_is_named() {
        let followed = |actions: &[Action]| Followed { hold: None, actions: actions.to_vec() };
        let (activate, drop) = (Action::Activate(Group::Mot), Action::Drop(Group::Plan));
        let text = difference("c-1", &followed(&[activate, drop]), &followed(&[activate]));
        assert!(text.contains("c-1: model Some(Drop(Plan)), implementation None"), "{text}");
        let text = difference("c-1", &followed(&[drop]), &followed(&[drop]));
        assert!(text.contains("count differently"), "{text}");
    }
}
