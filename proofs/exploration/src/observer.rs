//! An observer who stands outside: follows what is stopped, used and heard, and judges each step
//! by the properties.

use enumset::EnumSet;
use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{Group, Groups};
use mufasa_model::services::configuration::Offloadable;

use super::cav::{CavLikeness, Deed, Use};
use super::properties::{Property, Sight};
use super::state::{Cav, Proof};
use super::stimulus::{Named, Stimulus};

/// What a step shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Observed {
    /// The properties that it breaks.
    pub broken: EnumSet<Property>,
    /// What it shows.
    pub seen: EnumSet<Sight>,
}

impl Observed {
    /// The step breaks the property when the condition holds.
    pub fn breaks(&mut self, property: Property, condition: bool) {
        if condition {
            self.broken.insert(property);
        }
    }

    /// The step shows the sight when the condition holds.
    pub fn shows(&mut self, sight: Sight, condition: bool) {
        if condition {
            self.seen.insert(sight);
        }
    }
}

/// A step of a requester.
pub struct CavStep<'a> {
    /// The profile in force.
    pub profile: Profile,
    /// Waiting time after a safety issue, ticks.
    pub t_wait: u8,
    /// Whether violations start holds, too, which the observer does not follow.
    pub qos_hold: bool,
    /// The state before.
    pub before: &'a CavLikeness,
    /// What happens.
    pub stimulus: Stimulus,
    /// What the requester does.
    pub deeds: &'a [Deed],
    /// The state afterwards.
    pub after: &'a CavLikeness,
}

impl CavStep<'_> {
    /// Follows the step in `cav`, whose memory is that before the step, and judges it.
    pub fn observe(&self, cav: &mut Cav, found: &mut Observed) {
        let barred = cav.blocked > 0;
        self.follow_services(cav, found);
        self.follow_proof(cav);
        self.follow_wait(cav, found);
        self.judge_sources(*cav, found);
        self.judge_results(*cav, barred, found);
        self.judge_requests(barred, found);
        self.judge_sessions(found);
        found.breaks(Property::PartsValid, !self.after.valid);
        self.see(found);
    }

    /// Starts and stops the services of a group as the requester says.
    fn follow_services(&self, cav: &mut Cav, found: &mut Observed) {
        for deed in self.deeds {
            let (group, stop) = match *deed {
                Deed::Activate(group) => (group, false),
                Deed::Deactivate(group) => (group, true),
                Deed::Request { .. } | Deed::Release { .. } | Deed::Drop(_) => continue,
            };
            for bit in services(group) {
                let stopped = cav.stopped & bit != 0;
                found.breaks(Property::OneSource, stopped == stop);
                cav.stopped = if stop { cav.stopped | bit } else { cav.stopped & !bit };
            }
        }
    }

    /// A result counts for the running session only, a safe cycle for the results used before.
    fn follow_proof(&self, cav: &mut Cav) {
        for (place, group) in Group::ALL.into_iter().enumerate() {
            let session_goes_on = self.before.groups[place].remote().is_some()
                && self.before.groups[place].remote() == self.after.groups[place].remote();
            if !session_goes_on {
                cav.proof[place] = Proof::None;
                continue;
            }
            match self.stimulus {
                Stimulus::Data(named, _) if named.group == group && self.is_used(named) => {
                    cav.proof[place] = cav.proof[place].max(Proof::Used);
                }
                Stimulus::Verdict { safe: true, groups, current: true }
                    if groups.contains(group) && cav.proof[place] == Proof::Used =>
                {
                    cav.proof[place] = Proof::Safe;
                }
                _ => {}
            }
        }
    }

    fn follow_wait(&self, cav: &mut Cav, found: &mut Observed) {
        match self.stimulus {
            Stimulus::TimePasses => {
                let offered = self.before.offers.iter().any(|offer| *offer != Groups::NONE);
                found.shows(Sight::WaitEnds, cav.blocked == 1 && offered);
                cav.blocked = cav.blocked.saturating_sub(1);
            }
            Stimulus::Verdict { safe: false, .. } => cav.blocked = self.t_wait,
            _ => {}
        }
    }

    /// The source that the requester names is the one that computes, and ENV and TPL agree.
    fn judge_sources(&self, cav: Cav, found: &mut Observed) {
        for (place, service) in Offloadable::ALL.into_iter().enumerate() {
            let stopped = cav.stopped & (1 << place) != 0;
            let group = self.after.groups[service.group() as usize];
            let right = match self.after.sources[place] {
                None => !stopped,
                Some(station) => stopped && group.remote() == Some(station),
            };
            found.breaks(Property::OneSource, !right);
            let proven = cav.proof[service.group() as usize] == Proof::Safe;
            found.breaks(Property::NoStopBeforeSafeCycle, stopped && !proven);
        }
        let [_, env, tpl] = self.after.sources;
        let (env_stopped, tpl_stopped) = (cav.stopped >> 1 & 1, cav.stopped >> 2 & 1);
        found.breaks(Property::EnvAndTplTogether, env != tpl || env_stopped != tpl_stopped);
    }

    /// `barred`: whether a safety issue barred remote results before the step.
    fn judge_results(&self, cav: Cav, barred: bool, found: &mut Observed) {
        let property = Property::NoRemoteResultBeforeHoldUntil;
        if let Stimulus::Data(named, _) = self.stimulus {
            found.breaks(property, barred && self.is_used(named));
            found.shows(Sight::ResultDuringWait, barred);
        }
        let remote = self.after.sources.iter().any(Option::is_some);
        found.breaks(property, cav.blocked > 0 && remote);
    }

    /// A tick asks for every local group that may be asked for, when no safety issue bars it.
    fn judge_requests(&self, barred: bool, found: &mut Observed) {
        if self.stimulus != Stimulus::Tick || barred || self.qos_hold && self.after.is_held() {
            return;
        }
        for group in Group::ALL {
            let local = self.before.groups[group as usize] == Use::Local;
            let offered = self.before.offers.iter().any(|offer| offer.contains(group));
            let asked = self
                .deeds
                .iter()
                .any(|deed| matches!(deed, Deed::Request { group: of, .. } if *of == group));
            let may = local && offered && self.before.area.contains(group);
            found.breaks(Property::AskedOnceAllowed, may && !asked);
        }
    }

    /// A message that names another session than the running or requested one changes nothing,
    /// and a new session has a number that no message of an older one can name.
    fn judge_sessions(&self, found: &mut Observed) {
        let property = Property::EndedSessionChangesNothing;
        if let Stimulus::Confirm(named) | Stimulus::Reject(named) | Stimulus::Data(named, _) =
            self.stimulus
        {
            let partner = self.before.groups[named.group as usize].partner();
            if !(named.current && partner == Some(named.station)) {
                let answers = self.deeds == self.answer().as_slice();
                found.breaks(property, !answers || self.before != self.after);
                found.shows(Sight::EndedMeetsLaterAtCav, partner.is_some());
            }
        }
        for deed in self.deeds {
            let stale = matches!(deed, Deed::Request { fresh: false, .. });
            found.breaks(property, stale);
        }
    }

    /// What a requester may do with a message that does not name the session of the group: drop
    /// data, and release the session that a confirmation names, there and nothing else.
    fn answer(&self) -> Vec<Deed> {
        match self.stimulus {
            Stimulus::Data(named, _) => vec![Deed::Drop(named.group)],
            Stimulus::Confirm(Named { station, group, current }) => {
                vec![Deed::Release { station, group, current }]
            }
            _ => vec![],
        }
    }

    fn is_used(&self, named: Named) -> bool {
        !self.deeds.contains(&Deed::Drop(named.group))
    }

    fn see(&self, found: &mut Observed) {
        let [mot, env, _] = self.after.sources;
        let two = mot.is_some() && env.is_some() && mot != env;
        found.shows(Sight::TwoStationsAtOnce, two);
        let [mot, plan] = self.before.groups;
        let remote = mot.remote().is_some() || plan.remote().is_some();
        let requested = [mot, plan].iter().any(|group| matches!(group, Use::Requested { .. }));
        let beside = |group: &Use| matches!(group, Use::Remote { local_computes: true, .. });
        found.shows(Sight::RemoteBesideLocal, self.after.groups.iter().any(beside));
        let stops = self.deeds.iter().any(|deed| matches!(deed, Deed::Deactivate(_)));
        let releases = self.deeds.iter().any(|deed| matches!(deed, Deed::Release { .. }));
        match self.stimulus {
            Stimulus::Verdict { safe: false, .. } => {
                found.shows(Sight::FallbackRemoteAndRequested, remote && requested);
                let was_source = self.before.sources.iter().any(Option::is_some);
                found.shows(Sight::FallbackFromRemote, was_source);
            }
            Stimulus::Verdict { safe: true, .. } => {
                found.shows(Sight::StoppedAtSafeVerdict, stops);
            }
            Stimulus::Confirm(named) => {
                found.shows(Sight::StoppedAtConfirmation, stops);
                let group = self.before.groups[named.group as usize];
                let late = matches!(group, Use::Requested { left: 0, station } if station == named.station);
                found.shows(Sight::ConfirmedAfterTimeout, named.current && late && releases);
            }
            Stimulus::Tick | Stimulus::Data(..) => {
                let left = self.before.groups.iter().zip(&self.after.groups);
                let violation = left
                    .into_iter()
                    .any(|(before, after)| before.remote().is_some() && after.remote().is_none());
                let held = self.before.is_held();
                found.shows(Sight::ViolationDuringHold, held && violation);
            }
            _ => {}
        }
    }
}

/// Bits of the services that move with a group.
fn services(group: Group) -> impl Iterator<Item = u8> {
    let moves = move |(_, service): &(usize, Offloadable)| service.group() == group;
    Offloadable::ALL.into_iter().enumerate().filter(moves).map(|(place, _)| 1 << place)
}
