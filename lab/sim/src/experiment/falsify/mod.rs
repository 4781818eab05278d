//! A search for collisions: an attacker who knows every rule tries what the rules let pass.
//!
//! Attacks are points of a unit cube (`genome`). In rounds of new scenarios, random points first; then, from
//! the best of them that did not collide, searches by CMA-ES side by side (`cma`), each in its scenario. What
//! is sought is little time left to react (`danger`). A collision in a run that has none without the
//! attacks is shrunk (`shrink`) and kept so that it can be made again (`found`).
//!
//! A number of runs and a seed give the same with any number of threads: points are drawn before their runs
//! are made, and runs are looked at in their order. Rounds do not know of each other (`rounds`): other machines can
//! make some of them.

pub mod caller;
pub mod cma;
pub mod danger;
pub mod found;
pub mod genome;
pub mod rounds;
pub mod shrink;

use std::collections::BTreeMap;

use rayon::prelude::*;

pub use self::caller::{Caller, Progress};
use self::cma::{Cma, anywhere};
use self::danger::Danger;
use self::found::{Case, Found};
use self::genome::{Clean, GENES, decode};
use self::rounds::explains;
pub use self::rounds::{Falsified, Options, Round, Row, Try};
use super::axes::Offered;
use super::select::Shard;
use crate::attack::Kind;
use crate::map::Town;
use crate::run::RunError;
use crate::vehicle::TAU_S;

/// Its name.
pub const NAME: &str = "falsify";

/// Scenarios of a round, and random points in each.
const STARTS: u64 = 8;
const POINTS: u64 = 7;
/// Searches of a round, points of a generation, and generations.
const SEARCHES: usize = 4;
const GENERATION: usize = 10;
const GENERATIONS: usize = 8;
/// Who came nearer than this in the clean run can be lied about, m.
const NEAR: f64 = 30.0;
/// A collision is lower than any time left, s.
const COLLISION: f64 = -1.0;

/// Searches.
///
/// Errors: a town that cannot be.
pub fn experiment(
    town: &Town,
    options: Options,
    caller: &impl Caller,
) -> Result<Falsified, RunError> {
    let mut made = Falsified::nothing(options);
    while made.left() > 0 && caller.goes_on() && !caller.is_interrupted() {
        let round = Search::new(town, &made, made.rounds, caller).round()?;
        made.add(town, round, caller)?;
    }
    made.interrupted = caller.is_interrupted();
    Ok(made)
}

/// The rounds of a part of so many rounds, each with its number from 0, for other machines to make the others. Those
/// up to an interrupt, the last one perhaps in part.
///
/// Errors: a town that cannot be.
pub fn part(
    town: &Town,
    options: &Options,
    shard: Shard,
    caller: &impl Caller,
) -> Result<BTreeMap<u64, Round>, RunError> {
    let nothing = Falsified::nothing(options.clone());
    let numbers = 0..options.rounds.unwrap_or(0);
    let mine = numbers.filter(|it| shard.has(usize::try_from(*it).unwrap_or(usize::MAX)));
    let one = |number| Ok((number, Search::new(town, &nothing, number, caller).round()?));
    mine.take_while(|_| !caller.is_interrupted()).map(one).collect()
}

/// A scenario in which attacks are tried.
struct Start {
    case: Case,
    clean: Clean,
}

/// A point, in a scenario of the round.
#[derive(Clone, Copy)]
struct Point {
    start: usize,
    genes: [f64; GENES],
}

/// What came of a point.
struct Tried {
    case: Case,
    found: Option<Found>,
    time_left: f64,
    distance: Option<f64>,
}

struct Search<'a, C> {
    town: &'a Town,
    caller: &'a C,
    /// What the rounds before came to: it says how much may be done, and nothing about what.
    before: &'a Falsified,
    /// Which round it is, from 0.
    number: u64,
    least: f64,
    rows: BTreeMap<Option<Kind>, Row>,
    result: Round,
}

impl<'a, C: Caller> Search<'a, C> {
    fn new(town: &'a Town, before: &'a Falsified, number: u64, caller: &'a C) -> Self {
        let of = |row: &Row| if row.collided > 0 { COLLISION } else { row.least_time_left_s };
        let least = before.rows.iter().map(of).fold(danger::FREE_S, f64::min);
        let (rows, result) = (BTreeMap::new(), Round::default());
        Self { town, caller, before, number, least, rows, result }
    }

    fn left(&self) -> u64 {
        self.before.left().saturating_sub(self.result.runs)
    }

    fn has_budget(&self) -> bool {
        self.left() > 0 && self.caller.goes_on() && !self.caller.is_interrupted()
    }

    fn options(&self) -> &'a Options {
        &self.before.options
    }

    /// A round to its end, or to that of the budget.
    fn round(mut self) -> Result<Round, RunError> {
        self.search()?;
        Ok(Round { rows: self.rows.into_values().collect(), ..self.result })
    }

    /// New scenarios, random points, and searches from the best of them.
    fn search(&mut self) -> Result<(), RunError> {
        let starts = self.starts()?;
        let (seed, round) = (self.options().seed, self.number);
        let random = |index: u64| Point {
            start: usize::try_from(index / POINTS).unwrap_or(0),
            genes: anywhere([seed, round * STARTS * POINTS + index]),
        };
        let count = u64::try_from(starts.len()).unwrap_or(0) * POINTS;
        let points: Vec<Point> = (0..count).map(random).collect();
        let tried = self.batch(&starts, &points, true)?;
        self.result.collided_at_random += self.result.collided;
        if !self.has_budget() {
            return Ok(());
        }
        let mut best: Vec<usize> = (0..tried.len()).filter(|&it| !tried[it].1).collect();
        best.sort_by(|&a, &b| tried[a].0.total_cmp(&tried[b].0));
        best.truncate(SEARCHES);
        let of = |(index, &best): (u64, &usize)| {
            let Point { start, genes } = points[best];
            (start, Cma::new(genes, GENERATION, [seed, round * 100 + index]))
        };
        let mut searches: Vec<(usize, Cma)> = (0..).zip(&best).map(of).collect();
        for _ in 0..GENERATIONS {
            if searches.is_empty() || !self.has_budget() {
                return Ok(());
            }
            self.generation(&starts, &mut searches)?;
        }
        Ok(())
    }

    /// One generation of all searches; those that found a collision end, but for one when the CAV could
    /// have stood.
    fn generation(
        &mut self,
        starts: &[Start],
        searches: &mut Vec<(usize, Cma)>,
    ) -> Result<(), RunError> {
        let mut points = Vec::new();
        for (start, cma) in searches.iter_mut() {
            let start = *start;
            points.extend(cma.ask(GENERATION).into_iter().map(|genes| Point { start, genes }));
        }
        let tried = self.batch(starts, &points, false)?;
        if self.caller.is_interrupted() {
            return Ok(());
        }
        let mut kept = Vec::new();
        let parts = points.chunks(GENERATION).zip(tried.chunks(GENERATION));
        for ((start, mut cma), (points, tried)) in searches.drain(..).zip(parts) {
            if tried.len() < points.len() || tried.iter().any(|it| it.1) {
                continue;
            }
            let mut order: Vec<usize> = (0..points.len()).collect();
            order.sort_by(|&a, &b| tried[a].0.total_cmp(&tried[b].0));
            cma.tell(&order.into_iter().map(|it| points[it].genes).collect::<Vec<_>>());
            kept.push((start, cma));
        }
        *searches = kept;
        Ok(())
    }

    /// The scenarios of a round, and what the attacker learns from their runs without an attack.
    fn starts(&mut self) -> Result<Vec<Start>, RunError> {
        let &Options { variant, vehicles, seed, .. } = self.options();
        let (town, round, caller) = (self.town, self.number, self.caller);
        let one = |index: u64| {
            if caller.is_interrupted() {
                return Ok(None);
            }
            let route = usize::from(index % 2 == 1);
            let scenario = seed.wrapping_add(round * STARTS / 2 + index / 2);
            let offered = Offered::Both;
            let drives_on = false;
            let (tau_s, attacks, map) = (TAU_S, Vec::new(), town.id);
            let case = Case {
                variant,
                tau_s,
                drives_on,
                offered,
                route,
                scenario,
                vehicles,
                attacks,
                map,
            };
            let mut danger = Danger::default();
            let outcome = case.run(town, &mut danger)?;
            let clean =
                Clean { remote: danger.remote_times(), near: danger.near(NEAR), seed: scenario };
            let collided = case.found(&outcome, &danger).map(|it| it.is_after());
            let time_left = danger.least_time_left(&town.routes[case.ego_route(town)], 0.0);
            Ok(Some((Start { case, clean }, collided, time_left, danger.least_distance(0.0))))
        };
        let made: Vec<_> = (0..STARTS).into_par_iter().map(one).collect::<Result<_, _>>()?;
        let mut starts = Vec::new();
        for (start, collided, time_left, distance) in made.into_iter().flatten() {
            self.count(None, collided, time_left, distance);
            self.result.clean_collided += u64::from(collided.is_some());
            if collided.is_none() {
                starts.push(start);
            }
        }
        Ok(starts)
    }

    /// Makes the runs of points, as far as there is budget: what each is worth, and whether it ends its search by a
    /// collision. Of an interrupted batch these are fewer, and of any of its points.
    fn batch(
        &mut self,
        starts: &[Start],
        points: &[Point],
        is_random: bool,
    ) -> Result<Vec<(f64, bool)>, RunError> {
        let count = points.len().min(usize::try_from(self.left()).unwrap_or(usize::MAX));
        let (town, caller) = (self.town, self.caller);
        let kinds = &self.options().kinds;
        let one = |point: &Point| {
            if caller.is_interrupted() {
                return Ok(None);
            }
            let tried = try_point(town, &starts[point.start], kinds, &point.genes)?;
            caller.tell(Progress::Run);
            Ok(Some(tried))
        };
        let made: Vec<Option<Tried>> =
            points[..count].par_iter().map(one).collect::<Result<_, _>>()?;
        let tried: Vec<Tried> = made.into_iter().flatten().collect();
        self.result.runs += u64::try_from(tried.len()).unwrap_or(0);
        for it in &tried {
            let mut kinds: Vec<Kind> = it.case.attacks.iter().map(|it| it.kind).collect();
            kinds.sort_unstable();
            kinds.dedup();
            for kind in kinds {
                self.count(
                    Some(kind),
                    it.found.as_ref().map(Found::is_after),
                    it.time_left,
                    it.distance,
                );
            }
            self.result.collided += u64::from(it.found.is_some());
            let time_left_s = Some(it.time_left).filter(|_| it.found.is_none());
            self.result.tries.push(Try { round: self.number, is_random, time_left_s });
            self.least = self.least.min(if it.found.is_some() { COLLISION } else { it.time_left });
            let Some(found) = &it.found else { continue };
            if !self.result.found.iter().any(|old| explains(old, found)) {
                self.result.found.push(found.clone());
            }
        }
        caller.tell(Progress::Looked(self.least, self.before.collided + self.result.collided));
        let worth = |it: Tried| {
            let collided = it.found.is_some_and(|it| !it.is_after());
            (caller.worth(if collided { COLLISION } else { it.time_left }), collided)
        };
        Ok(tried.into_iter().map(worth).collect())
    }

    /// Counts a run; `collided`: if it did, whether it could have stood before.
    fn count(
        &mut self,
        attack: Option<Kind>,
        collided: Option<bool>,
        time_left: f64,
        distance: Option<f64>,
    ) {
        let one = Row {
            attack,
            runs: 1,
            collided: u64::from(collided.is_some()),
            after: u64::from(collided == Some(true)),
            least_time_left_s: if collided.is_some() { danger::FREE_S } else { time_left },
            least_distance_m: distance.filter(|_| collided.is_none()),
        };
        self.rows.entry(attack).and_modify(|row| *row = row.with(one)).or_insert(one);
    }
}

fn try_point(
    town: &Town,
    start: &Start,
    kinds: &[Kind],
    genes: &[f64; GENES],
) -> Result<Tried, RunError> {
    let (offered, attacks) = decode(genes, kinds, &start.clean);
    let case = Case { offered, attacks, ..start.case.clone() };
    let mut danger = Danger::default();
    let outcome = case.run(town, &mut danger)?;
    let found = case.found(&outcome, &danger);
    // The clean run of the scenario was offered everything; one that is offered less may collide by itself.
    let clean = Case { attacks: Vec::new(), ..case.clone() };
    let found = match found {
        Some(_) if offered != Offered::Both && clean.collision(town)?.is_some() => None,
        found => found,
    };
    let route = &town.routes[case.ego_route(town)];
    let time_left = danger.least_time_left(route, case.begins());
    let distance = danger.least_distance(case.begins());
    Ok(Tried { case, found, time_left, distance })
}
