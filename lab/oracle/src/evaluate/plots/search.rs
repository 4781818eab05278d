//! The chart of a search.

use mufasa_sim::experiment::falsify::Falsified;
use mufasa_sim::experiment::falsify::danger::FREE_S;

use super::figures::{Figure, figure};
use super::lines::{self, COLLIDED, Tried};
use super::page::{Mark, Series};

/// The time left to react in every run of a search.
pub fn falsified(of: &Falsified) -> Vec<Figure> {
    let (random, guided) = (
        Series { name: "at random", ..Series::SOFOF },
        Series { name: "by CMA-ES, from the best of them", mark: Mark::Circle, ..Series::PAPER },
    );
    let random = Series { mark: Mark::Circle, ..random };
    let tried = of.tries.iter().map(|it| Tried {
        series: if it.is_random { random } else { guided },
        value: it.time_left_s,
    });
    let tried: Vec<Tried> = tried.collect();
    let rounds = of.tries.windows(2).enumerate();
    let rounds = rounds.filter(|(_, it)| it[0].round != it[1].round).map(|(at, _)| at + 1);
    let svg = lines::search(
        "The search for collisions",
        &[
            "Least time left to react of each run; at 0 nothing helps any more. The line is the least up to then;",
            "upright lines part the rounds, which have new scenarios.",
        ],
        &[random, guided, COLLIDED],
        ("time left to react, s", FREE_S),
        (&tried, &rounds.collect::<Vec<_>>()),
    );
    vec![figure(mufasa_sim::experiment::falsify::NAME, svg)]
}
