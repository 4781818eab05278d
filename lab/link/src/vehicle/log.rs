//! What a vehicle did, entry by entry, and whether every remote result that it used was covered by a
//! safe verdict: told from the entries alone.

use std::collections::BTreeMap;
use std::fmt;
use std::hash::{DefaultHasher, Hash, Hasher};

use mufasa::input::cycle::{Track, TrajectoryPoint};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::transport::Health;

/// One thing that happened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Entry {
    /// When, on the shared clock, ns.
    pub at_ns: i64,
    /// What.
    #[serde(flatten)]
    pub what: What,
}

/// What happened. Groups are `mot` and `plan`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "what", rename_all = "snake_case")]
pub enum What {
    /// The vehicle began; nothing of an earlier life counts any more.
    Began,
    /// It asked for a group.
    Requested {
        /// The group.
        group: String,
        /// Whom.
        station: i64,
        /// In which session.
        session: i64,
    },
    /// A station confirmed a session; it need not be one that was asked for.
    Confirmed {
        /// The group.
        group: String,
        /// Who.
        station: i64,
        /// Which session.
        session: i64,
    },
    /// A session ended.
    Left {
        /// The group.
        group: String,
        /// Why, as the summary counts it.
        why: String,
    },
    /// A result came.
    Arrived {
        /// The group.
        group: String,
        /// From whom.
        station: i64,
        /// In which session.
        session: i64,
        /// How old it was, ns.
        latency_ns: i64,
        /// Whether it may be used in a cycle.
        accepted: bool,
        /// What it held.
        digest: u64,
    },
    /// A cycle was decided.
    Decided {
        /// Its number in the drive.
        cycle: usize,
        /// Which groups were remote.
        configuration: String,
        /// Whether no stage failed.
        safe: bool,
        /// What failed.
        failed: Option<String>,
    },
    /// A remote result reached control.
    Used {
        /// The group.
        group: String,
        /// Who computed it.
        station: i64,
        /// What it holds.
        digest: u64,
    },
    /// From this cycle on control follows something else, or other groups are remote.
    Control {
        /// Which groups are remote.
        configuration: String,
        /// What control follows.
        follows: Follows,
    },
    /// The monitor says what contradicts itself.
    Advice {
        /// In words.
        advice: String,
    },
    /// The connection was made, or has ended; the first entry says whether there is one.
    Link {
        /// Whether there is one.
        connected: bool,
        /// How often there was one.
        connections: u64,
        /// Why the last one failed or ended.
        error: Option<String>,
    },
}

/// What control follows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Follows {
    /// The plan of the CAV's own planner.
    OwnPlan,
    /// The trajectory of this station.
    Station(i64),
    /// What it followed last, along which it brakes in time: nothing newer may be followed.
    LastVerified,
    /// Nothing: it brakes fully, since the CAV has no plan of its own that may be followed.
    Brakes,
}

impl fmt::Display for Follows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OwnPlan => f.write_str("control follows the CAV's own plan"),
            Self::Station(station) => write!(f, "control follows station {station}"),
            Self::LastVerified => {
                f.write_str("control follows what it followed last, and brakes in time")
            }
            Self::Brakes => f.write_str("control brakes"),
        }
    }
}

impl What {
    /// Of a connection that was made or has ended since `seen`, which then has how it is now.
    pub fn of_link(health: Health, seen: &mut Option<(bool, u64)>) -> Option<Self> {
        let Health { connected, connections, last_error: error, .. } = health;
        let now = Some((connected, connections));
        (std::mem::replace(seen, now) != now).then_some(Self::Link {
            connected,
            connections,
            error,
        })
    }

    /// What has changed by it, in words; `None` of what changes nothing, or is said by another entry.
    pub fn change(&self) -> Option<String> {
        match self {
            Self::Began => Some("the vehicle begins".to_owned()),
            Self::Left { group, why } => Some(format!("{group}: session left: {why}")),
            Self::Decided { configuration, failed: Some(failed), .. }
                if configuration != "Local" =>
            {
                Some(format!("fallback to Local: {failed} failed"))
            }
            Self::Control { configuration, follows } => Some(format!("{configuration}: {follows}")),
            Self::Advice { advice } => Some(format!("advice: {advice}")),
            Self::Link { connected: true, connections: 1, .. } => Some("connected".to_owned()),
            Self::Link { connected: true, .. } => Some("connected again".to_owned()),
            Self::Link { connected: false, error, .. } => {
                let why = error.as_deref().unwrap_or("no answer yet");
                Some(format!("not connected, and tried again: {why}"))
            }
            Self::Requested { .. }
            | Self::Confirmed { .. }
            | Self::Arrived { .. }
            | Self::Decided { .. }
            | Self::Used { .. } => None,
        }
    }
}

/// A remote result that was used, and why it should not have been.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum Uncovered {
    /// The last decision is of another time, or there is none.
    #[error("used without a decision of this cycle")]
    NoDecision,
    /// The cycle was not safe.
    #[error("used after an unsafe decision")]
    Unsafe,
    /// Its group was not remote in the cycle that was decided.
    #[error("used though its group was not remote")]
    Local,
    /// No session of this station runs.
    #[error("used though no session of its station runs")]
    NoSession,
    /// It is not what was accepted last in the running session.
    #[error("used though it is not what the session had last")]
    Other,
}

/// Follows the entries of a log; it knows nothing of the monitor.
#[derive(Clone, Debug, Default)]
pub struct Coverage {
    groups: BTreeMap<String, Session>,
    decided: Option<(i64, bool, String)>,
}

#[derive(Clone, Debug, Default)]
struct Session {
    requested: Option<(i64, i64)>,
    running: Option<(i64, i64)>,
    accepted: Option<u64>,
}

impl Coverage {
    /// Takes the next entry. Errors: a remote result that was used and not covered.
    pub fn take(&mut self, entry: &Entry) -> Result<(), Uncovered> {
        match &entry.what {
            What::Began => *self = Self::default(),
            What::Requested { group, station, session } => {
                let requested = Some((*station, *session));
                self.groups.insert(group.clone(), Session { requested, ..Session::default() });
            }
            What::Confirmed { group, station, session } => {
                let of_group = self.groups.entry(group.clone()).or_default();
                if of_group.requested == Some((*station, *session)) {
                    of_group.running = of_group.requested.take();
                }
            }
            What::Left { group, .. } => {
                self.groups.remove(group);
            }
            What::Arrived { group, station, session, accepted, digest, .. } => {
                let of_group = self.groups.entry(group.clone()).or_default();
                if *accepted && of_group.running == Some((*station, *session)) {
                    of_group.accepted = Some(*digest);
                }
            }
            What::Decided { configuration, safe, .. } => {
                self.decided = Some((entry.at_ns, *safe, configuration.clone()));
            }
            What::Used { group, station, digest } => {
                return self.used(entry.at_ns, group, *station, *digest);
            }
            What::Control { .. } | What::Link { .. } | What::Advice { .. } => {}
        }
        Ok(())
    }

    fn used(&self, at_ns: i64, group: &str, station: i64, digest: u64) -> Result<(), Uncovered> {
        let Some((_, safe, configuration)) = self.decided.as_ref().filter(|it| it.0 == at_ns)
        else {
            return Err(Uncovered::NoDecision);
        };
        let remote: &[&str] = match configuration.as_str() {
            "AllRemote" => &["mot", "plan"],
            "MotRemote" => &["mot"],
            "PlanRemote" => &["plan"],
            _ => &[],
        };
        let session = self
            .groups
            .get(group)
            .filter(|it| it.running.is_some_and(|(of_station, _)| of_station == station));
        match session {
            _ if !safe => Err(Uncovered::Unsafe),
            _ if !remote.contains(&group) => Err(Uncovered::Local),
            None => Err(Uncovered::NoSession),
            Some(session) if session.accepted != Some(digest) => Err(Uncovered::Other),
            Some(_) => Ok(()),
        }
    }
}

/// Something that a digest is taken of: all its numbers.
pub trait Digest {
    /// Adds the numbers to the digest.
    fn add(&self, to: &mut DefaultHasher);
}

impl Digest for Track {
    fn add(&self, to: &mut DefaultHasher) {
        let Self { id, x, y, cos, sin, vx, vy, length, width } = self;
        id.hash(to);
        [x, y, cos, sin, vx, vy, length, width].map(|it| it.to_bits()).hash(to);
    }
}

impl Digest for TrajectoryPoint {
    fn add(&self, to: &mut DefaultHasher) {
        let Self { t_ns, x, y, cos, sin } = self;
        t_ns.hash(to);
        [x, y, cos, sin].map(|it| it.to_bits()).hash(to);
    }
}

/// A number by which a result is known again.
pub fn digest(stamp_ns: i64, items: &[impl Digest]) -> u64 {
    let mut hasher = DefaultHasher::new();
    (stamp_ns, items.len()).hash(&mut hasher);
    items.iter().for_each(|item| item.add(&mut hasher));
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MOT: &str = "mot";

    fn session() -> Vec<Entry> {
        let (group, station, session, digest) = (MOT.to_owned(), 1, 7, 99);
        let what = [
            What::Began,
            What::Requested { group: group.clone(), station, session },
            What::Confirmed { group: group.clone(), station, session },
            What::Arrived {
                group: group.clone(),
                station,
                session,
                latency_ns: 1,
                accepted: true,
                digest,
            },
            What::Decided {
                cycle: 3,
                configuration: "AllRemote".to_owned(),
                safe: true,
                failed: None,
            },
            What::Used { group, station, digest },
        ];
        what.map(|what| Entry { at_ns: 5, what }).into()
    }

    fn first_problem(entries: &[Entry]) -> Option<Uncovered> {
        let mut coverage = Coverage::default();
        entries.iter().find_map(|entry| coverage.take(entry).err())
    }

    #[test]
    fn a_result_of_the_running_session_in_a_safe_cycle_is_covered() {
        assert_eq!(first_problem(&session()), None);
    }

    #[test]
    fn each_thing_that_is_missing_is_found() {
        let without = |index: usize| {
            let mut entries = session();
            entries.remove(index);
            first_problem(&entries)
        };
        let found: Vec<_> = (1..5).map(without).collect();
        let none = Some(Uncovered::NoSession);
        assert_eq!(
            found,
            [none.clone(), none.clone(), Some(Uncovered::Other), Some(Uncovered::NoDecision)]
        );
        let with = |index: usize, what: What| {
            let mut entries = session();
            entries.insert(index, Entry { at_ns: 5, what });
            first_problem(&entries)
        };
        assert_eq!(with(5, What::Left { group: MOT.to_owned(), why: "silent".to_owned() }), none);
        assert_eq!(with(5, What::Began), Some(Uncovered::NoDecision));
        let decided = |safe, configuration: &str| {
            let configuration = configuration.to_owned();
            with(5, What::Decided { cycle: 3, configuration, safe, failed: None })
        };
        assert_eq!(decided(false, "AllRemote"), Some(Uncovered::Unsafe));
        assert_eq!(decided(true, "PlanRemote"), Some(Uncovered::Local));
        assert_eq!(decided(true, "MotRemote"), None);
        let newer = |accepted, session| {
            let (group, station) = (MOT.to_owned(), 1);
            with(4, What::Arrived { group, station, session, latency_ns: 1, accepted, digest: 98 })
        };
        assert_eq!(newer(true, 7), Some(Uncovered::Other));
        assert_eq!((newer(false, 7), newer(true, 6)), (None, None));
    }

    #[test]
    fn entries_are_lines_that_can_be_read_again() {
        for entry in session() {
            let line = serde_json::to_string(&entry).unwrap();
            assert_eq!(serde_json::from_str::<Entry>(&line).unwrap(), entry, "{line}");
        }
    }
}
