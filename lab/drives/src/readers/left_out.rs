//! Lanelets whose bounds are not what they should be: the drive does without them, where it can.

use crate::counted;
use crate::geometry::Point;
use crate::readers::error::ReadError;
use crate::readers::lanes::{Change, Lanelet, Network, Run};
use crate::readers::sides::Inversion;
use crate::readers::xml::Element;

/// Lanelets that a note names.
pub(crate) const NAMED_MAX: usize = 8;

/// A lanelet that is no part of the network.
pub(crate) struct LeftOut {
    pub lanelet: Lanelet,
    /// Where its bounds are on the wrong sides.
    pub inversion: Inversion,
    /// What is wrong with it.
    pub error: ReadError,
}

impl LeftOut {
    pub(crate) fn of(lanelet: Lanelet, inversion: Inversion, element: Element<'_>) -> Self {
        let wrong = "the left bound is not left of the right one";
        let error = match inversion {
            Inversion::Whole => element.error("leftBound", wrong),
            Inversion::Segment(i) => {
                let message = format!("{wrong} from this point to the next");
                element.error("leftBound", message).index(i)
            }
        };
        Self { lanelet, inversion, error }
    }

    /// The id, and the segment where it is one.
    fn name(&self) -> String {
        match self.inversion {
            Inversion::Whole => self.lanelet.id.to_string(),
            Inversion::Segment(i) => format!("{} (segment {i})", self.lanelet.id),
        }
    }
}

/// What is said of the lanelets left out of a network; `None` where there are none.
pub(crate) fn note(left_out: &[LeftOut]) -> Option<String> {
    if left_out.is_empty() {
        return None;
    }
    let names: Vec<_> = left_out.iter().take(NAMED_MAX).map(LeftOut::name).collect();
    let more = if left_out.len() > NAMED_MAX { " ..." } else { "" };
    Some(format!(
        "{} left out, whose left bound is not left of the right one: {}{more}",
        counted(left_out.len(), "lanelet"),
        names.join(" ")
    ))
}

/// What is wrong with the lanelet left out that a drive along these poses and runs needs: a pose is
/// on it and on no other that leads its way, or it is next to where one run breaks off and another
/// begins. `None` where the drive does without them all.
pub(crate) fn needed(
    left_out: &[LeftOut],
    network: &Network,
    poses: &[(Point, f64)],
    runs: &[Run],
) -> Option<ReadError> {
    let stands_alone = |lanelet: &Lanelet| {
        poses.iter().any(|(p, heading)| lanelet.contains(*p) && !network.covers(*p, *heading))
    };
    let connects = |lanelet: &Lanelet| {
        let pairs = runs.windows(2).filter(|pair| pair[0].change == Some(Change::Jump));
        pairs.filter_map(|pair| Some((pair[0].lanelets.last()?, pair[1].lanelets.first()?))).any(
            |(last, first)| {
                let before = network.lanelets.get(last);
                before.is_some_and(|it| it.successors.contains(&lanelet.id))
                    || lanelet.successors.contains(first)
            },
        )
    };
    let needed = left_out.iter().find(|it| stands_alone(&it.lanelet) || connects(&it.lanelet))?;
    let message = format!("{}, and the route leads over this lanelet", needed.error.message);
    Some(ReadError { message, ..needed.error.clone() })
}
