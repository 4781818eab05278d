//! What the command line takes.

use super::*;
use mufasa_drives::Options;

#[test]
fn the_arguments_are_consistent() {
    command().debug_assert();
}

#[test]
fn defaults_of_the_command_line_are_those_of_the_readers() {
    let cli = Cli::try_parse_from(["mufasa", "check", "x"]).unwrap();
    let Some(Command::Check(arguments)) = cli.command else { panic!("not check") };
    assert_eq!(arguments.options(), Options::default());
}

/// One range for all that the CAV sees, as long as the lead has none of its own.
#[test]
fn the_range_of_the_detectors_is_that_of_the_lead_where_none_is_said() {
    let ranges = |more: &[&str]| {
        let given = [&["mufasa", "check", "x", "--sensor-range", "5"], more].concat();
        let cli = Cli::try_parse_from(given).unwrap();
        let Some(Command::Check(arguments)) = cli.command else { panic!("not check") };
        let sensor = arguments.options().sensor;
        [sensor.range_m, sensor.lead_range_m].map(f64::to_bits)
    };
    assert_eq!(ranges(&[]), [5.0, 5.0].map(f64::to_bits));
    assert_eq!(ranges(&["--lead-range", "80"]), [5.0, 80.0].map(f64::to_bits));
}
