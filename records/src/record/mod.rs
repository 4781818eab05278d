//! The records of `spec/5-interfaces.md`, each of them once: serde reads and writes these types,
//! schemars describes them, and [`Recorded`] says what they are in the model.

pub mod composition;
pub mod cycle;
pub mod event;
pub mod monitor;
pub mod offloading;
pub mod parameters;
pub mod value;

use serde::de::{Deserializer, Visitor};
use serde::forward_to_deserialize_any;

/// A part of a record and what it is in the model.
pub trait Recorded {
    /// The type of the model.
    type Model;

    /// What the record says.
    fn into_model(self) -> Self::Model;

    /// The record of it.
    fn of_model(model: &Self::Model) -> Self;
}

impl<T: Recorded> Recorded for Option<T> {
    type Model = Option<T::Model>;

    fn into_model(self) -> Self::Model {
        self.map(T::into_model)
    }

    fn of_model(model: &Self::Model) -> Self {
        model.as_ref().map(T::of_model)
    }
}

impl<T: Recorded> Recorded for Vec<T> {
    type Model = Vec<T::Model>;

    fn into_model(self) -> Self::Model {
        self.into_iter().map(T::into_model).collect()
    }

    fn of_model(model: &Self::Model) -> Self {
        model.iter().map(T::of_model).collect()
    }
}

impl<T: Recorded> Recorded for Box<T> {
    type Model = Box<T::Model>;

    fn into_model(self) -> Self::Model {
        Box::new((*self).into_model())
    }

    fn of_model(model: &Self::Model) -> Self {
        Self::new(T::of_model(model))
    }
}

/// Types that are the same in the record and in the model.
macro_rules! unchanged {
    ($($type:ty),*) => {$(
        impl Recorded for $type {
            type Model = Self;

            fn into_model(self) -> Self {
                self
            }

            fn of_model(model: &Self) -> Self {
                model.clone()
            }
        }
    )*};
}

unchanged!(bool, String);

/// Reads the JSON object of a derived struct, which would take a list of its fields as well.
pub struct Object<D>(pub D);

impl<'de, D: Deserializer<'de>> Deserializer<'de> for Object<D> {
    type Error = D::Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, D::Error> {
        self.0.deserialize_map(visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option
        unit unit_struct newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

/// Lets structs with `#[serde(remote = "Self")]` be read from JSON objects alone.
macro_rules! from_object {
    ($($name:ident),*) => {$(
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
                Self::deserialize($crate::record::Object(json))
            }
        }
    )*};
}

/// Structs of records: JSON objects with these fields and no others, and the struct of the model
/// that has the same fields. What the list has behind `+` is in the record alone.
macro_rules! record {
    ($(
        $(#[$meta:meta])*
        $name:ident = $model:path {
            $($(#[$field_meta:meta])* $field:ident: $type:ty,)*
        } $(+ { $($(#[$more_meta:meta])* $more:ident: $more_type:ty,)* })?
    )*) => {$(
        $(#[$meta])*
        #[derive(Clone, Debug, serde::Deserialize, schemars::JsonSchema, serde::Serialize)]
        #[serde(remote = "Self", deny_unknown_fields, expecting = "an object")]
        pub struct $name {
            $($($(#[$more_meta])* pub $more: $more_type,)*)?
            $($(#[$field_meta])* pub $field: $type,)*
        }

        $crate::record::from_object!($name);

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, json: S) -> Result<S::Ok, S::Error> {
                Self::serialize(self, json)
            }
        }

        impl $crate::record::Recorded for $name {
            type Model = $model;

            fn into_model(self) -> $model {
                $model { $($field: self.$field.into_model()),* }
            }

            fn of_model(model: &$model) -> Self {
                let $model { $($field),* } = model;
                Self {
                    $($($more: Default::default(),)*)?
                    $($field: $crate::record::Recorded::of_model($field)),*
                }
            }
        }
    )*};
}

pub(crate) use {from_object, record};
