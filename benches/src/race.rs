//! Measures contestants in interleaved rounds, so that a noisy host slows all of them alike, and
//! takes medians.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Something to be timed.
pub struct Entry<'a> {
    /// What it decides: contestants of one task are compared with each other.
    pub task: String,
    /// Who it is.
    pub name: String,
    /// The work; its answer is used, so that it cannot be left out.
    pub run: Box<dyn FnMut() -> bool + 'a>,
}

/// The medians of one contestant.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Time {
    /// As in `Entry`.
    pub task: String,
    /// As in `Entry`.
    pub name: String,
    /// Called again and again, us.
    pub warm_us: f64,
    /// Called after the caches have been filled with other data, us.
    pub cold_us: Option<f64>,
}

/// How many rounds; odd, so that there is a median.
#[derive(Clone, Copy, Debug)]
pub struct Rounds {
    /// Warm rounds.
    pub warm: usize,
    /// Cold calls.
    pub cold: usize,
}

/// As long as one entry runs in a round.
const SLICE: Duration = Duration::from_micros(400);
/// Larger than the last level of cache.
const EVICTION_BYTES: usize = 96 << 20;

/// Runs all contestants, round after round.
pub fn measure(contestants: &mut [Entry<'_>], rounds: Rounds) -> Vec<Time> {
    let calls: Vec<u32> = contestants.iter_mut().map(|it| calls_in_slice(&mut it.run)).collect();
    let mut warm = vec![Vec::new(); contestants.len()];
    for _ in 0..rounds.warm {
        for ((contestant, samples), &calls) in contestants.iter_mut().zip(&mut warm).zip(&calls) {
            let start = Instant::now();
            for _ in 0..calls {
                black_box((contestant.run)());
            }
            samples.push(start.elapsed().as_secs_f64() * 1e6 / f64::from(calls));
        }
    }
    let mut cold = vec![Vec::new(); contestants.len()];
    let mut cache = vec![0_u8; EVICTION_BYTES];
    for _ in 0..rounds.cold {
        for (contestant, samples) in contestants.iter_mut().zip(&mut cold) {
            evict(&mut cache);
            let start = Instant::now();
            black_box((contestant.run)());
            samples.push(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    let times = contestants.iter().zip(warm).zip(cold);
    times
        .map(|((contestant, warm), cold)| Time {
            task: contestant.task.clone(),
            name: contestant.name.clone(),
            warm_us: median(warm).unwrap_or(f64::NAN),
            cold_us: median(cold),
        })
        .collect()
}

/// The middle of the samples.
pub fn median(mut samples: Vec<f64>) -> Option<f64> {
    samples.sort_by(f64::total_cmp);
    samples.get(samples.len() / 2).copied()
}

/// How many calls take about a slice; this also warms up.
fn calls_in_slice(run: &mut dyn FnMut() -> bool) -> u32 {
    let mut calls = 1;
    loop {
        let start = Instant::now();
        for _ in 0..calls {
            black_box(run());
        }
        if start.elapsed() >= SLICE / 2 {
            return calls;
        }
        calls *= 2;
    }
}

/// Writes to every cache line of a large array.
fn evict(cache: &mut [u8]) {
    for byte in cache.iter_mut().step_by(64) {
        *byte = byte.wrapping_add(1);
    }
    black_box(cache);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slower_one_is_the_slower_one() {
        let work = |turns: u64| move || (0..black_box(turns)).fold(0, u64::wrapping_add) > 0;
        let contestant = |name: &str, turns| Entry {
            task: String::new(),
            name: name.to_owned(),
            run: Box::new(work(turns)) as Box<dyn FnMut() -> bool>,
        };
        let sleep = Entry {
            run: Box::new(|| {
                std::thread::sleep(Duration::from_millis(1));
                true
            }),
            ..contestant("sleep", 1)
        };
        let times = measure(&mut [contestant("short", 100), sleep], Rounds { warm: 3, cold: 1 });
        assert!(times[0].warm_us < times[1].warm_us, "{times:?}");
        assert!(times[1].cold_us.is_some_and(|cold| cold >= 1e3), "{times:?}");
    }

    #[test]
    fn the_median_is_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(Vec::new()), None);
    }
}
