//! Which map a run is on: with what is in its files, so that two are the same only if they are.

use core::fmt;
use core::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const TOWN: &str = "town";
const LEHR: &str = "ulm-lehr-";

/// Which map a run is on; as text `town`, or `ulm-lehr-` and sixteen hexadecimal digits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "String", into = "String")]
#[schemars(with = "String")]
pub enum MapId {
    /// The town of this program.
    #[default]
    Town,
    /// The junction of Ulm-Lehr, with a check sum of its files.
    Lehr(u64),
}

impl MapId {
    /// One of the ego's routes in the ids of runs: its number in the town, `lehr-` before it at Ulm-Lehr.
    pub fn route(self, index: usize) -> String {
        match self {
            Self::Town => index.to_string(),
            Self::Lehr(_) => format!("lehr-{index}"),
        }
    }
}

impl fmt::Display for MapId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Town => f.write_str(TOWN),
            Self::Lehr(sum) => write!(f, "{LEHR}{sum:016x}"),
        }
    }
}

impl From<MapId> for String {
    fn from(id: MapId) -> Self {
        id.to_string()
    }
}

impl FromStr for MapId {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let is_sum = |it: &&str| it.len() == 16 && it.bytes().all(|it| it.is_ascii_hexdigit());
        let digits = text.strip_prefix(LEHR).filter(is_sum);
        let sum = digits.and_then(|it| u64::from_str_radix(it, 16).ok()).map(Self::Lehr);
        sum.or((text == TOWN).then_some(Self::Town))
            .ok_or_else(|| format!("{text}: a map is `{TOWN}` or `{LEHR}` and sixteen digits"))
    }
}

impl TryFrom<String> for MapId {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

/// A check sum of bytes that come in parts: 64-bit FNV-1a. It tells files apart, not forgers.
#[derive(Clone, Copy, Debug)]
pub struct Sum(u64);

impl Sum {
    /// Of nothing.
    pub const START: Self = Self(0xcbf2_9ce4_8422_2325);

    /// With these bytes after the others.
    #[must_use]
    pub fn with(self, bytes: &[u8]) -> Self {
        let next = |sum: u64, byte: &u8| (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        Self(bytes.iter().fold(self.0, next))
    }

    /// The sum.
    pub const fn value(self) -> u64 {
        self.0
    }
}
