//! The offloading trace (`spec/5-interfaces.md#offloading-trace`).

use mufasa_model::input::profile::Profile;
use mufasa_model::offloading::requester as model;
use mufasa_model::report::InvalidInput;
use mufasa_model::services::configuration::{Group, Groups};
use schemars::JsonSchema;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

use super::cycle::hardened;
use super::parameters::ProtocolParameters;
use super::value::{Integer, Word};
use super::{Recorded, from_object, record};
use crate::names::Words;

/// Largest number of events (`spec/4-arithmetic.md#domain`).
const MAX_EVENTS: usize = 10_000;

/// What one requester lives through.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace {
    /// Profile in force.
    pub profile: Profile,
    /// Parameters in force.
    pub parameters: model::Parameters,
    /// Events in order.
    pub events: Vec<model::Event>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "a word")]
pub enum OffloadingKind {
    #[default]
    Offloading,
}

record! {
    /// What one requester lives through.
    Offloading = Trace {
        /// Hardened when it is absent.
        #[serde(default = "hardened")]
        profile: Word<Profile>,
        /// Defaults where they are absent.
        #[serde(default)]
        parameters: ProtocolParameters,
        /// Events in order.
        #[serde(deserialize_with = "events")]
        events: Vec<Event>,
    } + {
        /// The kind of the record.
        kind: OffloadingKind,
        /// Names the record in its answer.
        id: String,
    }
}

record! {
    /// For each group whose data a cycle used, the session they came from.
    Sessions = model::Sessions {
        /// That of MOT; absent when no remote tracks were used.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        mot: Option<Integer>,
        /// That of PLAN; absent when no remote trajectory was used.
        #[serde(default, deserialize_with = "given", skip_serializing_if = "Option::is_none")]
        plan: Option<Integer>,
    }
}

impl Offloading {
    /// The record of a trace with all its parameters, those at their default too: it stays what it
    /// is when defaults change.
    pub fn whole(id: &str, trace: &Trace) -> Self {
        let mut record = Self { id: id.to_owned(), ..Self::of_model(trace) };
        record.parameters.whole = true;
        record
    }
}

impl TryFrom<Offloading> for Trace {
    type Error = InvalidInput;

    /// Errors: times outside their domain.
    fn try_from(record: Offloading) -> Result<Self, InvalidInput> {
        record.parameters.clone().check()?;
        Ok(record.into_model())
    }
}

/// Groups; one that is named twice counts once.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(transparent)]
#[schemars(inline)]
pub struct GroupList(Vec<Word<Group>>);

impl Recorded for GroupList {
    type Model = Groups;

    fn into_model(self) -> Groups {
        self.0.into_iter().map(|Word(group)| group).collect()
    }

    fn of_model(model: &Groups) -> Self {
        Self(Group::ALL.into_iter().filter(|it| model.contains(*it)).map(Word).collect())
    }
}

/// The fields of all types of events, in the order in which errors name them. Which type has
/// which is known when all of them are read.
macro_rules! events {
    (
        fields { $($any:ident: $any_type:ty,)* }
        $($type:ident = $word:literal $(($key:ident: $key_type:ty as $model:ident))? { $($field:ident: $field_type:ty),* })*
    ) => {
        /// What happens at the requester.
        #[derive(Clone, Debug, JsonSchema, Serialize)]
        #[serde(tag = "type")]
        #[expect(missing_docs, reason = "documented at the requester of `mufasa_model`")]
        pub enum Event {
            $(#[serde(rename = $word)]
            $type { t_ns: Integer, $($key: $key_type,)? $($field: $field_type),* },)*
        }

        #[derive(Deserialize)]
        #[serde(remote = "Self", deny_unknown_fields, expecting = "an object")]
        struct Fields {
            t_ns: Integer,
            r#type: Word<Type>,
            $(#[serde(default, deserialize_with = "given")]
            $any: Option<$any_type>,)*
        }

        from_object!(Fields);

        #[derive(Clone, Copy)]
        enum Type {
            $($type),*
        }

        impl Words for Type {
            const NAME: &'static str = "Type";
            const DESCRIPTION: &'static str = "What happens.";
            const ALL: &'static [Self] = &[$(Self::$type),*];

            fn word(self) -> &'static str {
                match self {
                    $(Self::$type => $word),*
                }
            }
        }

        /// The type of an event.
        pub fn event_type(event: &model::Event) -> &'static str {
            match event.kind {
                $(model::EventKind::$type { .. } => $word,)*
            }
        }

        impl<'de> Deserialize<'de> for Event {
            fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
                let mut fields = <Fields as Deserialize>::deserialize(json)?;
                let t_ns = fields.t_ns;
                let event = match fields.r#type.0 {
                    $(Type::$type => Self::$type {
                        t_ns,
                        $($key: taken(&mut fields.$key, stringify!($key))?,)?
                        $($field: taken(&mut fields.$field, stringify!($field))?,)*
                    },)*
                };
                $(if fields.$any.is_some() {
                    return Err(Error::unknown_field(stringify!($any), &[]));
                })*
                Ok(event)
            }
        }

        impl Recorded for Event {
            type Model = model::Event;

            fn into_model(self) -> model::Event {
                match self {
                    $(Self::$type { t_ns: Integer(t_ns), $($field,)* $($key)? } => model::Event {
                        t_ns,
                        kind: model::EventKind::$type {
                            $($field: $field.into_model(),)*
                            $($model: $key.into_model())?
                        },
                    },)*
                }
            }

            fn of_model(model: &model::Event) -> Self {
                let t_ns = Integer(model.t_ns);
                match &model.kind {
                    $(model::EventKind::$type { $($field,)* $($model)? } => Self::$type {
                        t_ns,
                        $($field: Recorded::of_model($field),)*
                        $($key: Recorded::of_model($model))?
                    },)*
                }
            }
        }
    };
}

events! {
    fields {
        station: Integer<1>,
        group: Word<Group>,
        session: Integer,
        generated_ns: Integer,
        verdict: Word<bool>,
        groups: GroupList,
        sessions: Sessions,
    }
    Offer = "offer" { station: Integer<1>, groups: GroupList }
    Withdraw = "withdraw" { station: Integer<1> }
    Lost = "lost" { station: Integer<1> }
    Area = "area" { groups: GroupList }
    Tick = "tick" {}
    Confirm = "confirm" { station: Integer<1>, group: Word<Group>, session: Integer }
    Reject = "reject" { station: Integer<1>, group: Word<Group>, session: Integer }
    Data = "data" { station: Integer<1>, group: Word<Group>, session: Integer, generated_ns: Integer }
    Verdict = "verdict" (verdict: Word<bool> as safe) { sessions: Sessions }
}

/// A field that is there is not null.
fn given<'de, T: Deserialize<'de>, D: Deserializer<'de>>(json: D) -> Result<Option<T>, D::Error> {
    T::deserialize(json).map(Some)
}

fn taken<T, E: Error>(field: &mut Option<T>, name: &'static str) -> Result<T, E> {
    field.take().ok_or_else(|| Error::missing_field(name))
}

/// Reads no more events than there may be.
fn events<'de, D: Deserializer<'de>>(json: D) -> Result<Vec<Event>, D::Error> {
    struct Events;
    impl<'de> Visitor<'de> for Events {
        type Value = Vec<Event>;

        fn expecting(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            out.write_str("a list")
        }

        fn visit_seq<S: SeqAccess<'de>>(self, mut list: S) -> Result<Vec<Event>, S::Error> {
            let mut events = Vec::new();
            while let Some(event) = list.next_element()? {
                events.push(event);
                if events.len() > MAX_EVENTS {
                    return Err(Error::custom(format_args!(
                        "must hold at most {MAX_EVENTS} events"
                    )));
                }
            }
            Ok(events)
        }
    }
    json.deserialize_seq(Events)
}
