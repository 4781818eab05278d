//! Parameters from a TOML file: defaults overridden by name (`spec/3-stages.md`,
//! `spec/2-offloading.md`).

use std::fmt;
use std::fs;
use std::io::{self, ErrorKind};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

use mufasa::monitor::{self, MonitorError};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::offloading::requester;
use mufasa_props::bridge;
use mufasa_records::record::parameters;
use mufasa_records::record::value::Number;
use serde_json::{Map, Value, json};
use toml::de::{DeTable, DeValue};

use crate::spelling::near;

/// The parameters of the stages and of the requester.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// Of the stages.
    pub stages: Parameters,
    /// Of the requester.
    pub requester: requester::Parameters,
    /// What is odd about the file, to be told.
    pub note: Option<String>,
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

/// Reads a file of lines `name = value`, or standard input where it is `-`. Errors: an unreadable file, an unknown name, a value of
/// the wrong type or outside the domain of `spec/4-arithmetic.md#domain`.
pub fn read(file: &Path) -> Result<Settings, ParametersError> {
    let text = if file == Path::new(STDIN) {
        io::read_to_string(io::stdin())
    } else {
        fs::read_to_string(file)
    };
    let text = text.map_err(|error| ParametersError {
        file: file.to_path_buf(),
        line: None,
        field: String::new(),
        message: match error.kind() {
            ErrorKind::InvalidData => String::from("is no text in UTF-8; write it as such"),
            _ => format!("cannot be read: {error}"),
        },
    })?;
    let settings = parse(file, &text)?;
    let note = settings.note.map(|note| format!("{}: {note}", file.display()));
    Ok(Settings { note, ..settings })
}

/// Standard input, as programs are told to read it.
pub const STDIN: &str = "-";
/// Where all names are.
const LISTED: &str = "all are in spec/3-stages.md and spec/2-offloading.md, and by name in what `mufasa schemas` \
                      writes (parameters in cycle.schema.json and offloading.schema.json)";
/// Of a file of blanks and comments.
const NONE: &str = "no parameter in it; the defaults hold (a line is `name = value`)";
/// How a line is written.
const LINE: &str = "`name = value`, the value a number, or true or false";

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
    let table = DeTable::parse(text).map_err(|error| {
        let at = error.span();
        let twice = at.clone().filter(|_| error.message() == "duplicate key");
        let field = twice.and_then(|at| text.get(at)).unwrap_or_default().to_owned();
        let message = if field.is_empty() {
            format!("is not TOML: {}; a line is {LINE}", error.message())
        } else {
            String::from("is named twice")
        };
        Problem { at, field, message }
    })?;
    let mut object = Map::new();
    for (name, value) in table.get_ref() {
        let problem =
            |message| Problem { at: Some(name.span()), field: name.get_ref().to_string(), message };
        let value = json(name.get_ref(), value.get_ref()).map_err(problem)?;
        object.insert(name.get_ref().to_string(), value);
    }
    let (stages, requester) = parameters::settings(object).map_err(|error| {
        let message =
            error.message.strip_prefix(&error.field).unwrap_or(&error.message).trim_start();
        let field = error.field.strip_prefix("parameters.").unwrap_or(&error.field).to_owned();
        let name = table.get_ref().keys().find(|name| name.get_ref() == field.as_str());
        let message = match near(&field, parameters::names()) {
            Some(known) if message.contains("no field") => {
                format!("is no parameter; is {known} meant?")
            }
            None if message.contains("no field") => format!("is no parameter; {LISTED}"),
            _ if is_fraction(&table, &field) && field.ends_with("_ns") => {
                format!("{message}; it is in nanoseconds: 0.2 s are 200_000_000")
            }
            _ => message.to_owned(),
        };
        Problem { at: name.map(toml::Spanned::span), message, field }
    })?;
    let nothing = table.get_ref().is_empty().then(|| String::from(NONE));
    let note = nothing.or_else(|| slip(&stages, &requester));
    Ok(Settings { stages, requester, note })
}

/// Whether the value of that name has a fraction or an exponent.
fn is_fraction(table: &toml::Spanned<DeTable<'_>>, name: &str) -> bool {
    table.get_ref().get(name).is_some_and(|it| matches!(it.get_ref(), DeValue::Float(_)))
}

/// The time that the monitor of a vehicle takes for one in another unit, or that is below another; it
/// refuses what is judged here all the same. What depends on the period is left out: nothing says it here.
fn slip(stages: &Parameters, requester: &requester::Parameters) -> Option<String> {
    let settings = monitor::Settings {
        stages: bridge::cycle_parameters(stages),
        requester: bridge::parameters_to_impl(requester),
        ..monitor::Settings::new(Duration::from_millis(1))
    };
    match settings.check() {
        Err(error @ (MonitorError::TimeTooShort { .. } | MonitorError::MaxAgeBelowLMax { .. })) => {
            Some(format!("a vehicle's monitor refuses this: {error}"))
        }
        _ => None,
    }
}

/// The value of this name as records write it.
fn json(name: &str, value: &DeValue<'_>) -> Result<Value, String> {
    match value {
        DeValue::Boolean(value) => Ok(Value::from(*value)),
        DeValue::Float(number) => {
            let number = number.as_str().parse().map_err(|_| "must be a number".to_owned())?;
            Ok(json!(Number(number)))
        }
        DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix())
            .map(Value::from)
            .map_err(|_| "must be an integer of 64 bits".to_owned()),
        DeValue::Table(_) => Err(String::from(
            "parameters stand in no table: strike its head out, and keep its lines",
        )),
        other => {
            let wanted = if name == "qos_hold" { "true or false" } else { "a number" };
            Err(format!("must be {wanted}, not a {}", other.type_str()))
        }
    }
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
        assert_eq!(settings.note, None);
    }

    #[test]
    fn a_file_without_parameters_is_noted() {
        for text in ["", "\n\n", "# theta_tr = 0.25\n"] {
            let settings = parse(Path::new("p.toml"), text).unwrap();
            assert_eq!(settings, Settings { note: Some(NONE.to_owned()), ..Settings::default() });
        }
    }

    #[test]
    fn errors_name_line_and_parameter() {
        let misspelled = failure("n = 4\nthetatr = 1.0\n");
        assert_eq!(misspelled, "p.toml:2: thetatr: is no parameter; is theta_tr meant?");
        for (line, meant) in [("A_max = 1", "a_max"), ("A_B = 8", "a_b"), ("a-b = 3", "a_b")] {
            let told = format!("is no parameter; is {meant} meant?");
            assert!(failure(line).ends_with(&told), "{}", failure(line));
        }
        let unknown = failure("speed = 1");
        assert!(unknown.starts_with("p.toml:1: speed: is no parameter; "), "{unknown}");
        assert!(unknown.contains("spec/3-stages.md") && !unknown.contains("remove"), "{unknown}");
        assert!(failure("n = 4.0").starts_with("p.toml:1: n: must be an integer from"));
        assert!(failure("\n\na_b = 'nan'").starts_with("p.toml:3: a_b: must be a number"));
        assert!(failure("n = 99999999999999999999").contains("64 bits"));
        assert!(failure("n = \n").starts_with("p.toml:1: is not TOML"));
        assert!(failure("qos_hold = yes\n").ends_with("the value a number, or true or false"));
        assert_eq!(failure("a_b = 6\na_b = 7\n"), "p.toml:2: a_b: is named twice");
        assert!(failure("a_b = \"six\"\n").ends_with("must be a number, not a string"));
        assert!(failure("qos_hold = \"yes\"\n").ends_with("must be true or false, not a string"));
        assert!(failure("qos_hold = 1").contains("true or false"));
        assert!(failure("dt_max_ns = 0.2").ends_with("in nanoseconds: 0.2 s are 200_000_000"));
        assert!(!failure("n = 0.2").contains("nanoseconds"));
        assert!(
            failure("[stages]\na_b = 6")
                .starts_with("p.toml:1: stages: parameters stand in no table")
        );
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
