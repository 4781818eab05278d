//! Classes of disagreements: the first of each is shrunk, the others are counted.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Place of what the program did after its answer, which cannot be asked.
pub const AFTERWARDS: &str = "after its answer";

/// A kind of record (`spec/5-interfaces.md`).
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// One cycle.
    Cycle,
    /// What one requester lives through.
    Offloading,
    /// A service set to compose.
    Composition,
    /// What one monitor lives through.
    Monitor,
    /// A line that breaks the schema or is no JSON.
    Line,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 5] =
        [Self::Cycle, Self::Offloading, Self::Composition, Self::Monitor, Self::Line];

    /// Those that are asked unless others are named: whoever asks for a monitor says so.
    pub const USUAL: [Self; 4] = [Self::Cycle, Self::Offloading, Self::Composition, Self::Line];

    /// Those that are records.
    pub const RECORDS: [Self; 4] =
        [Self::Cycle, Self::Offloading, Self::Composition, Self::Monitor];

    /// The word in the records and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cycle => "cycle",
            Self::Offloading => "offloading",
            Self::Composition => "composition",
            Self::Monitor => "monitor",
            Self::Line => "line",
        }
    }
}

/// The rule that an answer breaks (`spec/4-arithmetic.md#conformance-of-an-implementation`,
/// `spec/5-interfaces.md#programs-under-test`).
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Breach {
    /// It accepts what the exact model rejects.
    Soundness,
    /// It rejects what the strict model accepts.
    Completeness,
    /// It fails at another stage.
    Stage,
    /// It takes invalid local input for valid, or the other way round, or names another place in it.
    Input,
    /// The states or actions of an offloading trace, or of a monitor, differ.
    States,
    /// The compositions differ.
    Compositions,
    /// It takes a line that breaks the schema for a record, or names another place in it.
    Schema,
    /// It ends, or closes its output, before it has answered.
    Dies,
    /// It does not answer in time.
    Hangs,
    /// It writes more than one line for a record, or a line without an end.
    Floods,
    /// It answers another record.
    OutOfOrder,
    /// Its answer is no answer.
    Nonsense,
}

impl Breach {
    /// The word in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Soundness => "soundness",
            Self::Completeness => "completeness",
            Self::Stage => "stage",
            Self::Input => "input",
            Self::States => "states",
            Self::Compositions => "compositions",
            Self::Schema => "schema",
            Self::Dies => "dies",
            Self::Hangs => "hangs",
            Self::Floods => "floods",
            Self::OutOfOrder => "out-of-order",
            Self::Nonsense => "nonsense",
        }
    }

    /// Whether there was no answer to compare; the program is then started again.
    pub const fn is_broken(self) -> bool {
        match self {
            Self::Dies | Self::Hangs | Self::Floods | Self::OutOfOrder | Self::Nonsense => true,
            Self::Soundness
            | Self::Completeness
            | Self::Stage
            | Self::Input
            | Self::States
            | Self::Compositions
            | Self::Schema => false,
        }
    }
}

/// How far the case is from the threshold that decides it.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// No margin of 1e-6 m explains the answer.
    Clear,
    /// With a margin of 1e-6 m the model could answer the same: rounding, or a boundary that is
    /// taken the wrong way.
    Threshold,
}

/// What makes two disagreements the same: which rule broke, in which stage, configuration and
/// profile.
#[derive(
    Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
pub struct Class {
    /// Kind of the records.
    pub kind: Kind,
    /// The rule of conformance that broke.
    pub breach: Breach,
    /// Stage and rule, such as `iii collision` or `ii instead of iv`; the field of a state and
    /// the type of the event; what is wrong with a line; otherwise empty where the program did not
    /// answer.
    pub place: String,
    /// `paper` or `hardened`; empty where it plays no role.
    pub profile: String,
    /// Configuration of the cycles; empty otherwise.
    pub configuration: String,
    /// Distance from the threshold.
    pub scale: Scale,
}

impl Class {
    /// Whether the same rule broke for the same kind of records.
    pub fn is_of_rule(&self, other: &Self) -> bool {
        (self.kind, self.breach) == (other.kind, other.breach)
    }

    /// A name of letters, digits and hyphens.
    pub fn slug(&self) -> String {
        let text = self.to_string();
        let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.kind.name(), self.breach.name())?;
        for part in [&self.place, &self.configuration, &self.profile] {
            if !part.is_empty() {
                write!(f, " {part}")?;
            }
        }
        match self.scale {
            Scale::Clear => Ok(()),
            Scale::Threshold => f.write_str(" at the threshold"),
        }
    }
}
