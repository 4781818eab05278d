//! One track and one detection in place of several.

use mufasa_model::input::cycle::Cycle;

use super::Case;

/// Where the detection is put, m ahead of the CAV; hence the radius of the field of view.
const RADIUS_M: f64 = 10.0;

/// Beside a threshold, but nearer than the margin of rounding: not on it, m.
const BESIDE_M: f64 = 5e-7;

/// Taking a pair away moves the mean of the others, so that a cycle at the threshold of stage i
/// would keep them all. Puts the first track so that it alone is at a threshold: of the mean, of a
/// pair's distance, of the field of view.
pub fn one_pair(case: &mut Case<'_>) {
    let length = |cycle: &Cycle| {
        let tracks = cycle.tracks.as_ref().map_or(0, |list| list.items.len());
        (tracks, cycle.detections.as_ref().map_or(0, |list| list.items.len()))
    };
    let Some(cycle) = case.cycle() else { return };
    if !matches!(length(cycle), (1.., 2..) | (2.., 1..)) {
        return;
    }
    let sides = |threshold_m: f64| {
        [threshold_m, threshold_m + BESIDE_M, threshold_m - BESIDE_M].into_iter()
    };
    let parameters = cycle.parameters.clone();
    let behind = sides(parameters.theta_tr).chain(sides(parameters.theta_track_max));
    let behind = behind.map(|distance_m| (RADIUS_M - distance_m, 0.0));
    let border = sides(RADIUS_M).map(|radius_m| (0.0, radius_m));
    let places: Vec<(f64, f64)> = behind.chain(border).collect();
    // A track that may be missed is at no threshold alone.
    for miss_budget in [parameters.miss_budget, 0] {
        for (ahead_m, left_m) in &places {
            let done = case.change_cycle(|cycle| {
                let (x, y) = (cycle.ego.x, cycle.ego.y);
                cycle.parameters.miss_budget = miss_budget;
                if let Some(list) = &mut cycle.tracks {
                    list.items.truncate(1);
                    list.items.iter_mut().for_each(|it| (it.x, it.y) = (x + ahead_m, y + left_m));
                }
                if let Some(list) = &mut cycle.detections {
                    list.items.truncate(1);
                    list.items.iter_mut().for_each(|it| (it.x, it.y) = (x + RADIUS_M, y));
                }
            });
            if done {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use mufasa_model::cycle::check;
    use mufasa_model::input::cycle::Profile;
    use mufasa_model::report::{FailedStage, Reading, Stage};

    use crate::cases::generate::Generator;
    use crate::cases::question::Question;
    use crate::judge::class::Kind;

    /// Whether stage i fails exactly, but not with a margin of a micrometre.
    fn is_at_the_mean(question: &Question) -> bool {
        let Question::Cycle(cycle) = question else { return false };
        let mut cycle = cycle.clone();
        cycle.parameters.delta = 1e-6;
        let fails = |reading| {
            check(&cycle, reading)
                .is_ok_and(|report| report.failed_stage == Some(FailedStage::Stage(Stage::I)))
        };
        fails(Reading::Exact) && !fails(Reading::Lax)
    }

    #[test]
    fn at_the_threshold_of_stage_i_a_pair_is_enough() {
        let kinds = vec![Kind::Cycle];
        let generator = Generator { seed: 8, profile: Profile::HARDENED, kinds };
        let cases = (0..2000).map(|case| generator.question(case));
        let mut found = cases.filter(|it| it.objects() > 5 && is_at_the_mean(it));
        for _ in 0..10 {
            let large = found.next().expect("ten cases among 2000");
            let small = super::super::question(&large, &mut |it| is_at_the_mean(it));
            assert!(is_at_the_mean(&small) && small.objects() <= 2, "{}", small.line("x"));
        }
    }
}
