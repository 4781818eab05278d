//! A collision made small: fewer attacks, shorter, by less, and still a collision.

use super::caller::Caller;
use super::found::{Case, Found};
use crate::attack::means::{Lists, Means};
use crate::attack::{Attack, Kind};
use crate::map::Town;
use crate::run::RunError;

/// Steps by which a number comes nearer to its neutral value, each by half.
const HALVINGS: u32 = 5;

/// The smallest that is found by leaving out and halving one thing after the other, and the runs that it took; after an
/// interrupt, the smallest until then.
///
/// Errors: those of a run.
pub fn shrunk(town: &Town, found: &Found, caller: &impl Caller) -> Result<(Found, u64), RunError> {
    let mut shrinking = Shrinking { town, caller, best: found.clone(), runs: 0 };
    shrinking.fewer()?;
    for index in 0..shrinking.best.case.attacks.len() {
        shrinking.shorter(index)?;
        shrinking.less(index)?;
        shrinking.rounder(index)?;
    }
    Ok((shrinking.best, shrinking.runs))
}

struct Shrinking<'a, C> {
    town: &'a Town,
    caller: &'a C,
    best: Found,
    runs: u64,
}

impl<C: Caller> Shrinking<'_, C> {
    /// Takes a smaller one if it collides, too.
    fn offer(&mut self, case: &Case) -> Result<bool, RunError> {
        if self.caller.is_interrupted() {
            return Ok(false);
        }
        self.runs += 1;
        let found = case.collision(self.town)?;
        // One while remote results were used is not shrunk to one long after.
        let found = found.filter(|it| it.is_after() == self.best.is_after());
        let is_taken = found.is_some();
        if let Some(found) = found {
            self.best = found;
        }
        Ok(is_taken)
    }

    fn with(&mut self, index: usize, change: impl Fn(&mut Attack)) -> Result<bool, RunError> {
        let mut case = self.best.case.clone();
        change(&mut case.attacks[index]);
        Ok(case != self.best.case && self.offer(&case)?)
    }

    fn fewer(&mut self) -> Result<(), RunError> {
        let mut index = 0;
        while self.best.case.attacks.len() > 1 && index < self.best.case.attacks.len() {
            let mut case = self.best.case.clone();
            case.attacks.remove(index);
            if !self.offer(&case)? {
                index += 1;
            }
        }
        Ok(())
    }

    /// Ends with the collision, then halves from either side.
    fn shorter(&mut self, index: usize) -> Result<(), RunError> {
        let end = self.best.t_s;
        self.with(index, |it| it.until = it.until.min(end))?;
        for _ in 0..HALVINGS {
            self.with(index, |it| it.until = f64::midpoint(it.from, it.until))?;
            self.with(index, |it| it.from = f64::midpoint(it.from, it.until))?;
        }
        Ok(())
    }

    /// Nobody in particular is lied about, on one list; and each number nearer to that of no attack.
    fn less(&mut self, index: usize) -> Result<(), RunError> {
        for lists in [Lists::Planner, Lists::Cav] {
            if self.best.case.attacks[index].means.lists == Lists::Both {
                self.with(index, |it| it.means.lists = lists)?;
            }
        }
        let neutral = neutral(self.best.case.attacks[index].kind);
        for place in PLACES {
            let nothing = *place(&mut neutral.clone());
            if self.with(index, |it| *place(&mut it.means) = nothing)? {
                continue;
            }
            for _ in 0..HALVINGS {
                let nearer = |it: &mut Attack| {
                    let value = place(&mut it.means);
                    *value = f64::midpoint(*value, nothing);
                };
                if !self.with(index, nearer)? {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Fewer digits.
    fn rounder(&mut self, index: usize) -> Result<(), RunError> {
        for digits in [1.0, 10.0, 100.0] {
            let round = |value: &mut f64| *value = (*value * digits).round() / digits;
            let all = |it: &mut Attack| {
                round(&mut it.from);
                round(&mut it.until);
                PLACES.iter().for_each(|place| round(place(&mut it.means)));
            };
            if self.with(index, all)? {
                break;
            }
        }
        Ok(())
    }
}

type Place = fn(&mut Means) -> &mut f64;

/// The numbers of an attack.
const PLACES: [Place; 7] = [
    |it| &mut it.ahead_m,
    |it| &mut it.left_m,
    |it| &mut it.speed_mps,
    |it| &mut it.factor,
    |it| &mut it.turn_rad,
    |it| &mut it.late_s,
    |it| &mut it.acceleration_mps2,
];

/// What does least: no lie at all, and a made-up vehicle far away.
const fn neutral(kind: Kind) -> Means {
    let ahead_m = if matches!(kind, Kind::MadeUpLead) { 60.0 } else { 0.0 };
    Means { ahead_m, ..Means::NONE }
}
