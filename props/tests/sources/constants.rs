//! Model and implementation share no constant; here they are compared: every parameter of the stages
//! with its default and the ends of its domain, of the requester with its default, and the rules.

use std::fmt::Debug;

use mufasa::input::profile::HardenedRule as Ours;
use mufasa_model::input::profile::HardenedRule as Model;

/// Name, default, least, greatest; doubles bit for bit.
type Entry = (&'static str, [String; 3]);

/// A number so that equal texts are equal bits.
fn bits(number: impl Debug) -> String {
    format!("{number:?}")
}

macro_rules! of_model {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        fn of_model() -> Vec<Entry> {
            vec![$({
                let domain: std::ops::RangeInclusive<$number> = $domain;
                let default: $number = mufasa_model::input::parameters::Parameters::default().$name;
                (stringify!($name), [bits(default), bits(domain.start()), bits(domain.end())])
            },)*]
        }
    };
}
mufasa_model::parameters!(of_model);

macro_rules! of_implementation {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        fn of_implementation() -> Vec<Entry> {
            vec![$({
                let [least, greatest]: [$number; 2] = $domain;
                let default: $number = mufasa::input::parameters::Parameters::default().$name;
                (stringify!($name), [bits(default), bits(least), bits(greatest)])
            },)*]
        }
    };
}
mufasa::parameters!(of_implementation);

/// Shortest decimals that give the double again, so equal texts are equal bits.
#[test]
fn parameters_of_the_stages_have_equal_defaults_and_domains() {
    let model = of_model();
    assert!(model.len() > 15 && model.iter().any(|(name, _)| *name == "theta_tr"));
    assert_eq!(model, of_implementation());
}

#[test]
fn parameters_of_the_requester_have_equal_defaults() {
    let model = mufasa_model::offloading::requester::Parameters::default();
    let ours = mufasa::offloading::requester::Parameters::default();
    let converted = mufasa_props::bridge::parameters_to_impl(&model);
    assert_eq!(bits(converted), bits(ours));
}

#[test]
fn rules_have_equal_ids() {
    assert_eq!(Model::ALL.map(Model::id), Ours::ALL.map(Ours::id));
}
