//! Which groups of services run where (`spec/1-services.md#configuration`, paper Table I).

/// Services that move together. `spec/1-services.md#configuration`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Group {
    /// Multi-object tracking.
    Mot,
    /// Environment model and trajectory planning.
    Plan,
}

impl Group {
    /// Both groups in the order in which they are handled.
    pub const ALL: [Self; 2] = [Self::Mot, Self::Plan];
}

/// A set of groups.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Groups {
    /// Whether MOT is in the set.
    pub mot: bool,
    /// Whether PLAN is in the set.
    pub plan: bool,
}

impl Groups {
    /// No group.
    pub const NONE: Self = Self { mot: false, plan: false };
    /// Both groups.
    pub const ALL: Self = Self { mot: true, plan: true };

    /// Whether the group is in the set.
    pub fn contains(self, group: Group) -> bool {
        match group {
            Group::Mot => self.mot,
            Group::Plan => self.plan,
        }
    }

    /// Adds the group.
    pub fn insert(&mut self, group: Group) {
        match group {
            Group::Mot => self.mot = true,
            Group::Plan => self.plan = true,
        }
    }
}

impl FromIterator<Group> for Groups {
    fn from_iter<I: IntoIterator<Item = Group>>(groups: I) -> Self {
        let mut set = Self::NONE;
        groups.into_iter().for_each(|group| set.insert(group));
        set
    }
}

/// The four configurations of a CAV.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Configuration {
    /// Everything on station 0.
    Local,
    /// MOT remote, ENV and TPL local.
    MotRemote,
    /// MOT, ENV and TPL remote.
    AllRemote,
    /// MOT local, ENV and TPL remote.
    PlanRemote,
}

impl Configuration {
    /// The configuration in which exactly these groups are remote.
    /// `spec/1-services.md#configuration`.
    pub fn of_remote(groups: Groups) -> Self {
        match (groups.mot, groups.plan) {
            (false, false) => Self::Local,
            (true, false) => Self::MotRemote,
            (true, true) => Self::AllRemote,
            (false, true) => Self::PlanRemote,
        }
    }

    /// The groups that are remote. `spec/1-services.md#configuration`.
    pub fn remote(self) -> Groups {
        match self {
            Self::Local => Groups { mot: false, plan: false },
            Self::MotRemote => Groups { mot: true, plan: false },
            Self::AllRemote => Groups { mot: true, plan: true },
            Self::PlanRemote => Groups { mot: false, plan: true },
        }
    }
}

/// Where the results of a group come from that may reach control.
/// `spec/1-services.md#configuration`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The local services.
    Local,
    /// The services of a remote station.
    Remote {
        /// Station id, >= 1.
        station: i64,
    },
}

/// The services that can be offloaded. `spec/1-services.md#configuration`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Offloadable {
    /// Multi-object tracking.
    Mot,
    /// Environment model.
    Env,
    /// Trajectory planning.
    Tpl,
}

impl Offloadable {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Mot, Self::Env, Self::Tpl];

    /// The group in which the service moves: ENV and TPL form PLAN.
    pub fn group(self) -> Group {
        match self {
            Self::Mot => Group::Mot,
            Self::Env | Self::Tpl => Group::Plan,
        }
    }

    /// R (Table I).
    pub fn requires(self) -> &'static [&'static str] {
        match self {
            Self::Mot => &["detections"],
            Self::Env => &["tracks", "map", "ego motion"],
            Self::Tpl => &["environment model", "vehicle metadata"],
        }
    }

    /// G (Table I).
    pub fn guarantees(self) -> &'static [&'static str] {
        match self {
            Self::Mot => &["tracks"],
            Self::Env => &["environment model"],
            Self::Tpl => &["trajectory"],
        }
    }
}
