//! What the sequences reached, so that none of it is compared with nothing.

use std::collections::BTreeMap;
use std::fmt;

use mufasa_model::input::profile::Profile;
use mufasa_model::monitor::messages::{Answer, Brake, Decision, Event, EventKind};
use mufasa_model::offloading::requester::{Action, GroupState};
use mufasa_model::report::FailedStage;

/// How often each case occurred.
#[derive(Debug, Default)]
pub struct Reached {
    counts: BTreeMap<String, u64>,
    /// Stamp of the remote tracks that came out of the last cycle.
    tracks_ns: Option<i64>,
}

impl fmt::Display for Reached {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.counts.iter().try_for_each(|(name, count)| write!(f, "{name} {count}, "))
    }
}

impl Reached {
    fn saw(&mut self, name: &str) {
        *self.counts.entry(name.to_owned()).or_default() += 1;
    }

    pub fn count(&mut self, event: &Event, answer: &Answer) {
        self.saw("steps");
        if let Some(why) = answer.dropped {
            self.saw(&format!("dropped {why:?}"));
        }
        for action in &answer.actions {
            match action {
                Action::Request { .. } => self.saw("request"),
                Action::Release { .. } => self.saw("release"),
                _ => {}
            }
        }
        if answer.given_back_ns == Some(event.t_ns) && event.kind == EventKind::Tick {
            self.saw("given back");
        }
        if event.kind == EventKind::Tick && answer.hold_until_ns == event.t_ns.checked_add(1) {
            self.saw("held at a tick");
        }
        let Some(decision) = &answer.decision else { return };
        self.saw("cycle");
        match (&decision.report, decision.brake.as_ref()) {
            (Err(problem), _) => self.saw(&format!("error {}", problem.field)),
            (Ok(report), _) => match report.failed_stage {
                None => self.saw("safe"),
                Some(FailedStage::Input) => self.saw("input"),
                Some(stage) => self.saw(&format!("fails {stage:?}")),
            },
        }
        match &decision.brake {
            None => {}
            Some(Brake::NoTrajectory) => self.saw("brake no trajectory"),
            Some(Brake::Invalid(_)) => self.saw("brake invalid"),
            Some(Brake::Failed(stage, _)) => self.saw(&format!("brake {stage:?}")),
        }
        let Decision { tracks, trajectory, .. } = decision;
        let tracks_ns = tracks.map(|it| it.stamp_ns);
        if tracks_ns.is_some() {
            self.saw("tracks");
            // No newer list was accepted in between: one was late or lost.
            if tracks_ns == self.tracks_ns {
                self.saw("tracks of two cycles");
            }
        }
        self.tracks_ns = tracks_ns;
        match trajectory {
            Some(it) if it.remote.is_some() => self.saw("trajectory"),
            Some(_) => self.saw("own trajectory"),
            None if matches!(answer.plan, GroupState::Remote { .. }) => self.saw("no trajectory"),
            None => {}
        }
    }

    /// Every case was reached often enough.
    pub fn is_enough(&self, profile: Profile) {
        let seldom = |least: u64, names: &[&str]| {
            for name in names {
                let count = self.counts.get(*name).copied().unwrap_or(0);
                assert!(count >= least, "{profile:?}: {name}: {count}: {self}");
            }
        };
        seldom(1_000, &["safe", "tracks", "trajectory", "request", "release"]);
        seldom(50, &["tracks of two cycles"]);
        seldom(
            10,
            &[
                "dropped OtherSession",
                "dropped DoesNotFit",
                "dropped Stale",
                "dropped Starved",
                "dropped Late",
                "dropped Repeated",
                "dropped Older",
                "error tick",
                "error ego.speed",
                "error ego.x",
                "input",
                "no trajectory",
                "own trajectory",
                "given back",
                "brake invalid",
                "brake no trajectory",
                "brake Stage(Ii)",
                "fails Stage(I)",
                "fails Stage(Ii)",
            ],
        );
        if profile == Profile::HARDENED {
            seldom(
                10,
                &[
                    "error detections.items",
                    "fails Stage(V)",
                    "fails NoObstacleCheck",
                    "held at a tick",
                ],
            );
        }
    }
}
