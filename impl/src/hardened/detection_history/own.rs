//! The items of a list that are one track's own: nearest to where it was at the time of the list,
//! and of no other track.

use crate::hardened::detection_history::squares::{CLOSE, Listed, MARGIN, Squares};
use crate::input::cycle::{Detection, Track};
use crate::input::scratch::{Column, NONE, Row, Scratch, short};
use crate::numbers::plane::same_point;
use crate::numbers::range::smaller;
use crate::numbers::time::seconds;
use crate::report::{Rule, Witness};

/// The item of a list that is nearest to where tracks were at its time.
pub(super) struct Search<'a> {
    squares: Squares<'a>,
    /// An item that is farther is none, m.
    reach: f64,
    /// Squares: of less than the reach, of more, and of more by 1 m, m^2.
    near: f64,
    far: f64,
    wide: f64,
    /// From the stamp of the tracks to that of the list, s.
    since: f64,
}

/// An item, and how far it and the next one at another place are, m^2.
#[derive(Clone, Copy)]
struct Nearest {
    item: usize,
    squared: f64,
    next: f64,
}

impl Nearest {
    const NONE: Self = Self { item: 0, squared: f64::MAX, next: f64::MAX };

    /// Another item, at this distance (SEEN-06, SEEN-09). At the same place as the nearest it is as
    /// far; the first of several is it then.
    #[inline]
    fn compare(&mut self, item: usize, squared: f64, items: &[Detection]) {
        if squared < self.squared {
            *self = Self { item, squared, next: self.squared };
        } else if squared < self.next {
            if squared > self.squared || !self.is_at_the_place_of(item, items) {
                self.next = squared;
            } else {
                self.item = self.item.min(item);
            }
        }
    }

    #[cold]
    fn is_at_the_place_of(&self, item: usize, items: &[Detection]) -> bool {
        let [one, other] = [self.item, item].map(|item| items.get(item).map(|it| [it.x, it.y]));
        one.zip(other).is_some_and(|(one, other)| same_point(one, other))
    }
}

/// In `Column::owner`: more than one track has the item.
const SHARED: u16 = NONE - 1;

/// The item is nobody's own.
#[cold]
fn share(column: &mut Column, mark: u16, rows: &mut [Row]) {
    let owner = rows.get_mut(usize::from(column.owner));
    owner.into_iter().for_each(|row| row.seen &= !mark);
    column.owner = SHARED;
}

impl<'a> Search<'a> {
    pub(super) fn new(list: Listed<'a>, reach: f64, since_ns: i64, columns: &mut [Column]) -> Self {
        let squares = Squares::of(list, 4.0 * (reach + MARGIN), 0, columns);
        let square = |reach: f64| reach * reach;
        let (near, far) = (square(reach - 2.0 * CLOSE), square(reach + 2.0 * CLOSE));
        Self { squares, reach, near, far, wide: square(reach + 1.0), since: seconds(since_ns) }
    }

    /// Writes the mark into the rows of the tracks whose item is that of no other track (SEEN-07),
    /// and which it is where it is a current detection; fails when it is too close to call.
    pub(super) fn mark_own(
        &self,
        (mark, is_detection): (u16, bool),
        tracks: &[Track],
        scratch: &mut Scratch<'_>,
    ) -> Option<Witness> {
        let (rows, columns) = (&mut *scratch.rows, &mut *scratch.columns);
        let items = self.squares.items().len();
        columns.iter_mut().take(items).for_each(|column| column.owner = NONE);
        for (index, track) in tracks.iter().enumerate() {
            let item = match self.item_of(track, columns) {
                Ok(item) => item,
                Err(away) => return Some(too_close(track, [away, self.reach])),
            };
            let Some(column) = columns.get_mut(usize::from(item)) else { continue };
            if column.owner != NONE {
                share(column, mark, rows);
                continue;
            }
            column.owner = short(index);
            if let Some(row) = rows.get_mut(index) {
                if is_detection {
                    row.detection = item;
                }
                row.seen |= mark;
            }
        }
        None
    }

    /// The item of a track, or `NONE`; when it is too close to call, how far the nearest one is, m. Without
    /// `clearly_nearest` stage i of W1 and W2 takes 80 to 90 % more instructions.
    #[inline]
    fn item_of(&self, track: &Track, columns: &[Column]) -> Result<u16, f64> {
        let moved = [track.vx * self.since, track.vy * self.since];
        let index = self.squares.index();
        match index.and_then(|index| index.clearly_nearest([track.x, track.y], moved)) {
            Some((item, squared)) if squared < self.near => Ok(item),
            Some((_, squared)) if squared > self.far => Ok(NONE),
            Some(_) | None => self.item_by_squares(track, columns),
        }
    }

    #[inline(never)]
    fn item_by_squares(&self, track: &Track, columns: &[Column]) -> Result<u16, f64> {
        let nearest = self.nearest(track, columns);
        match self.is_near(&nearest) {
            Some(true) => Ok(short(nearest.item)),
            Some(false) => Ok(NONE),
            None => Err(libm::sqrt(nearest.squared)),
        }
    }

    /// By the square of the place, where that tells; in a crowd it is most of what is not looked at.
    #[inline]
    fn nearest(&self, track: &Track, columns: &[Column]) -> Nearest {
        let (dx, dy) = (track.vx * self.since, track.vy * self.since);
        let place = [track.x + dx, track.y + dy];
        let items = self.squares.items();
        let mut nearest = Nearest::NONE;
        let away = self.squares.for_each_beside(columns, place, |item, [x, y]| {
            let (to_x, to_y) = ((track.x - x) + dx, (track.y - y) + dy);
            nearest.compare(item, to_x * to_x + to_y * to_y, items);
        });
        // Whatever is in another square is farther than that.
        if away > 0.0 && (nearest.squared < away * away || away > self.reach + MARGIN) {
            return nearest;
        }
        self.nearest_around(track, libm::sqrt(nearest.squared), columns)
    }

    /// The same by all squares that may hold something as near as that, or within reach.
    #[inline(never)]
    fn nearest_around(&self, track: &Track, away: f64, columns: &[Column]) -> Nearest {
        let (dx, dy) = (track.vx * self.since, track.vy * self.since);
        let (items, reach) = (self.squares.items(), smaller(away, self.reach) + MARGIN);
        let near = [track.x + dx, track.y + dy].map(|at| [at - reach, at + reach]);
        let mut nearest = Nearest::NONE;
        self.squares.for_each_in(columns, near, |item, [x, y]| {
            let (to_x, to_y) = ((track.x - x) + dx, (track.y - y) + dy);
            nearest.compare(item, to_x * to_x + to_y * to_y, items);
        });
        nearest
    }

    /// Whether the item is within reach; `None` when that is too close to call, or which item is.
    #[inline]
    fn is_near(&self, nearest: &Nearest) -> Option<bool> {
        if nearest.squared > self.far {
            return Some(false);
        }
        // Roots that are at most `reach` + 1 differ by more than half of this over that.
        let ahead = smaller(nearest.next, self.wide) - nearest.squared;
        if nearest.squared < self.near && ahead > 4.0 * CLOSE * self.wide {
            return Some(true);
        }
        self.is_certainly_near(nearest)
    }

    #[cold]
    fn is_certainly_near(&self, nearest: &Nearest) -> Option<bool> {
        let away = libm::sqrt(nearest.squared);
        if away > self.reach + CLOSE {
            return Some(false);
        }
        let is_clear = away < self.reach - CLOSE && libm::sqrt(nearest.next) - away > CLOSE;
        is_clear.then_some(true)
    }
}

pub(super) fn too_close(track: &Track, compared: [f64; 2]) -> Witness {
    Witness { track: Some(track.id), ..Witness::of(Rule::Ambiguous, compared) }
}
