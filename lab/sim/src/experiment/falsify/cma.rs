//! The covariance matrix adaptation evolution strategy (Hansen, The CMA Evolution Strategy: A Tutorial,
//! arXiv:1604.00772), asked for points and told their order.
//!
//! Written here because the crate `cmaes` (0.2.2) calls the objective itself, one instance after the other, and
//! uses std's functions, whose last bits differ between platforms: several searches side by side in the same
//! bytes with any number of threads need points first and values later.

use nalgebra::{SMatrix, SVector, SymmetricEigen};

use super::genome::GENES;
use crate::services::detectors::random::Draws;

type Vector = SVector<f64, GENES>;
type Matrix = SMatrix<f64, GENES, GENES>;

/// A search around a place.
#[derive(Clone, Debug)]
pub struct Cma {
    mean: Vector,
    sigma: f64,
    covariance: Matrix,
    path_c: Vector,
    path_sigma: Vector,
    generation: u32,
    draws: Draws,
    /// Points of a generation that the mean moves to, with their weights.
    weights: Vec<f64>,
}

/// Places are asked for so far from the mean, in each gene, at the start.
const SIGMA: f64 = 0.15;

impl Cma {
    /// A search around a place, of so many points in a generation, at least 4.
    pub fn new(start: [f64; GENES], points: usize, seed: [u64; 2]) -> Self {
        let half = points.max(4) / 2;
        #[expect(clippy::cast_precision_loss, reason = "a few points")]
        let raw: Vec<f64> =
            (1..=half).map(|i| libm::log(half as f64 + 0.5) - libm::log(i as f64)).collect();
        let sum: f64 = raw.iter().sum();
        Self {
            mean: Vector::from(start),
            sigma: SIGMA,
            covariance: Matrix::identity(),
            path_c: Vector::zeros(),
            path_sigma: Vector::zeros(),
            generation: 0,
            draws: Draws::new([seed[0], seed[1], 11, 0]),
            weights: raw.iter().map(|it| it / sum).collect(),
        }
    }

    /// The points of the next generation. They are not held to [0, 1]: `decode` folds them back.
    pub fn ask(&mut self, points: usize) -> Vec<[f64; GENES]> {
        let (axes, scales) = self.axes();
        let one = |_| {
            let mut z = Vector::zeros();
            for pair in 0..GENES.div_ceil(2) {
                for (index, value) in self.draws.normal_pair().into_iter().enumerate() {
                    if let Some(place) = z.get_mut(2 * pair + index) {
                        *place = value;
                    }
                }
            }
            let y = axes * scales.component_mul(&z);
            (self.mean + y * self.sigma).into()
        };
        (0..points).map(one).collect()
    }

    /// Takes the points of a generation, the best first.
    pub fn tell(&mut self, best_first: &[[f64; GENES]]) {
        #[expect(clippy::cast_precision_loss, reason = "a few")]
        let n = GENES as f64;
        let chosen: Vec<Vector> = best_first
            .iter()
            .take(self.weights.len())
            .map(|it| (Vector::from(*it) - self.mean) / self.sigma)
            .collect();
        let weighted = |of: &dyn Fn(&Vector) -> Vector| -> Vector {
            chosen.iter().zip(&self.weights).map(|(y, w)| of(y) * *w).sum()
        };
        let mu_eff = 1.0 / self.weights.iter().map(|w| w * w).sum::<f64>();
        let c_sigma = (mu_eff + 2.0) / (n + mu_eff + 5.0);
        let d_sigma =
            1.0 + c_sigma + 2.0 * (((mu_eff - 1.0) / (n + 1.0)).max(0.0).sqrt() - 1.0).max(0.0);
        let c_c = (4.0 + mu_eff / n) / (n + 4.0 + 2.0 * mu_eff / n);
        let c_1 = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff);
        let c_mu =
            (1.0 - c_1).min(2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / ((n + 2.0) * (n + 2.0) + mu_eff));
        let step = weighted(&|y| *y);
        self.mean += step * self.sigma;
        self.generation += 1;
        let (axes, scales) = self.axes();
        let whitened = axes * (axes.transpose() * step).component_div(&scales);
        self.path_sigma = self.path_sigma * (1.0 - c_sigma)
            + whitened * (c_sigma * (2.0 - c_sigma) * mu_eff).sqrt();
        // The mean length of a normal draw of so many coordinates.
        let expected = n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
        let length = self.path_sigma.norm();
        let faded = 1.0 - libm::pow(1.0 - c_sigma, 2.0 * f64::from(self.generation));
        let is_short = length / faded.sqrt() < (1.4 + 2.0 / (n + 1.0)) * expected;
        let heard = if is_short { 1.0 } else { 0.0 };
        self.path_c =
            self.path_c * (1.0 - c_c) + step * (heard * (c_c * (2.0 - c_c) * mu_eff).sqrt());
        let rank_one = self.path_c * self.path_c.transpose();
        let rank_mu: Matrix =
            chosen.iter().zip(&self.weights).map(|(y, w)| y * y.transpose() * *w).sum();
        let kept = 1.0 - c_1 - c_mu + c_1 * (1.0 - heard) * c_c * (2.0 - c_c);
        self.covariance = self.covariance * kept + rank_one * c_1 + rank_mu * c_mu;
        self.sigma *= libm::exp((length / expected - 1.0) * c_sigma / d_sigma).min(1e3);
        self.sigma = self.sigma.clamp(1e-6, 0.5);
    }

    /// Where it looks now.
    pub fn mean(&self) -> [f64; GENES] {
        self.mean.into()
    }

    /// The axes of the covariance, and how far it reaches along each.
    fn axes(&self) -> (Matrix, Vector) {
        let symmetric = (self.covariance + self.covariance.transpose()) * 0.5;
        let of = SymmetricEigen::new(symmetric);
        (of.eigenvectors, of.eigenvalues.map(|it| it.max(1e-12).sqrt()))
    }
}

/// A uniform point.
pub fn anywhere(seed: [u64; 2]) -> [f64; GENES] {
    let mut draws = Draws::new([seed[0], seed[1], 12, 0]);
    core::array::from_fn(|_| draws.share())
}
