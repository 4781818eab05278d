//! Numbers, words and bitmaps as records write them (`spec/5-interfaces.md`).

use std::borrow::Cow;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, Unexpected};
use serde::{Serialize, Serializer};
use serde_json::value::RawValue;

use crate::names::Words;
use crate::record::Recorded;
use crate::typed::excerpt;

/// A number, or a word for what JSON cannot write. Read as the nearest double.
#[derive(Clone, Copy, Debug)]
pub struct Number(pub f64);

/// A signed 64-bit integer from `MIN` on, written without fraction and exponent.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(transparent)]
pub struct Integer<const MIN: i64 = { i64::MIN }>(pub i64);

/// Two numbers. Errors in them are errors of the pair, so that they have no index of their own.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
#[serde(transparent)]
#[schemars(inline)]
pub struct Pair(pub [Number; 2]);

/// RFC 4648 base64 with padding: bit row * width + column, least significant first.
#[derive(Clone, Debug)]
pub struct Bitmap(pub Vec<u8>);

/// A list, or null for none of its items.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct MaybeNone<T>(pub Vec<T>);

/// One of the words of an enum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Word<T>(pub T);

/// The text of a JSON value: serde would read `1e400` as an error and -0 as no integer.
fn text<'de, D: Deserializer<'de>>(json: D) -> Result<&'de str, D::Error> {
    <&RawValue>::deserialize(json).map(RawValue::get)
}

fn wrong<E: Error>(found: &str, wanted: &str) -> E {
    let found = excerpt(found).replace("\\\"", "\"");
    E::invalid_value(Unexpected::Other(&found), &wanted)
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        let text = text(json)?;
        let number = match text.as_bytes() {
            // `str::parse` rounds correctly and gives an infinity beyond the range of doubles.
            [b'-' | b'0'..=b'9', ..] => text.parse().ok(),
            [b'"', ..] => match serde_json::from_str::<String>(text).as_deref() {
                Ok("nan") => Some(f64::NAN),
                Ok("inf") => Some(f64::INFINITY),
                Ok("-inf") => Some(f64::NEG_INFINITY),
                Ok(_) | Err(_) => None,
            },
            _ => None,
        };
        let wanted = "a number, \"nan\", \"inf\" or \"-inf\"";
        number.map(Self).ok_or_else(|| wrong(text, wanted))
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, json: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            number if number.is_finite() => json.serialize_f64(number),
            number if number.is_nan() => json.serialize_str("nan"),
            number => json.serialize_str(if number > 0.0 { "inf" } else { "-inf" }),
        }
    }
}

impl JsonSchema for Number {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, read as the nearest double, or what JSON cannot write.",
            "anyOf": [{"type": "number"}, {"enum": ["nan", "inf", "-inf"]}],
        })
    }
}

impl Recorded for Number {
    type Model = f64;

    fn into_model(self) -> f64 {
        self.0
    }

    fn of_model(model: &f64) -> Self {
        Self(*model)
    }
}

impl<'de, const MIN: i64> Deserialize<'de> for Integer<MIN> {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        let text = text(json)?;
        // A string begins with a quotation mark: its text is no integer either.
        match text.parse() {
            Ok(integer) if integer >= MIN => Ok(Self(integer)),
            Ok(_) => Err(wrong(text, &format!("at least {MIN}"))),
            Err(_) => {
                Err(wrong(text, "an integer from -2^63 to 2^63 - 1 without fraction or exponent"))
            }
        }
    }
}

impl<const MIN: i64> JsonSchema for Integer<MIN> {
    fn schema_name() -> Cow<'static, str> {
        if MIN == i64::MIN { "Integer".into() } else { format!("IntegerFrom{MIN}").into() }
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A signed 64-bit integer; written with a fraction or an exponent it is \
                            an error.",
            "type": "integer",
            "minimum": MIN,
            "maximum": i64::MAX,
        })
    }
}

impl<const MIN: i64> Recorded for Integer<MIN> {
    type Model = i64;

    fn into_model(self) -> i64 {
        self.0
    }

    fn of_model(model: &i64) -> Self {
        Self(*model)
    }
}

impl<'de> Deserialize<'de> for Pair {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        let text = text(json)?;
        serde_json::from_str(text).map(Self).map_err(|_| wrong(text, "a list of two numbers"))
    }
}

impl Recorded for Pair {
    type Model = [f64; 2];

    fn into_model(self) -> [f64; 2] {
        self.0.map(Number::into_model)
    }

    fn of_model(model: &[f64; 2]) -> Self {
        Self(model.map(Number))
    }
}

impl<T> Default for MaybeNone<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for MaybeNone<T> {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        Option::deserialize(json).map(|list| Self(list.unwrap_or_default()))
    }
}

impl<T: JsonSchema> JsonSchema for MaybeNone<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        Option::<Vec<T>>::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Option::<Vec<T>>::json_schema(generator)
    }
}

impl<T: Recorded> Recorded for MaybeNone<T> {
    type Model = Vec<T::Model>;

    fn into_model(self) -> Vec<T::Model> {
        self.0.into_model()
    }

    fn of_model(model: &Vec<T::Model>) -> Self {
        Self(Vec::of_model(model))
    }
}

impl<'de> Deserialize<'de> for Bitmap {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        let decoded = STANDARD.decode(String::deserialize(json)?);
        let wrong =
            |error| D::Error::custom(format!("must be RFC 4648 base64 with padding: {error}"));
        decoded.map(Self).map_err(wrong)
    }
}

impl Serialize for Bitmap {
    fn serialize<S: Serializer>(&self, json: S) -> Result<S::Ok, S::Error> {
        json.serialize_str(&STANDARD.encode(&self.0))
    }
}

impl JsonSchema for Bitmap {
    fn schema_name() -> Cow<'static, str> {
        "Bitmap".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "RFC 4648 base64 with padding: bit row * width + column, least \
                            significant first.",
            "type": "string",
        })
    }
}

impl Recorded for Bitmap {
    type Model = Vec<u8>;

    fn into_model(self) -> Vec<u8> {
        self.0
    }

    fn of_model(model: &Vec<u8>) -> Self {
        Self(model.clone())
    }
}

impl<'de, T: Words> Deserialize<'de> for Word<T> {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        let found = String::deserialize(json)?;
        let value = T::ALL.iter().copied().find(|value| value.word() == found);
        value.map(Self).ok_or_else(|| {
            let words: Vec<&str> = T::ALL.iter().map(|value| value.word()).collect();
            wrong(&found, &words.join(" or "))
        })
    }
}

impl<T: Words> Serialize for Word<T> {
    fn serialize<S: Serializer>(&self, json: S) -> Result<S::Ok, S::Error> {
        json.serialize_str(self.0.word())
    }
}

impl<T: Words> JsonSchema for Word<T> {
    fn schema_name() -> Cow<'static, str> {
        T::NAME.into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let words: Vec<&str> = T::ALL.iter().map(|value| value.word()).collect();
        json_schema!({"description": T::DESCRIPTION, "type": "string", "enum": words})
    }
}

impl<T: Copy> Recorded for Word<T> {
    type Model = T;

    fn into_model(self) -> T {
        self.0
    }

    fn of_model(model: &T) -> Self {
        Self(*model)
    }
}
