//! What of a cycle's inputs the stages do not get: experiments leave out a stage by leaving out what it needs.

use mufasa::input::cycle::Cycle;
use mufasa::services::configuration::{Configuration, Group};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the stages do not get.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Withheld {
    /// Received lists without tracks: they are no lists (I-11 the other way), and stages i and iii have none.
    EmptyLists,
    /// The grid: no stage v.
    Grid,
    /// The detections: no stages i and iv, nor what H-14 and the history rest on.
    Detections,
}

impl Withheld {
    /// Whether a list of so many tracks is not given in this configuration.
    pub(crate) fn is_no_list(self, configuration: Configuration, tracks: usize) -> bool {
        self == Self::EmptyLists && tracks == 0 && configuration.is_remote(Group::Mot)
    }

    /// The cycle without it.
    pub(crate) fn taken_from(self, mut cycle: Cycle<'_>) -> Cycle<'_> {
        let configuration = cycle.configuration;
        cycle.tracks =
            cycle.tracks.filter(|list| !self.is_no_list(configuration, list.items.len()));
        if self == Self::Grid {
            cycle.grid = None;
        }
        if self == Self::Detections {
            (cycle.detections, cycle.detection_history) = (None, &[]);
        }
        cycle
    }
}
