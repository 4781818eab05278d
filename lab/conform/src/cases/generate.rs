//! Generated cases: the strategies of `props`, each case from a tape of its own, so that a case
//! is the same whatever the shard.

use mufasa_model::cycle::check;
use mufasa_model::input::cycle::{Cycle, Profile};
use mufasa_model::report::Reading;
use mufasa_props::bridge::check_impl;
use mufasa_props::strategy::draw::{Draw, long_tape, longest_tape, tape};
use mufasa_props::strategy::{
    composition, input, monitor, requester, roads, schedule, seen, sizes, tracks, whole,
};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use crate::cases::damage::Damage;
use crate::cases::question::{Damaged, Question};
use crate::judge::class::Kind;
use mufasa_records::record::parameters::All;
use mufasa_records::{Sequence, Trace};

/// So many cases in succession are on roads that are alike, and one in so many of these groups is.
const NEIGHBOURS: u64 = 4;
const SUCCESSIONS: u64 = 16;

/// One cycle in so many is of any size up to that of the domain: of the paper profile, and of the hardened one, whose
/// exact model takes longer.
const LARGE: [usize; 2] = [32, 256];

/// So many cycles are looked through for one that can be as large as there may be.
const TRIES: usize = 1000;

/// Where the cases of a campaign come from.
#[derive(Clone, Debug)]
pub struct Generator {
    /// Seed of the campaign.
    pub seed: u64,
    /// Profile of cycles and traces.
    pub profile: Profile,
    /// Kinds of records, without repetition, at least one.
    pub kinds: Vec<Kind>,
}

impl Generator {
    /// Case number `case`. The first cycles are the largest: as many points, tracks and so on as there may be.
    pub fn question(&self, case: u64) -> Question {
        match self.part(case) {
            Some(part) => self.largest(case, part),
            None => self.read(self.kind(case), &self.tape(case)),
        }
    }

    /// What a case has as much of as there may be: each of the first cycles of another part.
    fn part(&self, case: u64) -> Option<sizes::Part> {
        let is_cycle = |case: &u64| self.kind(*case) == Kind::Cycle;
        // Among so many cases there are as many cycles.
        let is_early = case < 64 && is_cycle(&case);
        is_early.then(|| sizes::Part::ALL.get((0..case).filter(is_cycle).count()).copied())?
    }

    /// The first cycle from this case on that can have so much, and of which the last item decides, if there is one.
    fn largest(&self, case: u64, part: sizes::Part) -> Question {
        let cycles = (case..).map(|case| usual(&mut Draw::new(&self.tape(case)), self.profile));
        let mut fitting = cycles.take(TRIES).filter(|cycle| part.fits(cycle)).peekable();
        let enlarged = |mut cycle: Cycle| {
            sizes::largest(&mut cycle, part);
            cycle
        };
        let first = fitting.peek().cloned();
        let first = first.unwrap_or_else(|| usual(&mut Draw::new(&[]), self.profile));
        // The implementation is fast, and cautious close to a threshold, where the exact model has the word.
        let soon = |cycle: &Cycle| check_impl(cycle).ok()?.failed_stage;
        let exactly = |cycle: &Cycle| check(cycle, Reading::Exact).ok()?.failed_stage;
        let mut deciding = fitting.filter(|cycle| part.decides(cycle, soon)).map(enlarged);
        let found = deciding.find(|cycle| part.decides(cycle, exactly));
        Question::Cycle(Box::new(found.unwrap_or_else(|| enlarged(first))))
    }

    /// The kind of a case: of the usual four, eight of eleven are cycles.
    pub fn kind(&self, case: u64) -> Kind {
        let weight = |kind: &Kind| match kind {
            Kind::Cycle => 8,
            Kind::Offloading | Kind::Composition | Kind::Monitor | Kind::Line => 1,
        };
        let total: u64 = self.kinds.iter().map(weight).sum();
        let mut drawn = mix(self.seed ^ mix(case)) % total.max(1);
        for kind in &self.kinds {
            if drawn < weight(kind) {
                return *kind;
            }
            drawn -= weight(kind);
        }
        Kind::Cycle
    }

    /// The tape of a case.
    fn tape(&self, case: u64) -> Vec<u32> {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&self.seed.to_le_bytes());
        bytes[8..16].copy_from_slice(&case.to_le_bytes());
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
        let config = Config { failure_persistence: None, ..Config::default() };
        let mut runner = TestRunner::new_with_rng(config, rng);
        let drawn = match self.kind(case) {
            Kind::Cycle | Kind::Composition | Kind::Line => {
                tape().new_tree(&mut runner).map(|t| t.current())
            }
            Kind::Offloading => long_tape().new_tree(&mut runner).map(|t| t.current()),
            Kind::Monitor => longest_tape().new_tree(&mut runner).map(|t| t.current()),
        };
        // Vectors of any numbers reject nothing; an empty tape is the simplest case.
        let mut tape = drawn.unwrap_or_default();
        if self.kind(case) == Kind::Cycle && self.is_succession(case) {
            // The first choice of a cycle is its shape, and this the last of them.
            tape.iter_mut().take(1).for_each(|choice| *choice = u32::MAX);
        }
        tape
    }

    /// Whether a case is one of neighbours whose roads are alike, so that of two cycles in
    /// succession the second shows what a program keeps of the route of the first. A program that
    /// keeps it longer meets others of them, in every shard.
    fn is_succession(&self, case: u64) -> bool {
        mix(self.seed ^ mix(case / NEIGHBOURS)).is_multiple_of(SUCCESSIONS)
    }

    /// What a tape says.
    fn read(&self, kind: Kind, tape: &[u32]) -> Question {
        match kind {
            Kind::Cycle => Question::Cycle(Box::new(cycle(&mut Draw::new(tape), self.profile))),
            Kind::Offloading => {
                // The first choice of a trace is its profile.
                let first = if self.profile == Profile::PAPER { u32::MAX } else { 0 };
                let mut tape = tape.to_vec();
                tape.iter_mut().take(1).for_each(|choice| *choice = first);
                if tape.is_empty() {
                    tape.push(first);
                }
                let requester::Trace { profile, parameters, events, near: _ } =
                    requester::trace(&mut Draw::new(&tape));
                Question::Offloading(Trace { profile, parameters, events })
            }
            Kind::Composition => Question::Composition(composition::task(&mut Draw::new(tape))),
            Kind::Monitor => Question::Monitor(Box::new(sequence(tape, self.profile))),
            Kind::Line => {
                let mut draw = Draw::new(tape);
                let damage = draw.pick(&Damage::ALL);
                let at = draw.below(1 << 20);
                // Records that the program is asked about anyhow.
                let mut records = self.kinds.clone();
                records.retain(|kind| *kind != Kind::Line);
                let records = if records.is_empty() { &Kind::RECORDS[..] } else { &records };
                let record = draw.pick(records);
                let rest = tape.get(3..).unwrap_or_default();
                Question::Line(Damaged::new(self.read(record, rest), damage, at))
            }
        }
    }
}

/// A cycle at the threshold of a stage, of the schedule, or of what is valid; on a road that bends
/// or closes, before the stamp of its tracks, or on one of the roads that are alike; at times large.
fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let mut cycle = usual(draw, profile);
    let [paper, hardened] = LARGE;
    if draw.one_in(if profile == Profile::PAPER { paper } else { hardened }) {
        sizes::grow(draw, &mut cycle);
    }
    cycle
}

fn usual(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    match draw.below(20) {
        14 if profile == Profile::HARDENED => seen::cycle(draw, profile),
        0..=14 => whole::cycle(draw, profile),
        15 => schedule::cycle(draw, profile),
        16 | 17 => input::cycle(draw, profile),
        18 => match draw.below(2) {
            0 => roads::cycle(draw, profile),
            _ => tracks::before(draw, profile),
        },
        _ => roads::alike(draw, profile),
    }
}

/// What one monitor lives through.
fn sequence(tape: &[u32], profile: Profile) -> Sequence {
    let (settings, events) = monitor::sequence(tape, profile);
    Sequence {
        profile,
        parameters: All::of(&settings.parameters, &settings.requester),
        period_ns: settings.period_ns,
        last_session: settings.last_session,
        supervise_local: settings.supervise_local,
        stall: settings.stall,
        memory: settings.memory,
        route: monitor::route(),
        events,
    }
}

/// Splitmix64: neighbours become unlike.
pub fn mix(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use mufasa_model::input::cycle::DetectionList;
    use mufasa_model::report::Outcome;

    use super::*;

    #[test]
    fn a_case_is_the_same_each_time_and_another_with_another_seed() {
        let generator =
            |seed| Generator { seed, profile: Profile::HARDENED, kinds: Kind::ALL.into() };
        for case in 0..50 {
            let line = |seed| generator(seed).question(case).line("x");
            assert_eq!(line(1), line(1));
            assert_ne!(line(1), line(2), "case {case}");
        }
    }

    #[test]
    fn in_succession_come_cycles_on_roads_that_are_alike_but_not_equal() {
        let generator = Generator { seed: 0, profile: Profile::PAPER, kinds: Kind::USUAL.into() };
        let cycle = |case| match generator.question(case) {
            Question::Cycle(cycle) => Some(cycle),
            _ => None,
        };
        let (mut pairs, mut closed, mut telling) = (0, 0, 0);
        for case in 0..4000 {
            let (Some(one), Some(two)) = (cycle(case), cycle(case + 1)) else { continue };
            let ends = |cycle: &Cycle| {
                let sections = &cycle.route.cross_sections;
                (sections.len(), sections.first().cloned(), sections.last().cloned())
            };
            if ends(&one) == ends(&two) && one.route != two.route {
                pairs += 1;
                closed += u32::from(one.route.closed != two.route.closed);
                let kept = Cycle { route: one.route.clone(), ..*two.clone() };
                let verdict =
                    |cycle: &Cycle| check(cycle, Reading::Exact).map(|it| it.failed_stage);
                telling += u32::from(verdict(&kept) != verdict(&two));
            }
        }
        assert!(pairs > 50 && closed > 10 && telling > 15, "{pairs} {closed} {telling}");
    }

    #[test]
    fn some_trajectories_begin_before_the_stamp_of_the_tracks() {
        for profile in [Profile::PAPER, Profile::HARDENED] {
            let generator = Generator { seed: 0, profile, kinds: vec![Kind::Cycle] };
            let begins_before = |case: &u64| {
                let Question::Cycle(cycle) = generator.question(*case) else { return false };
                let (Some(tracks), Some(trajectory)) = (&cycle.tracks, &cycle.trajectory) else {
                    return false;
                };
                let moves = tracks.items.iter().any(|it| it.vx.hypot(it.vy) > 1.0);
                let runs = matches!(
                    check(&cycle, Reading::Exact).map(|it| it.stages[2].clone()),
                    Ok(Outcome::Passed | Outcome::Failed(_))
                );
                moves && runs && trajectory.points[0].t_ns + 10_000_000 < tracks.stamp_ns
            };
            let count = (0..1000).filter(begins_before).count();
            assert!(count > 3, "{profile:?}: {count}");
        }
    }

    #[test]
    fn the_first_cycles_are_as_large_as_the_domain_allows_and_decided() {
        for profile in [Profile::PAPER, Profile::HARDENED] {
            let generator = Generator { seed: 3, profile, kinds: vec![Kind::Cycle] };
            let cycles = (0..6).map(|case| match generator.question(case) {
                Question::Cycle(cycle) => cycle,
                other => panic!("{other:?}"),
            });
            let [points, tracks, detections, history, sections, cells]: [Box<Cycle>; 6] =
                cycles.collect::<Vec<_>>().try_into().expect("six");
            let count = |list: &Option<DetectionList>| list.as_ref().map_or(0, |it| it.items.len());
            assert_eq!(points.trajectory.as_ref().map_or(0, |it| it.points.len()), 1024);
            assert_eq!(tracks.tracks.as_ref().map_or(0, |it| it.items.len()), 1024);
            assert_eq!(count(&detections.detections), 2048);
            assert!(history.detection_history.iter().any(|it| it.items.len() == 2048));
            assert_eq!(sections.route.cross_sections.len(), 8192);
            assert!(cells.grid.is_some_and(|grid| grid.width * grid.height > 1 << 19));
            for cycle in [points, tracks, detections, history, sections] {
                assert!(check(&cycle, Reading::Exact).is_ok(), "{cycle:?}");
            }
        }
    }

    #[test]
    fn of_the_most_tracks_the_last_decides_whatever_the_seed() {
        for seed in 0..3 {
            let kinds = Kind::USUAL.into();
            let generator = Generator { seed, profile: Profile::PAPER, kinds };
            let cycles = (0..64).filter_map(|case| match generator.question(case) {
                Question::Cycle(cycle) => Some(cycle),
                _ => None,
            });
            let mut cycle = cycles.clone().nth(1).expect("cycles");
            let failed = |cycle: &Cycle| check(cycle, Reading::Exact).map(|it| it.failed_stage);
            let before = failed(&cycle);
            let list = &mut cycle.tracks.as_mut().expect("tracks").items;
            assert_eq!((list.len(), list.pop().is_some()), (1024, true));
            assert_ne!(failed(&cycle), before, "seed {seed}");
            let points = cycles.clone().next().and_then(|it| Some(it.trajectory?.points.len()));
            let sections = cycles.clone().nth(4).map(|it| it.route.cross_sections.len());
            assert_eq!([points, sections], [Some(1024), Some(8192)]);
        }
    }

    /// A change that a program makes without saying so, and how many of the first cycles show it.
    fn shown(profile: Profile, change: impl Fn(&mut Cycle) -> bool) -> usize {
        let generator = Generator { seed: 0, profile, kinds: vec![Kind::Cycle] };
        let is_shown = |case: &u64| {
            let Question::Cycle(cycle) = generator.question(*case) else { return false };
            let mut changed = cycle.clone();
            let verdict = |cycle| check(cycle, Reading::Exact).map(|it| it.failed_stage);
            change(&mut changed) && verdict(&changed) != verdict(&cycle)
        };
        (0..10_000).filter(is_shown).count()
    }

    #[test]
    fn a_time_of_prediction_in_whole_ms_or_us_changes_verdicts() {
        for unit_ns in [1_000_000, 1_000] {
            let count = shown(Profile::PAPER, |cycle| {
                let (Some(tracks), Some(trajectory)) = (&mut cycle.tracks, &cycle.trajectory)
                else {
                    return false;
                };
                let Some(first) = trajectory.points.first() else { return false };
                let t_ns = i128::from(first.t_ns) - i128::from(tracks.stamp_ns);
                tracks.stamp_ns += i64::try_from(t_ns % unit_ns).unwrap_or(0);
                true
            });
            assert!(count > 10, "{unit_ns} ns: {count}");
        }
    }

    #[test]
    fn what_decides_lies_behind_the_first_hundred_too() {
        let tracks = shown(Profile::PAPER, |cycle| {
            let Some(list) = &mut cycle.tracks else { return false };
            list.items.len() > 100 && list.items.drain(100..).len() > 0
        });
        let detections = shown(Profile::PAPER, |cycle| {
            let Some(list) = &mut cycle.detections else { return false };
            list.items.len() > 100 && list.items.drain(100..).len() > 0
        });
        let points = shown(Profile::PAPER, |cycle| {
            let Some(list) = &mut cycle.trajectory else { return false };
            list.points.len() > 200 && list.points.drain(200..).len() > 0
        });
        let sections = shown(Profile::PAPER, |cycle| {
            let sections = &mut cycle.route.cross_sections;
            sections.len() > 1000 && sections.drain(1000..).len() > 0
        });
        let all = [tracks, detections, points, sections];
        assert!(all.iter().all(|count| *count > 0), "{all:?}");
    }

    #[test]
    fn traces_have_the_profile_asked_for() {
        for profile in [Profile::PAPER, Profile::HARDENED] {
            let generator = Generator { seed: 0, profile, kinds: vec![Kind::Offloading] };
            for case in 0..20 {
                let Question::Offloading(trace) = generator.question(case) else { panic!() };
                assert_eq!(trace.profile, profile);
            }
        }
    }
}
