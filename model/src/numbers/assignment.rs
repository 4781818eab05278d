//! The assignment of least cost: what it is, and the search for it, with the witnesses that show that
//! it found it (`spec/4-arithmetic.md#the-model-is-exact`).

use std::ops::{Add, Sub};

use crate::numbers::reading::Comparisons;
use crate::numbers::real::Real;

/// Costs of pairing row i with column j; `None` forbids the pair.
pub type Costs = Vec<Vec<Option<Real>>>;

/// The least cost of a one-to-one assignment of `pairs` rows to columns: the minimum over all of them,
/// `None` without any. This is the definition; `least_cost` and `costs_less` search.
pub fn minimum_over_assignments(costs: &[Vec<Option<Real>>], pairs: usize) -> Option<Real> {
    fn least(rows: &[Vec<Option<Real>>], free: &[usize], pairs: usize) -> Option<Real> {
        if pairs == 0 {
            return Some(Real::zero());
        }
        let (row, rows) = rows.split_first()?;
        let paired = free.iter().filter_map(|&column| {
            let free: Vec<usize> = free.iter().copied().filter(|&other| other != column).collect();
            Some(row[column].as_ref()? + least(rows, &free, pairs - 1)?)
        });
        paired.chain(least(rows, free, pairs)).min()
    }
    let columns: Vec<usize> = (0..costs.first().map_or(0, Vec::len)).collect();
    least(costs, &columns, pairs)
}

/// Steps that an assignment of so many rows to so many columns takes: min^2 max.
pub fn work(rows: usize, columns: usize) -> i128 {
    let (least, most) = (rows.min(columns) as i128, rows.max(columns) as i128);
    least * least * most
}

/// Whether the mean cost of the cheapest assignment of `pairs` pairs, at least one, is less than
/// `theta`, in a reading. `cost` of the answer is the mean. `Err` is the largest number of pairs, when
/// there are fewer.
pub fn mean_less(
    reads: &Comparisons,
    costs: &Costs,
    pairs: usize,
    theta: &Real,
) -> Result<Comparison, usize> {
    let k = count(pairs);
    let found = costs_less(costs, pairs, &(&k * reads.lowered(theta)))?;
    Ok(Comparison { cost: found.cost / k, ..found })
}

/// A number of things.
pub fn count(things: usize) -> Real {
    Real::from_integer(i128::try_from(things).unwrap_or(i128::MAX))
}

/// A one-to-one assignment of a given number of pairs and a proof that no other is cheaper.
#[derive(Debug)]
pub struct Assignment {
    /// Rows and the columns that they are paired with, rows ascending.
    pub pairs: Vec<(usize, usize)>,
    /// Sum of the costs of the pairs.
    pub cost: Real,
    /// Dual potentials.
    pub dual: Dual,
}

/// A solution of the dual program: lambda - alpha_i - beta_j <= c_ij, alpha and beta >= 0. Every
/// assignment of k pairs costs at least k lambda - sum alpha - sum beta.
#[derive(Debug)]
pub struct Dual {
    /// Price of a pair.
    pub lambda: Real,
    /// Rent of each row.
    pub alpha: Vec<Real>,
    /// Rent of each column.
    pub beta: Vec<Real>,
}

impl Dual {
    /// The bound that it proves, if it is a solution of the dual program.
    pub fn lower_bound(&self, costs: &Costs, pairs: usize) -> Option<Real> {
        let zero = Real::zero();
        let allowed = costs.iter().enumerate().all(|(i, row)| {
            row.iter().enumerate().all(|(j, cost)| {
                cost.as_ref()
                    .is_none_or(|cost| &self.lambda - &self.alpha[i] <= cost + &self.beta[j])
            })
        });
        let rents = self.alpha.iter().chain(&self.beta);
        let solves = allowed && rents.clone().all(|rent| *rent >= zero);
        solves.then(|| count(pairs) * &self.lambda - rents.cloned().sum::<Real>())
    }
}

/// Whether the cheapest one-to-one assignment of exactly `pairs` rows and columns costs less than
/// `bound`. The verdict is that of a witness checked exactly: an assignment that costs less, or dual
/// potentials whose bound is not less. Both are looked for in doubles; only when these do not
/// settle it, because least cost and bound are closer than doubles are, in exact numbers. `Err` is
/// the largest number of pairs, when there are fewer.
pub fn costs_less(costs: &Costs, pairs: usize, bound: &Real) -> Result<Comparison, usize> {
    let doubles: Vec<Vec<Option<f64>>> = (costs.iter())
        .map(|row| row.iter().map(|cost| cost.as_ref().map(Real::near)).collect())
        .collect();
    let found = Search::shortest_paths(&doubles, pairs)?;
    let (cost, of) = (found.cost_in(costs), found.pairs());
    if cost < *bound {
        return Ok(Comparison { less: true, cost, pairs: of });
    }
    if found.dual(costs).lower_bound(costs, pairs).is_some_and(|least| least >= *bound) {
        return Ok(Comparison { less: false, cost, pairs: of });
    }
    let Assignment { cost, pairs, .. } = least_cost(costs, pairs)?;
    Ok(Comparison { less: cost < *bound, cost, pairs })
}

/// Answer of `costs_less`.
#[derive(Debug)]
pub struct Comparison {
    /// The least cost is less than the bound.
    pub less: bool,
    /// Cost of the assignment found: the least, up to what doubles can tell.
    pub cost: Real,
    /// Its rows and columns.
    pub pairs: Vec<(usize, usize)>,
}

/// The cheapest one-to-one assignment of exactly `pairs` rows and columns, by shortest augmenting
/// paths over exact numbers. `Err` is the largest number of pairs, when there are fewer.
///
/// # Panics
/// If the potentials do not prove that the assignment is the cheapest.
pub fn least_cost(costs: &Costs, pairs: usize) -> Result<Assignment, usize> {
    let search = Search::shortest_paths(costs, pairs)?;
    let (cost, dual) = (search.cost_in(costs), search.dual(costs));
    let proves = dual.lower_bound(costs, pairs).is_some_and(|bound| bound >= cost);
    assert!(proves, "the potentials prove the assignment optimal");
    Ok(Assignment { pairs: search.pairs(), cost, dual })
}

/// What the search computes with: exact numbers, or doubles to find a candidate.
trait Number: Clone + PartialOrd + Add<Output = Self> + Sub<Output = Self> {
    fn zero() -> Self;
    fn exact(&self) -> Real;
}

impl Number for Real {
    fn zero() -> Self {
        Self::zero()
    }

    fn exact(&self) -> Real {
        self.clone()
    }
}

impl Number for f64 {
    fn zero() -> Self {
        0.0
    }

    fn exact(&self) -> Real {
        Real::from_double(*self)
    }
}

/// Potentials of a flow from a source over rows and columns to a sink: `u` of the rows, `v` of the
/// columns, `lambda` of the sink; along every usable arc c_ij + u_i - v_j >= 0 and v_j >= lambda
/// at free columns, so that Dijkstra's algorithm finds the shortest augmenting path.
struct Search<'a, N> {
    costs: &'a [Vec<Option<N>>],
    u: Vec<N>,
    v: Vec<N>,
    lambda: N,
    of_row: Vec<Option<usize>>,
    of_column: Vec<Option<usize>>,
}

/// Shortest distances to the columns, over which row, and which of them are final.
struct Tree<N> {
    distance: Vec<Option<N>>,
    over_row: Vec<usize>,
    done: Vec<bool>,
}

impl<'a, N: Number> Search<'a, N> {
    fn shortest_paths(costs: &'a [Vec<Option<N>>], pairs: usize) -> Result<Self, usize> {
        let columns = costs.first().map_or(0, Vec::len);
        let mut search = Self {
            costs,
            u: vec![N::zero(); costs.len()],
            v: vec![N::zero(); columns],
            lambda: N::zero(),
            of_row: vec![None; costs.len()],
            of_column: vec![None; columns],
        };
        (0..pairs).try_for_each(|found| if search.augment() { Ok(()) } else { Err(found) })?;
        Ok(search)
    }

    fn pairs(&self) -> Vec<(usize, usize)> {
        self.of_row.iter().enumerate().filter_map(|(i, j)| j.map(|j| (i, j))).collect()
    }

    fn cost_in(&self, costs: &Costs) -> Real {
        self.pairs().iter().filter_map(|&(i, j)| costs[i][j].clone()).sum()
    }

    /// A solution of the dual program near the potentials: alpha is the least that beta allows.
    fn dual(&self, costs: &Costs) -> Dual {
        let (lambda, zero) = (self.lambda.exact(), Real::zero());
        let beta: Vec<Real> =
            self.v.iter().map(|v| (&lambda - v.exact()).max(zero.clone())).collect();
        let alpha = (costs.iter())
            .map(|row| {
                let needed = row
                    .iter()
                    .zip(&beta)
                    .filter_map(|(cost, beta)| cost.as_ref().map(|cost| &lambda - beta - cost));
                needed.fold(zero.clone(), Real::max)
            })
            .collect();
        Dual { lambda, alpha, beta }
    }

    /// Adds one pair at least cost; false when no more pair is possible.
    fn augment(&mut self) -> bool {
        let columns = self.v.len();
        let mut tree = Tree {
            distance: vec![None; columns],
            over_row: vec![0; columns],
            done: vec![false; columns],
        };
        for row in (0..self.costs.len()).filter(|&row| self.of_row[row].is_none()) {
            self.relax(&mut tree, row, &N::zero());
        }
        let mut end: Option<(N, usize)> = None;
        while let Some(column) = nearest(&tree) {
            let Some(distance) = tree.distance[column].clone() else { break };
            if end.as_ref().is_some_and(|(best, _)| *best <= distance) {
                break;
            }
            tree.done[column] = true;
            if let Some(row) = self.of_column[column] {
                self.relax(&mut tree, row, &distance);
            } else {
                let to_sink = distance + self.v[column].clone() - self.lambda.clone();
                if end.as_ref().is_none_or(|(best, _)| to_sink < *best) {
                    end = Some((to_sink, column));
                }
            }
        }
        let Some((length, column)) = end else { return false };
        self.raise_potentials(&tree, &length);
        self.flip_path(&tree, column);
        true
    }

    fn relax(&self, tree: &mut Tree<N>, row: usize, distance: &N) {
        for (column, cost) in self.costs[row].iter().enumerate() {
            let Some(cost) = cost else { continue };
            if tree.done[column] {
                continue;
            }
            let reduced = cost.clone() + self.u[row].clone() - self.v[column].clone();
            let through = distance.clone() + reduced;
            if tree.distance[column].as_ref().is_none_or(|known| through < *known) {
                tree.distance[column] = Some(through);
                tree.over_row[column] = row;
            }
        }
    }

    fn raise_potentials(&mut self, tree: &Tree<N>, length: &N) {
        for column in 0..self.v.len() {
            let step = match &tree.distance[column] {
                Some(distance) if distance < length => distance.clone(),
                Some(_) | None => length.clone(),
            };
            if let Some(row) = self.of_column[column] {
                self.u[row] = self.u[row].clone() + step.clone();
            }
            self.v[column] = self.v[column].clone() + step;
        }
        self.lambda = self.lambda.clone() + length.clone();
    }

    fn flip_path(&mut self, tree: &Tree<N>, end: usize) {
        let mut column = end;
        loop {
            let row = tree.over_row[column];
            let before = self.of_row[row];
            self.of_row[row] = Some(column);
            self.of_column[column] = Some(row);
            match before {
                Some(previous) => column = previous,
                None => return,
            }
        }
    }
}

/// The column at the least distance that is not final.
fn nearest<N: Number>(tree: &Tree<N>) -> Option<usize> {
    let mut nearest: Option<(usize, &N)> = None;
    for (column, distance) in tree.distance.iter().enumerate() {
        let Some(distance) = distance.as_ref().filter(|_| !tree.done[column]) else { continue };
        if nearest.is_none_or(|(_, least)| distance < least) {
            nearest = Some((column, distance));
        }
    }
    nearest.map(|(column, _)| column)
}

#[cfg(test)]
mod tests {
    use super::{Costs, costs_less, least_cost, minimum_over_assignments};
    use crate::numbers::real::Real;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn least_cost_is_the_minimum_over_all_assignments() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut draw = |bound: usize| random.random_range(0..bound);
        let (mut infeasible, mut feasible) = (0, 0);
        for _ in 0..1500 {
            let (rows, columns, density) = (draw(6), draw(6), draw(7));
            // Roots of small integers: many ties, exact ones among them.
            let costs: Costs = (0..rows)
                .map(|_| {
                    (0..columns)
                        .map(|_| {
                            (draw(8) > density).then(|| {
                                Real::from_integer(i128::try_from(draw(12)).unwrap_or(0)).sqrt()
                            })
                        })
                        .collect()
                })
                .collect();
            for pairs in 0..=rows.min(columns) {
                let expected = minimum_over_assignments(&costs, pairs);
                match (least_cost(&costs, pairs), expected) {
                    (Ok(found), Some(expected)) => {
                        assert_eq!(found.cost, expected);
                        // On the least cost, where doubles cannot tell, and beside it.
                        let tiny = Real::from_double(1e-30);
                        let less =
                            |bound: Real| costs_less(&costs, pairs, &bound).expect("feasible").less;
                        assert!(!less(expected.clone()) && !less(&expected - &tiny));
                        assert!(less(&expected + &tiny) && less(expected + Real::from_integer(1)));
                        feasible += 1;
                    }
                    (Err(most), None) => {
                        assert!(most < pairs);
                        infeasible += 1;
                    }
                    (found, expected) => panic!("{costs:?} {found:?} {expected:?}"),
                }
            }
        }
        assert!(feasible > 500 && infeasible > 100, "{feasible} {infeasible}");
    }
}
