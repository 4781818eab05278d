//! A monitor twice: the model's and the implementation's, step by step.

use mufasa::monitor as twin;
use mufasa::monitor::DropReason;
use mufasa_model::input::cycle::Route;
use mufasa_model::monitor::Monitor;
use mufasa_model::monitor::messages::{Answer, Brake, Decision, Dropped, Event, EventKind};
use mufasa_model::monitor::settings::Settings;
use mufasa_model::report::{InvalidInput, Outcome, Reading, Report, Witness};

use crate::bridge::{Bridged, route_to_impl, settings_to_impl};
use crate::lent::Lent;

/// A monitor twice, the model's and the implementation's.
#[derive(Debug)]
pub struct Monitors<'a> {
    settings: Settings,
    model: Monitor,
    implementation: Bridged<'a>,
}

impl<'a> Monitors<'a> {
    /// Both at their start; none where both refuse the settings or the route. Errors: one of them alone does.
    pub fn new(
        settings: &Settings,
        route: Route,
        lent: &'a mut Lent,
    ) -> Result<Option<Self>, String> {
        let made = settings_to_impl(settings).ok_or_else(|| String::from("a time is negative"));
        let made = made.and_then(|it| twin::Monitor::new(it, lent.memory()).map_err(text));
        let (closed, cross_sections) = route_to_impl(&route);
        let kept = mufasa::input::cycle::Route { closed, cross_sections: &cross_sections };
        let made = made.and_then(|mut it| it.set_route(&kept).map_err(text).map(|()| it));
        match (Monitor::new(settings.clone(), route, Reading::Exact), made) {
            (Ok(model), Ok(made)) => {
                let implementation = Bridged::new(made);
                Ok(Some(Self { settings: settings.clone(), model, implementation }))
            }
            (Err(_), Err(_)) => Ok(None),
            (Ok(_), Err(error)) => Err(format!("the implementation alone refuses: {error}")),
            (Err(error), Ok(_)) => Err(format!("the model alone refuses: {error:?}")),
        }
    }

    /// Both take the event; the answer of both. Errors: they differ.
    pub fn step(&mut self, event: &Event) -> Result<Answer, String> {
        let expected = self.model.step(event.clone());
        let (found, dropped) = self.implementation.step(event);
        compare(event, &expected, found, dropped, &self.settings)?;
        Ok(expected)
    }
}

fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}

fn compare(
    event: &Event,
    expected: &Answer,
    found: Answer,
    dropped: Option<DropReason>,
    settings: &Settings,
) -> Result<(), String> {
    let same = match (expected.dropped, dropped) {
        (None, None) => true,
        (Some(one), Some(other)) => is_same_reason(event, one, other, settings),
        (Some(_), None) | (None, Some(_)) => false,
    };
    if !same {
        return Err(format!("dropped as {:?} and {dropped:?}", expected.dropped));
    }
    // As text, in which NaN is NaN.
    let text = |answer: Answer| {
        let decision = answer.decision.map(plain);
        format!("{:#?}", Answer { decision, dropped: None, ..answer })
    };
    let [one, other] = [text(expected.clone()), text(found)];
    if one == other {
        Ok(())
    } else {
        Err(format!("the model says {one}\nand the monitor {other}"))
    }
}

/// The words of the implementation are finer for what is late, those of the model for what is not newer.
fn is_same_reason(event: &Event, model: Dropped, word: DropReason, settings: &Settings) -> bool {
    let (EventKind::Tracks { generated_ns, .. } | EventKind::Trajectory { generated_ns, .. }) =
        event.kind
    else {
        return false;
    };
    let latency_ns = event.t_ns - generated_ns;
    let l_max_ns = settings.requester.l_max_ns;
    match word {
        DropReason::TooLong => model == Dropped::DoesNotFit,
        DropReason::OtherSession => model == Dropped::OtherSession,
        DropReason::TooOld => model == Dropped::Stale,
        DropReason::Starved => model == Dropped::Starved,
        DropReason::FromTheFuture => model == Dropped::Late && latency_ns < 0,
        DropReason::Late => model == Dropped::Late && latency_ns > l_max_ns,
        DropReason::AfterSilence => model == Dropped::Late && (0..=l_max_ns).contains(&latency_ns),
        DropReason::NotNewer => matches!(model, Dropped::Repeated | Dropped::Older),
    }
}

/// Without the words of a problem, the numbers that a witness compared, and the segment that an index may find
/// otherwise.
fn plain(decision: Decision) -> Decision {
    let Decision { report, tracks, trajectory, brake_by_ns, brake } = decision;
    let report = match report {
        Ok(Report { failed_stage, stages, input }) => Ok(Report {
            failed_stage,
            stages: stages.map(|outcome| match outcome {
                Outcome::Failed(witness) => Outcome::Failed(named(witness)),
                other => other,
            }),
            input: input.map(place),
        }),
        Err(problem) => Err(place(problem)),
    };
    let brake = brake.map(|brake| match brake {
        Brake::Failed(stage, witness) => Brake::Failed(stage, witness.map(named)),
        Brake::Invalid(problem) => Brake::Invalid(place(problem)),
        Brake::NoTrajectory => Brake::NoTrajectory,
    });
    Decision { report, tracks, trajectory, brake_by_ns, brake }
}

fn place(problem: InvalidInput) -> InvalidInput {
    InvalidInput { message: String::new(), ..problem }
}

fn named(mut witness: Witness) -> Witness {
    (witness.segment, witness.compared) = (None, [0.0; 2]);
    witness
}
