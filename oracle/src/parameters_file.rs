//! Parameters from a TOML file: defaults overridden by name (`spec/3-stages.md`,
//! `spec/2-offloading.md`).

use std::fmt;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use mufasa_model::input::cycle::{Cycle, Ego, Profile, Route};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::offloading::requester;
use mufasa_model::report::Reading;
use mufasa_model::services::configuration::Configuration;
use mufasa_model::stages;
use toml::de::{DeTable, DeValue};

/// The parameters of the stages and of the requester.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// Of the stages.
    pub stages: Parameters,
    /// Of the requester.
    pub requester: requester::Parameters,
}

/// Why a parameters file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParametersError {
    /// The file.
    pub file: PathBuf,
    /// Line, from 1.
    pub line: Option<usize>,
    /// Name of the parameter, empty for errors of the whole file.
    pub field: String,
    /// What is wrong and what would be right.
    pub message: String,
}

impl fmt::Display for ParametersError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if !self.field.is_empty() {
            write!(f, ": {}", self.field)?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for ParametersError {}

/// Reads a file of lines `name = value`. Errors: an unreadable file, an unknown name, a value of
/// the wrong type or outside the domain of `spec/4-arithmetic.md#domain`.
pub fn read(file: &Path) -> Result<Settings, ParametersError> {
    let text = fs::read_to_string(file).map_err(|error| ParametersError {
        file: file.to_path_buf(),
        line: None,
        field: String::new(),
        message: format!("cannot be read: {error}"),
    })?;
    parse(file, &text)
}

/// A place in the file where something is wrong.
struct Problem {
    at: Option<Range<usize>>,
    field: String,
    message: String,
}

fn parse(file: &Path, text: &str) -> Result<Settings, ParametersError> {
    settings(text).map_err(|Problem { at, field, message }| ParametersError {
        file: file.to_path_buf(),
        line: at.map(|at| 1 + text[..at.start].matches('\n').count()),
        field,
        message,
    })
}

fn settings(text: &str) -> Result<Settings, Problem> {
    let table = DeTable::parse(text).map_err(|error| Problem {
        at: error.span(),
        field: String::new(),
        message: format!("is not TOML: {}", error.message()),
    })?;
    let mut settings = Settings::default();
    for (name, value) in table.get_ref() {
        let problem =
            |message| Problem { at: Some(name.span()), field: name.get_ref().to_string(), message };
        set(&mut settings, name.get_ref(), value.get_ref()).map_err(problem)?;
    }
    let spans = |field: &str| {
        let name = table.get_ref().keys().find(|name| name.get_ref() == field);
        name.map(toml::Spanned::span)
    };
    match outside_domain(&settings) {
        None => Ok(settings),
        Some((field, message)) => Err(Problem { at: spans(&field), field, message }),
    }
}

fn set(settings: &mut Settings, name: &str, value: &DeValue<'_>) -> Result<(), String> {
    let Settings { stages, requester } = settings;
    match name {
        "theta_tr" => stages.theta_tr = float(value)?,
        "theta_map" => stages.theta_map = float(value)?,
        "theta_obj" => stages.theta_obj = float(value)?,
        "a_b" => stages.a_b = float(value)?,
        "safety_time" => stages.safety_time = float(value)?,
        "max_age_ns" => stages.max_age_ns = integer(value)?,
        "n" => stages.n = integer(value)?,
        "theta_track_max" => stages.theta_track_max = float(value)?,
        "miss_budget" => stages.miss_budget = integer(value)?,
        "tau" => stages.tau = float(value)?,
        "a_max" => stages.a_max = float(value)?,
        "start_tolerance" => stages.start_tolerance = float(value)?,
        "v_max" => stages.v_max = float(value)?,
        "step_max_ns" => stages.step_max_ns = integer(value)?,
        "theta_velocity" => stages.theta_velocity = float(value)?,
        "work_limit" => stages.work_limit = integer(value)?,
        "delta" => stages.delta = float(value)?,
        "t_wait_ns" => requester.t_wait_ns = integer(value)?,
        "request_timeout_ns" => requester.request_timeout_ns = integer(value)?,
        "l_max_ns" => requester.l_max_ns = integer(value)?,
        "dt_max_ns" => requester.dt_max_ns = integer(value)?,
        "qos_hold" => {
            requester.qos_hold = value
                .as_bool()
                .ok_or_else(|| format!("must be true or false, not a {}", value.type_str()))?;
        }
        _ => return Err("is no parameter; spec/3-stages.md and 2-offloading.md name them".into()),
    }
    Ok(())
}

fn float(value: &DeValue<'_>) -> Result<f64, String> {
    let number = match value {
        DeValue::Float(number) => number.as_str().parse().ok(),
        #[expect(clippy::cast_precision_loss)] // the nearest double is what is asked for
        DeValue::Integer(_) => integer(value).ok().map(|number| number as f64),
        _ => None,
    };
    number.ok_or_else(|| format!("must be a number, not a {}", value.type_str()))
}

fn integer(value: &DeValue<'_>) -> Result<i64, String> {
    let number = value
        .as_integer()
        .ok_or_else(|| format!("must be an integer, not a {}", value.type_str()))?;
    i64::from_str_radix(number.as_str(), number.radix())
        .map_err(|_| "must be an integer of 64 bits".to_owned())
}

/// The first parameter outside its domain, as the model sees it.
fn outside_domain(settings: &Settings) -> Option<(String, String)> {
    if let Some(field) = settings.requester.first_outside_domain() {
        return Some((field.to_owned(), "must be from 0 to 2^63 - 1 ns".to_owned()));
    }
    // The model checks parameters before anything else; the rest of this cycle is not looked at
    // when one of them is wrong, and says nothing about them when none is.
    let cycle = Cycle {
        profile: Profile::Hardened,
        parameters: settings.stages.clone(),
        now_ns: 0,
        configuration: Configuration::Local,
        ego: Ego {
            x: 0.0,
            y: 0.0,
            cos: 1.0,
            sin: 0.0,
            speed: 0.0,
            length: 1.0,
            width: 1.0,
            center_offset: 0.0,
        },
        trajectory: None,
        tracks: None,
        detections: None,
        lead: None,
        route: Route { closed: false, cross_sections: Vec::new() },
        grid: None,
        previous_tracks: None,
    };
    let problem = stages::check(&cycle, Reading::Exact).err()?;
    let field = problem.field.strip_prefix("parameters.")?;
    Some((field.to_owned(), problem.message))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failure(text: &str) -> String {
        parse(Path::new("p.toml"), text).unwrap_err().to_string()
    }

    #[test]
    fn names_override_defaults_and_integers_are_numbers() {
        let text =
            "# a comment\ntheta_tr = 0.25\na_b = 6\nmax_age_ns = 50_000_000\nqos_hold = true\n";
        let settings = parse(Path::new("p.toml"), text).unwrap();
        let stages = Parameters {
            theta_tr: 0.25,
            a_b: 6.0,
            max_age_ns: 50_000_000,
            ..Parameters::default()
        };
        assert_eq!(settings.stages, stages);
        assert!(settings.requester.qos_hold);
    }

    #[test]
    fn errors_name_line_and_parameter() {
        assert!(
            failure("n = 4\nthetatr = 1.0\n").starts_with("p.toml:2: thetatr: is no parameter")
        );
        assert!(failure("n = 4.0").starts_with("p.toml:1: n: must be an integer, not a float"));
        assert!(failure("\n\na_b = 'x'").starts_with("p.toml:3: a_b: must be a number"));
        assert!(failure("n = 99999999999999999999").contains("64 bits"));
        assert!(failure("n = \n").starts_with("p.toml:1: is not TOML"));
        assert!(failure("qos_hold = 1").contains("true or false"));
    }

    #[test]
    fn values_outside_the_domain_are_refused_by_name() {
        assert!(
            failure("n = 4\nt_wait_ns = -1").starts_with("p.toml:2: t_wait_ns: must be from 0")
        );
        for text in ["a_b = 0", "theta_tr = nan", "n = 0", "delta = -1e-6", "miss_budget = 65"] {
            let name = text.split(' ').next().unwrap();
            assert!(failure(text).starts_with(&format!("p.toml:1: {name}: ")), "{text}");
        }
    }
}
