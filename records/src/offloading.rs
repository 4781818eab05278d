//! The offloading trace (`spec/5-interfaces.md#offloading-trace`).

use mufasa_model::input::cycle::Profile;
use mufasa_model::offloading::requester::{Event, EventKind, Group, Groups, Parameters};
use mufasa_model::report::InvalidInput;

use crate::walk::Value;
use crate::{cycle, names, parameters};

/// Largest number of events (`spec/4-arithmetic.md#domain`).
const MAX_EVENTS: usize = 10_000;

/// What one requester lives through.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace {
    /// Profile in force.
    pub profile: Profile,
    /// Parameters in force.
    pub parameters: Parameters,
    /// Events in order.
    pub events: Vec<Event>,
}

/// Reads a trace; `record` is an object with `kind` offloading.
pub fn trace(record: Value<'_, '_>) -> Result<Trace, InvalidInput> {
    let [_, _, profile, parameters, events] =
        record.object(["kind", "id", "profile", "parameters", "events"])?;
    let mut count = 0;
    Ok(Trace {
        profile: cycle::profile(profile)?,
        parameters: self::parameters(parameters)?,
        events: events.list(|value| {
            count += 1;
            if count > MAX_EVENTS {
                return Err(events.problem(format_args!("must hold at most {MAX_EVENTS} events")));
            }
            event(value)
        })?,
    })
}

fn parameters(value: Value<'_, '_>) -> Result<Parameters, InvalidInput> {
    let default = Parameters::default();
    let Some(value) = value.present() else {
        return Ok(default);
    };
    let [t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold] =
        value.object(["t_wait_ns", "request_timeout_ns", "l_max_ns", "dt_max_ns", "qos_hold"])?;
    Ok(Parameters {
        t_wait_ns: parameters::nanos(t_wait_ns, default.t_wait_ns)?,
        request_timeout_ns: parameters::nanos(request_timeout_ns, default.request_timeout_ns)?,
        l_max_ns: parameters::nanos(l_max_ns, default.l_max_ns)?,
        dt_max_ns: parameters::nanos(dt_max_ns, default.dt_max_ns)?,
        qos_hold: qos_hold.present().map_or(Ok(default.qos_hold), |value| value.boolean())?,
    })
}

/// The types of events, which say which fields an event has.
#[derive(Clone, Copy)]
enum Type {
    Offer,
    Withdraw,
    Lost,
    Area,
    Tick,
    Confirm,
    Reject,
    Data,
    Verdict,
}

impl Type {
    const ALL: [Self; 9] = [
        Self::Offer,
        Self::Withdraw,
        Self::Lost,
        Self::Area,
        Self::Tick,
        Self::Confirm,
        Self::Reject,
        Self::Data,
        Self::Verdict,
    ];

    const fn name(self) -> &'static str {
        match self {
            Self::Offer => "offer",
            Self::Withdraw => "withdraw",
            Self::Lost => "lost",
            Self::Area => "area",
            Self::Tick => "tick",
            Self::Confirm => "confirm",
            Self::Reject => "reject",
            Self::Data => "data",
            Self::Verdict => "verdict",
        }
    }
}

fn event(value: Value<'_, '_>) -> Result<Event, InvalidInput> {
    let kind = match value.field("type")?.choice(&Type::ALL, Type::name)? {
        Type::Offer => {
            let [_, _, station, groups] = value.object(["t_ns", "type", "station", "groups"])?;
            EventKind::Offer { station: self::station(station)?, groups: self::groups(groups)? }
        }
        Type::Withdraw => {
            let [_, _, station] = value.object(["t_ns", "type", "station"])?;
            EventKind::Withdraw { station: self::station(station)? }
        }
        Type::Lost => {
            let [_, _, station] = value.object(["t_ns", "type", "station"])?;
            EventKind::Lost { station: self::station(station)? }
        }
        Type::Area => {
            let [_, _, groups] = value.object(["t_ns", "type", "groups"])?;
            EventKind::Area { groups: self::groups(groups)? }
        }
        Type::Tick => {
            let [_, _] = value.object(["t_ns", "type"])?;
            EventKind::Tick
        }
        Type::Confirm => {
            let (station, group, session) = message(value)?;
            EventKind::Confirm { station, group, session }
        }
        Type::Reject => {
            let (station, group, session) = message(value)?;
            EventKind::Reject { station, group, session }
        }
        Type::Data => {
            let [_, _, station, group, session, generated_ns] =
                value.object(["t_ns", "type", "station", "group", "session", "generated_ns"])?;
            EventKind::Data {
                station: self::station(station)?,
                group: self::group(group)?,
                session: session.integer()?,
                generated_ns: generated_ns.integer()?,
            }
        }
        Type::Verdict => {
            let [_, _, verdict, groups] = value.object(["t_ns", "type", "verdict", "groups"])?;
            let safe = verdict.choice(&[true, false], names::verdict)?;
            EventKind::Verdict { safe, groups: self::groups(groups)? }
        }
    };
    Ok(Event { t_ns: value.field("t_ns")?.integer()?, kind })
}

/// What `confirm` and `reject` carry.
fn message(value: Value<'_, '_>) -> Result<(i64, Group, i64), InvalidInput> {
    let [_, _, station, group, session] =
        value.object(["t_ns", "type", "station", "group", "session"])?;
    Ok((self::station(station)?, self::group(group)?, session.integer()?))
}

fn station(value: Value<'_, '_>) -> Result<i64, InvalidInput> {
    let station = value.integer()?;
    if station < 1 {
        return Err(value.problem(format_args!("must be at least 1, not {station}")));
    }
    Ok(station)
}

fn groups(value: Value<'_, '_>) -> Result<Groups, InvalidInput> {
    Ok(value.list(group)?.into_iter().collect())
}

fn group(value: Value<'_, '_>) -> Result<Group, InvalidInput> {
    value.choice(&Group::ALL, names::group)
}
