//! Which groups of services run where (`spec/1-services.md#configuration`).

/// The four configurations of a CAV. Source: `spec/1-services.md#configuration`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Configuration {
    /// Everything on station 0.
    Local,
    /// MOT remote, ENV and TPL local.
    MotRemote,
    /// MOT, ENV and TPL remote, on one station or on two.
    AllRemote,
    /// MOT local, ENV and TPL remote.
    PlanRemote,
}

impl Configuration {
    /// All configurations in the order of the table.
    pub const ALL: [Self; 4] = [Self::Local, Self::MotRemote, Self::AllRemote, Self::PlanRemote];

    /// The configuration in which exactly `remote` is remote. Source: the table of
    /// `spec/1-services.md#configuration`.
    pub const fn of(remote: Groups) -> Self {
        match (remote.mot, remote.plan) {
            (false, false) => Self::Local,
            (true, false) => Self::MotRemote,
            (true, true) => Self::AllRemote,
            (false, true) => Self::PlanRemote,
        }
    }

    /// The groups that are remote. Source: the table of `spec/1-services.md#configuration`.
    pub const fn remote_groups(self) -> Groups {
        match self {
            Self::Local => Groups::NONE,
            Self::MotRemote => Groups { mot: true, plan: false },
            Self::AllRemote => Groups::ALL,
            Self::PlanRemote => Groups { mot: false, plan: true },
        }
    }

    /// Whether `group` is remote. Source: `spec/1-services.md#configuration`.
    pub const fn is_remote(self, group: Group) -> bool {
        self.remote_groups().contains(group)
    }
}

/// A group of services that is offloaded as a whole. ENV and TPL share memory and are one group,
/// so that they can never have different sources. Source: `spec/1-services.md#configuration`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Group {
    /// Multi-object tracking.
    Mot,
    /// ENV and TPL: environment model and trajectory planning.
    Plan,
}

impl Group {
    /// Both groups in the order of decisions and actions: MOT before PLAN.
    pub const ALL: [Self; 2] = [Self::Mot, Self::Plan];
}

/// A set of groups. Source: `spec/1-services.md#configuration`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Groups {
    /// Whether MOT is in the set.
    pub mot: bool,
    /// Whether PLAN is in the set.
    pub plan: bool,
}

impl Groups {
    /// The empty set.
    pub const NONE: Self = Self { mot: false, plan: false };
    /// Both groups.
    pub const ALL: Self = Self { mot: true, plan: true };

    /// The set of the groups in a list; one named twice counts once. Source:
    /// `spec/5-interfaces.md#cycle`.
    pub const fn of(list: &[Group]) -> Self {
        let mut set = Self::NONE;
        let mut rest = list;
        while let [first, tail @ ..] = rest {
            set = set.with(*first);
            rest = tail;
        }
        set
    }

    /// Whether `group` is in the set.
    pub const fn contains(self, group: Group) -> bool {
        match group {
            Group::Mot => self.mot,
            Group::Plan => self.plan,
        }
    }

    /// The set with `group` added.
    #[must_use]
    pub const fn with(self, group: Group) -> Self {
        match group {
            Group::Mot => Self { mot: true, ..self },
            Group::Plan => Self { plan: true, ..self },
        }
    }

    /// The set with `group` taken away.
    #[must_use]
    pub const fn without(self, group: Group) -> Self {
        match group {
            Group::Mot => Self { mot: false, ..self },
            Group::Plan => Self { plan: false, ..self },
        }
    }

    /// Whether no group is in the set.
    pub const fn is_empty(self) -> bool {
        !self.mot && !self.plan
    }
}

impl From<Group> for Groups {
    fn from(group: Group) -> Self {
        Self::NONE.with(group)
    }
}

/// Whose results of a group may reach control. Being one value, it is exactly one source. Source:
/// `spec/1-services.md#configuration`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The services of station 0.
    Local,
    /// A remote station, id >= 1.
    Remote {
        /// The station's id.
        station: i64,
    },
}

impl Source {
    /// The source of a group: the local services while they compute, else the remote station.
    /// `local_computes`: whether the local services of the group compute; `remote`: the station
    /// on which the group runs remotely, if any. Without a remote station the local services are
    /// the source in any case. Source: `spec/1-services.md#configuration`.
    pub const fn of(local_computes: bool, remote: Option<i64>) -> Self {
        match remote {
            Some(station) if !local_computes => Self::Remote { station },
            Some(_) | None => Self::Local,
        }
    }

    /// The station whose results may reach control; 0 is the CAV. Source:
    /// `spec/1-services.md#configuration`.
    pub const fn station(self) -> i64 {
        match self {
            Self::Local => 0,
            Self::Remote { station } => station,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Configuration, Group, Groups, Source};

    /// `spec/1-services.md#configuration`: the table of the four configurations.
    #[test]
    fn the_table_of_configurations_is_one_to_one() {
        let table = [
            (Configuration::Local, false, false),
            (Configuration::MotRemote, true, false),
            (Configuration::AllRemote, true, true),
            (Configuration::PlanRemote, false, true),
        ];
        for (configuration, mot, plan) in table {
            assert_eq!(configuration.is_remote(Group::Mot), mot, "{configuration:?}");
            assert_eq!(configuration.is_remote(Group::Plan), plan, "{configuration:?}");
            assert_eq!(Configuration::of(Groups { mot, plan }), configuration);
            assert_eq!(Configuration::of(configuration.remote_groups()), configuration);
        }
        assert_eq!(table.map(|(configuration, ..)| configuration), Configuration::ALL);
    }

    /// CONF-01
    #[test]
    fn every_group_has_exactly_one_source() {
        assert_eq!(Source::of(true, None), Source::Local);
        assert_eq!(Source::of(true, Some(3)), Source::Local, "local services that compute win");
        assert_eq!(Source::of(false, Some(3)), Source::Remote { station: 3 });
        assert_eq!(Source::of(false, None), Source::Local, "never no source");
        assert_eq!(Source::of(true, None).station(), 0);
        assert_eq!(Source::of(false, Some(3)).station(), 3);
    }

    /// `spec/5-interfaces.md#cycle`: a group named twice counts once.
    #[test]
    fn a_set_of_groups_counts_each_once() {
        assert_eq!(Groups::of(&[Group::Plan, Group::Plan]), Groups::from(Group::Plan));
        assert_eq!(Groups::of(&[Group::Plan, Group::Mot]), Groups::ALL);
        assert_eq!(Groups::of(&[]), Groups::NONE);
        for group in Group::ALL {
            assert!(Groups::NONE.with(group).contains(group));
            assert!(!Groups::ALL.without(group).contains(group));
            assert!(!Groups::ALL.without(group).is_empty());
            assert!(Groups::NONE.with(group).without(group).is_empty());
        }
    }
}
