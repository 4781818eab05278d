//! The events of records, whose fields depend on their type (`spec/5-interfaces.md#offloading-trace`).

use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

/// Largest number of events (`spec/4-arithmetic.md#domain`).
const MAX_EVENTS: usize = 10_000;

/// The events of `model`, which the caller imports: the fields of all types, in the order in which errors
/// name them. Which type has which is known when all of them are read.
macro_rules! events {
    (
        $schema:literal: $description:literal
        fields { $($any:ident: $any_type:ty,)* }
        $($type:ident = $word:literal $(($key:ident: $key_type:ty as $model:ident))? { $($field:ident: $field_type:ty),* })*
    ) => {
        #[doc = $description]
        #[derive(Clone, Debug, schemars::JsonSchema, serde::Serialize)]
        #[serde(tag = "type")]
        #[schemars(rename = $schema)]
        #[expect(missing_docs, reason = "documented in `mufasa_model`")]
        pub enum Event {
            $(#[serde(rename = $word)]
            $type { t_ns: $crate::record::value::Integer, $($key: $key_type,)? $($field: $field_type),* },)*
        }

        #[derive(serde::Deserialize)]
        #[serde(remote = "Self", deny_unknown_fields, expecting = "an object")]
        struct Fields {
            t_ns: $crate::record::value::Integer,
            r#type: $crate::record::value::Word<Type>,
            $(#[serde(default, deserialize_with = "crate::record::event::given")]
            $any: Option<$any_type>,)*
        }

        $crate::record::from_object!(Fields);

        #[derive(Clone, Copy)]
        enum Type {
            $($type),*
        }

        impl $crate::names::Words for Type {
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

        impl<'de> serde::Deserialize<'de> for Event {
            fn deserialize<D: serde::Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
                let mut fields = <Fields as serde::Deserialize>::deserialize(json)?;
                let t_ns = fields.t_ns;
                let event = match fields.r#type.0 {
                    $(Type::$type => Self::$type {
                        t_ns,
                        $($key: $crate::record::event::taken(&mut fields.$key, stringify!($key))?,)?
                        $($field: $crate::record::event::taken(&mut fields.$field, stringify!($field))?,)*
                    },)*
                };
                $(if fields.$any.is_some() {
                    return Err(serde::de::Error::unknown_field(stringify!($any), &[]));
                })*
                Ok(event)
            }
        }

        impl $crate::record::Recorded for Event {
            type Model = model::Event;

            fn into_model(self) -> model::Event {
                match self {
                    $(Self::$type { t_ns: $crate::record::value::Integer(t_ns), $($field,)* $($key)? } => model::Event {
                        t_ns,
                        kind: model::EventKind::$type {
                            $($field: $field.into_model(),)*
                            $($model: $key.into_model())?
                        },
                    },)*
                }
            }

            fn of_model(model: &model::Event) -> Self {
                let t_ns = $crate::record::value::Integer(model.t_ns);
                match &model.kind {
                    $(model::EventKind::$type { $($field,)* $($model)? } => Self::$type {
                        t_ns,
                        $($field: $crate::record::Recorded::of_model($field),)*
                        $($key: $crate::record::Recorded::of_model($model))?
                    },)*
                }
            }
        }
    };
}

pub(crate) use events;

/// A field that is there is not null.
pub fn given<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    json: D,
) -> Result<Option<T>, D::Error> {
    T::deserialize(json).map(Some)
}

/// A field that this type of event has.
pub fn taken<T, E: Error>(field: &mut Option<T>, name: &'static str) -> Result<T, E> {
    field.take().ok_or_else(|| Error::missing_field(name))
}

/// Reads no more events than there may be.
pub fn bounded<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    json: D,
) -> Result<Vec<T>, D::Error> {
    json.deserialize_seq(Bounded(PhantomData))
}

struct Bounded<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Bounded<T> {
    type Value = Vec<T>;

    fn expecting(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str("a list")
    }

    fn visit_seq<S: SeqAccess<'de>>(self, mut list: S) -> Result<Vec<T>, S::Error> {
        let mut events = Vec::new();
        while let Some(event) = list.next_element()? {
            events.push(event);
            if events.len() > MAX_EVENTS {
                return Err(Error::custom(format_args!("must hold at most {MAX_EVENTS} events")));
            }
        }
        Ok(events)
    }
}
