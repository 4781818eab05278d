//! `mufasa integrate`: the log of a loop that keeps its duties, and one fault in each of its copies.

use std::sync::LazyLock;

use mufasa::services::configuration::Groups;
use mufasa_oracle::integrate::duty::Duty;
use mufasa_oracle::integrate::examine;
use mufasa_sim::attack::{Attack, Kind};
use mufasa_sim::cav::Cav;
use mufasa_sim::cav::guard::{Decided, Variant};
use mufasa_sim::cav::recorder::Share;
use mufasa_sim::map::streets::town;
use mufasa_sim::run::{Cycle, Settings, Watcher, simulate};
use mufasa_sim::scenario::Scenario;
use mufasa_sim::snapshot::Snapshot;
use serde_json::{Value, json};

use crate::kit::{folder, said, write};
use crate::schemas::{assert_valid, validators};

/// Keeps the log of a run.
#[derive(Default)]
struct Keeps(String);

impl Watcher for Keeps {
    fn cycle(&mut self, _: &Snapshot, _: &Cav<'_>, _: &Decided, _: &Cycle) {}

    fn ended(&mut self, _: &Snapshot, cav: &Cav<'_>) {
        self.0 = cav.guard().calls().expect("it is logged").to_string();
    }
}

/// The log of the simulator's loop: it offloads, is attacked, falls back and brakes.
static CLEAN: LazyLock<Vec<Value>> = LazyLock::new(|| {
    let town = town();
    let route = town.ego_routes().next().expect("a route");
    let scenario = Scenario { time_limit: 14.0, ..Scenario::draw(&town, route, 12, 3) };
    let mut settings = Settings::new(Variant::Hardened, Groups::ALL, 3);
    (settings.recorded, settings.logged) = (Share::ALL, true);
    settings.supervise_local = Some(0.0);
    settings.requester.t_wait_ns = 1_000_000_000;
    settings.attacks = vec![Attack::new(Kind::EmptyTracks, 6.0, 1e9, 3)];
    let mut keeps = Keeps::default();
    simulate(&town, &scenario, &settings, &mut keeps).expect("settings");
    keeps.0.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
});

fn text(lines: &[Value]) -> String {
    let lines: Vec<String> = lines.iter().map(ToString::to_string).collect();
    lines.join("\n")
}

/// The first line from this index on of which that is true.
fn first(from: usize, is_it: impl Fn(&Value) -> bool) -> usize {
    (from..CLEAN.len()).find(|at| is_it(&CLEAN[*at])).expect("the log has one")
}

fn is(kind: &'static str) -> impl Fn(&Value) -> bool {
    move |line| line["call"]["event"]["type"] == kind
}

fn brakes(line: &Value) -> bool {
    line["control"]["follows"] == "brakes"
}

fn follows_station(line: &Value) -> bool {
    line["control"]["follows"]["verified"]["station"].as_i64() > Some(0)
}

/// The log with one fault breaks this duty, first at this line (its index; none: wherever).
#[track_caller]
fn breaks(duty: Duty, at: impl Into<Option<usize>>, fault: impl FnOnce(&mut Vec<Value>)) {
    let mut lines = CLEAN.clone();
    fault(&mut lines);
    let (found, _) = examine(&text(&lines)).expect("it can be read");
    let line = found.broken().into_iter().find(|it| it.0 == duty).map(|it| it.1);
    let at = at.into().map_or(line, |at: usize| Some(at + 1));
    assert!(line.is_some() && line == at, "{duty:?} at {at:?}: {}", found.text("log"));
}

#[test]
fn a_loop_that_keeps_its_duties_passes_and_shows_all_that_is_looked_at() {
    let (found, seen) = examine(&text(&CLEAN)).expect("it can be read");
    assert_eq!(found.text("log"), "");
    assert!(seen.contains("does not show it: nothing."), "{seen}");
    let validator = &validators()["loop-log"];
    CLEAN.iter().for_each(|line| assert_valid(validator, line));
}

#[test]
fn a_period_without_a_cycle_or_without_a_tick_is_noticed() {
    let cycle = first(40, is("cycle"));
    breaks(Duty::Period, first(cycle + 1, is("area")) - 1, |it| drop(it.remove(cycle)));
    let tick = first(40, is("tick"));
    breaks(Duty::Period, first(tick, is("cycle")) - 1, |it| drop(it.remove(tick)));
}

#[test]
fn a_brake_by_that_is_ignored_is_noticed() {
    let at = first(0, follows_station);
    breaks(Duty::BrakeBy, None, |it| {
        let mut index = 0;
        it.retain(|line| (line["control"].is_null() || index <= at, index += 1).0);
    });
    // And so is one that follows an old trajectory again.
    let later = first(first(at, brakes), is("cycle")) + 1;
    breaks(Duty::BrakeBy, later, |it| {
        let t_ns = it[later - 1]["call"]["event"]["t_ns"].clone();
        let follows = it[at]["control"]["follows"].clone();
        it.insert(later, json!({"control": {"t_ns": t_ns, "follows": follows}}));
    });
}

/// MON-67, MON-68: from tau after the last cycle in Local.
#[test]
fn an_own_plan_that_did_not_come_out_is_noticed() {
    let at = first(0, is("confirm"));
    let t_ns = |line: &Value| line["call"]["event"]["t_ns"].as_i64().expect("a time");
    let local = (0..at).rfind(|it| is("cycle")(&CLEAN[*it])).expect("a cycle in Local");
    let by_ns = t_ns(&CLEAN[local]) + 250_000_000;
    let late = first(at, |line| line["call"].is_object() && t_ns(line) > by_ns);
    let follows = |lines: &mut Vec<Value>, until: usize| {
        let controls = lines[at..until].iter_mut().filter(|it| it["control"].is_object());
        controls.for_each(|it| it["control"]["follows"] = json!("own_plan"));
    };
    breaks(Duty::BrakeBy, late, |it| follows(it, late + 1));
    let mut in_time = CLEAN.clone();
    follows(&mut in_time, late);
    let (found, _) = examine(&text(&in_time[..late])).expect("it can be read");
    assert_eq!(found.text("log"), "", "up to then it may");
}

#[test]
fn a_verdict_that_is_late_or_missing_and_followed_is_noticed() {
    let follows = first(0, follows_station);
    let cycle = follows - 1;
    assert!(is("cycle")(&CLEAN[cycle]));
    breaks(Duty::Late, follows, |it| it[cycle]["call"]["took_ns"] = json!(200_000_000));
    breaks(Duty::CheckTime, cycle, |it| it[cycle]["call"]["took_ns"] = json!(200_000_000));
    breaks(Duty::Late, follows, |it| it[cycle]["call"]["answer"]["decision"] = Value::Null);
}

#[test]
fn what_no_cycle_gave_and_a_brake_that_is_not_obeyed_are_noticed() {
    let follows = first(0, follows_station);
    breaks(Duty::Verified, follows, |it| {
        it[follows]["control"]["follows"]["verified"]["stamp_ns"] = json!(1);
    });
    let brakes = first(0, brakes);
    let next = first(brakes, is("cycle"));
    breaks(Duty::OwnPlans, next, |it| it[brakes]["control"]["follows"] = json!("own_plan"));
}

#[test]
fn stations_that_are_swapped_are_noticed() {
    for kind in ["tracks", "trajectory", "confirm"] {
        let at = first(0, is(kind));
        breaks(Duty::Sender, at, |it| it[at]["call"]["event"]["station"] = json!(77));
        breaks(Duty::Sender, at, |it| it[at]["call"]["event"]["session"] = json!(77));
        breaks(Duty::Sender, at, |it| {
            drop(it[at]["call"].as_object_mut().map(|it| it.remove("sender")));
        });
    }
}

#[test]
fn milliseconds_for_nanoseconds_and_another_clock_are_noticed() {
    let at = first(200, is("tracks"));
    for by in [1_000, 1_000_000, 1_000_000_000] {
        breaks(Duty::Clock, at, |it| {
            let ns = it[at]["call"]["event"]["generated_ns"].as_i64();
            it[at]["call"]["event"]["generated_ns"] = json!(ns.expect("a time") / by);
        });
    }
    let at = first(200, |line| !line["control"].is_null());
    breaks(Duty::Clock, at, |it| it[at]["control"]["t_ns"] = json!(5));
    // The monitor itself says it of detections that are never current, and of a gap.
    let all = |it: &mut Vec<Value>, change: &dyn Fn(&mut Value)| {
        it.iter_mut()
            .filter(|it| is("cycle")(it))
            .for_each(|it| change(&mut it["call"]["event"]["measured"]));
    };
    breaks(Duty::Clock, None, |it| {
        all(it, &|it| it["detections"]["stamp_ns"] = json!(-60_000_000_000_i64));
    });
    breaks(Duty::Gap, None, |it| {
        all(it, &|it| it["lead"]["gap"] = json!(it["lead"]["gap"].as_f64().expect("a lead") + 4.0));
    });
    breaks(Duty::Settings, 0, |it| it[0]["made"]["record"]["period_ns"] = json!(100));
    breaks(Duty::Settings, 0, |it| it[0]["made"]["record"]["profile"] = json!("paper"));
    breaks(Duty::CheckTime, 0, |it| it[0]["made"]["check_time_ns"] = json!(i64::MAX));
}

#[test]
fn settings_actions_answers_advice_and_sessions_are_looked_at() {
    for tau in [0.05, 0.2] {
        breaks(Duty::Tau, 0, |it| {
            it[0]["made"]["meant"] = json!(0);
            it[0]["made"]["record"]["parameters"]["tau"] = json!(tau);
        });
    }
    breaks(Duty::CheckTime, 0, |it| {
        it[0]["made"]["step_ps"] = json!(750);
        it[0]["made"]["check_time_ns"] = json!(1000);
    });
    let at = first(0, |line| line["call"]["answer"]["actions"][0].is_object());
    breaks(Duty::Actions, at, |it| it[at]["call"]["answer"]["actions"] = json!([]));
    let at = first(0, is("cycle"));
    breaks(Duty::Arithmetic, at, |it| {
        it[at]["call"]["answer"]["decision"]["verdict"] = json!("unsafe");
    });
    breaks(Duty::Advice, at, |it| {
        drop(it[at]["call"].as_object_mut().map(|it| it.remove("advice")));
    });
    breaks(Duty::Sessions, CLEAN.len(), |it| it.extend(CLEAN.clone()));
}

#[test]
fn an_offer_beyond_the_table_has_no_actions() {
    let at = first(0, is("offer")) + 1;
    let with = |it: &mut Vec<Value>, answer: &Value| {
        it[0]["made"]["stations"] = json!(1);
        let mut offer = it[at - 1].clone();
        offer["call"]["event"]["station"] = json!(99);
        offer["call"]["sender"]["station"] = json!(99);
        offer["call"]["answer"] = answer.clone();
        it.insert(at, offer);
    };
    let mut lines = CLEAN.clone();
    with(&mut lines, &json!({}));
    assert_eq!(examine(&text(&lines)).expect("it can be read").0.text("log"), "");
    // A place is free again when its station withdraws before it was asked: then the offer is taken, and asked at a tick.
    let mut withdraw = lines[at - 1].clone();
    withdraw["call"]["event"]["type"] = json!("withdraw");
    drop(withdraw["call"]["event"].as_object_mut().map(|it| it.remove("groups")));
    lines.insert(at, withdraw);
    let found = examine(&text(&lines)).expect("it can be read").0;
    assert!(found.broken().iter().any(|it| it.0 == Duty::Actions), "{}", found.text("log"));
    let release = json!({"actions": [{"activate": "plan"}]});
    breaks(Duty::Actions, at, |it| with(it, &release));
}

#[test]
fn a_restart_that_forgets_the_wait_is_noticed() {
    let asks = |line: &Value| line["call"]["answer"]["actions"][0]["send"] == "request";
    let at = first(0, asks);
    breaks(Duty::Wait, CLEAN.len() + at, |it| it.extend(CLEAN.clone()));
    // Who offers nothing until then keeps it.
    let start_ns = CLEAN[1]["call"]["event"]["t_ns"].as_i64().expect("a time");
    let is_early = |line: &Value| {
        let t_ns = line["call"]["event"]["t_ns"].as_i64();
        is("offer")(line) && t_ns.is_some_and(|it| it < start_ns + 1_000_000_000)
    };
    let later = CLEAN.iter().filter(|it| !is_early(it)).cloned();
    let lines: Vec<Value> = CLEAN.iter().cloned().chain(later).collect();
    assert!(lines.len() < 2 * CLEAN.len(), "an early offer is left out");
    assert!(lines[CLEAN.len()..].iter().any(asks), "and a later one is asked");
    let (found, _) = examine(&text(&lines)).expect("it can be read");
    assert!(found.broken().iter().all(|it| it.0 != Duty::Wait), "{}", found.text("log"));
}

#[test]
fn the_duties_stand_in_the_manual_and_the_program_ends_with_their_number() {
    let manual = include_str!("../../../../docs/safety-manual.md");
    for duty in Duty::ALL {
        let [row, _] = duty.text();
        assert!(manual.contains(&format!("\n| {row} |")), "{row}");
    }
    let folder = folder("integrate");
    write(&folder, "clean.jsonl", text(&CLEAN));
    said(&folder, &["integrate", "clean.jsonl"]).has(0, "nothing", "");
    let late = text(&CLEAN).replace("\"took_ns\":0", "\"took_ns\":200000000");
    write(&folder, "late.jsonl", late);
    said(&folder, &["integrate", "late.jsonl"]).has(1, "(A-14)", "");
    write(&folder, "none.jsonl", text(&CLEAN[1..]));
    said(&folder, &["integrate", "none.jsonl"]).has(2, "", "begins with");
    write(&folder, "bad.jsonl", "{\"call\": 1}\n");
    said(&folder, &["integrate", "bad.jsonl"]).has(2, "", "line 1");
}
