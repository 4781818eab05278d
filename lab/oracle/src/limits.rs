//! Values of the command line: numbers within limits, which a refusal says, and names of the records.

use std::fmt::Display;
use std::str::FromStr;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use mufasa_model::input::cycle::Profile;
use mufasa_model::services::configuration::Configuration;
use mufasa_records::names;

/// A number within limits; NaN is in none.
pub fn number(low: f64, high: f64) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync {
    move |text| match f64::from_str(text) {
        Ok(number) if (low..=high).contains(&number) => Ok(number),
        Ok(_) | Err(_) => Err(format!("must be a number from {low} to {high}")),
    }
}

/// A whole number within limits.
pub fn whole<T>(low: T, high: T) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync
where
    T: Copy + PartialOrd + Display + FromStr + Send + Sync,
{
    move |text| match T::from_str(text) {
        Ok(number) if (low..=high).contains(&number) => Ok(number),
        Ok(_) | Err(_) => Err(format!("must be a whole number from {low} to {high}")),
    }
}

/// A profile that has a name.
pub fn profile() -> impl TypedValueParser<Value = Profile> {
    one_of([Profile::PAPER, Profile::HARDENED], names::profile)
}

/// A configuration.
pub fn configuration() -> impl TypedValueParser<Value = Configuration> {
    use Configuration::{AllRemote, Local, MotRemote, PlanRemote};
    one_of([Local, MotRemote, AllRemote, PlanRemote], names::configuration)
}

/// One of these values by its name in the records.
pub fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    values: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(values.map(name)).try_map(move |given| {
        let same = |value: &T| name(*value).eq_ignore_ascii_case(&given);
        values.into_iter().find(same).ok_or("unknown name")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_outside_their_limits_are_refused() {
        for text in ["nan", "inf", "-1", "2", "", "x", "1e999"] {
            assert!(number(0.0, 1.0)(text).is_err(), "{text}");
        }
        assert_eq!(number(0.0, 1.0)("0.5"), Ok(0.5));
    }

    #[test]
    fn whole_numbers_say_their_limits() {
        for text in ["abc", "-1", "1.5", "", "5", "99999999999999999999"] {
            let error = whole(0_u16, 4)(text).unwrap_err();
            assert_eq!(error, "must be a whole number from 0 to 4", "{text}");
        }
        assert_eq!(whole(0_u16, 4)("4"), Ok(4));
    }
}
