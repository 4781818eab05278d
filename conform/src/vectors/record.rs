//! Traces and tasks back to their records (`spec/5-interfaces.md`); cycles have `json::write`.

use mufasa_model::offloading::requester::{self, EventKind, Groups};
use mufasa_model::services::orchestrator::Task;

use mufasa_records::Trace;
use mufasa_records::schema::record::{
    Composition, CompositionKind, CycleVerdict, Event, Group, Integer, Offloading, OffloadingKind,
    Profile, RemoteStation, Service,
};

/// The record of a trace on one line.
pub fn of_trace(id: &str, trace: &Trace) -> Result<String, serde_json::Error> {
    serde_json::to_string(&Offloading {
        kind: OffloadingKind::Offloading,
        id: id.to_owned(),
        profile: match trace.profile {
            mufasa_model::input::cycle::Profile::Paper => Profile::Paper,
            mufasa_model::input::cycle::Profile::Hardened => Profile::Hardened,
        },
        parameters: trace.parameters.into(),
        events: trace.events.iter().map(event).collect(),
    })
}

/// The record of a task on one line.
pub fn of_task(id: &str, task: &Task) -> Result<String, serde_json::Error> {
    let Task { services, goal, same_station, local_only } = task.clone();
    let services = services.into_iter().map(|service| Service {
        id: service.id,
        requires: service.requires,
        guarantees: service.guarantees,
        station: Integer(service.station),
    });
    serde_json::to_string(&Composition {
        kind: CompositionKind::Composition,
        id: id.to_owned(),
        services: services.collect(),
        goal,
        same_station,
        local_only,
    })
}

fn event(event: &requester::Event) -> Event {
    let t_ns = Integer(event.t_ns);
    match event.kind {
        EventKind::Offer { station, groups } => {
            Event::Offer { t_ns, station: RemoteStation(station), groups: list(groups) }
        }
        EventKind::Withdraw { station } => {
            Event::Withdraw { t_ns, station: RemoteStation(station) }
        }
        EventKind::Lost { station } => Event::Lost { t_ns, station: RemoteStation(station) },
        EventKind::Area { groups } => Event::Area { t_ns, groups: list(groups) },
        EventKind::Tick => Event::Tick { t_ns },
        EventKind::Confirm { station, group, session } => {
            let (station, group, session) = message(station, group, session);
            Event::Confirm { t_ns, station, group, session }
        }
        EventKind::Reject { station, group, session } => {
            let (station, group, session) = message(station, group, session);
            Event::Reject { t_ns, station, group, session }
        }
        EventKind::Data { station, group, session, generated_ns } => {
            let (station, group, session) = message(station, group, session);
            let generated_ns = Integer(generated_ns);
            Event::Data { t_ns, station, group, session, generated_ns }
        }
        EventKind::Verdict { safe, groups } => {
            let verdict = if safe { CycleVerdict::Safe } else { CycleVerdict::Unsafe };
            Event::Verdict { t_ns, verdict, groups: list(groups) }
        }
    }
}

fn message(station: i64, group: requester::Group, session: i64) -> (RemoteStation, Group, Integer) {
    (RemoteStation(station), self::group(group), Integer(session))
}

fn list(groups: Groups) -> Vec<Group> {
    requester::Group::ALL.into_iter().filter(|it| groups.contains(*it)).map(group).collect()
}

fn group(group: requester::Group) -> Group {
    match group {
        requester::Group::Mot => Group::Mot,
        requester::Group::Plan => Group::Plan,
    }
}
