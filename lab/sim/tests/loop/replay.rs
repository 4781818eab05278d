//! The page of a run.

use mufasa_sim::attack::Kind;
use mufasa_sim::cav::guard::Variant;
use mufasa_sim::experiment::job::kind_name;
use mufasa_sim::map::streets::town;
use mufasa_sim::replay::{Event, Replay};
use mufasa_sim::run::{End, Outcome};

use super::drive::{FROM, drive};

fn page(variant: Variant, kind: Option<Kind>, seed: u64) -> (Outcome, Replay, String) {
    let town = town();
    let (outcome, replay) = drive::<Replay>(variant, kind, (0, seed), 25.0);
    let id = format!("replay/{}/{}/0/{seed}", variant.name(), kind_name(kind));
    let text = replay.page(&town, &id, 0, &outcome);
    let name = id.replace('/', "-");
    let folder = env!("CARGO_TARGET_TMPDIR");
    std::fs::write(format!("{folder}/{name}.html"), &text).expect("a folder");
    (outcome, replay, text)
}

/// Opening and closing tags of a kind.
fn tags(text: &str, name: &str) -> [usize; 2] {
    [format!("<{name}"), format!("</{name}>")].map(|tag| text.matches(&tag).count())
}

#[test]
fn a_page_is_whole_and_about_what_happened_and_needs_nothing_else() {
    let (outcome, replay, text) = page(Variant::Hardened, Some(Kind::WrongMap), 0);
    assert!(text.starts_with("<!DOCTYPE html>") && text.ends_with("</html>\n"));
    assert_eq!(tags(&text, "svg"), [2, 2]);
    assert_eq!(tags(&text, "g ")[0], text.matches("</g>").count(), "groups are closed");
    assert!(!text.contains("<script") && !text.contains("href") && !text.contains("src="));
    // Namespaces are names; nobody fetches them.
    let rest = text.replace("http://www.w3.org/2000/svg", "");
    assert!(!rest.contains("http") && !rest.contains("NaN") && !rest.contains("inf,"));
    assert!(text.contains("replay/hardened/wrong-map/0/0"));
    let frames = text.matches("<clipPath").count();
    assert!((6..=8).contains(&frames), "{frames} frames");
    for index in 0..frames {
        assert_eq!(text.matches(&format!("id=\"f{index}\"")).count(), 1, "ids are given once");
    }
    let (event, at) = replay.event(&outcome);
    assert_eq!(event, Event::Issue);
    let cycle = replay.cycles()[at];
    assert!(cycle.failed > 0 && cycle.t >= FROM);
    assert!(text.contains(&format!("t = {:.2} s", cycle.t)), "a frame of the event");
    assert!(text.contains("failed: stage"));
    // What was rejected is in the frame of the failure alone, dashed.
    let dashed = "class=\"rejected\"";
    assert_eq!(text.matches(dashed).count(), 1, "the remote trajectory that was rejected");

    let (outcome, replay, text) = page(Variant::Sofof, None, 0);
    assert_eq!(replay.event(&outcome).0, Event::End);
    assert!(!text.contains(dashed));
    assert!(text.contains("replay/sofof/none/0/0"));
}

#[test]
fn a_collision_is_shown_as_it_happens() {
    let found = (0..6).map(|seed| page(Variant::Sofof, Some(Kind::EmptyTracks), seed));
    let (outcome, replay, text) =
        found.into_iter().find(|it| it.0.end == End::Collided).expect("one collides");
    assert_eq!(replay.event(&outcome).0, Event::Collision);
    let with = outcome.with.expect("somebody");
    assert!(text.contains(&format!("t = {:.2} s touches {with}", outcome.t)));
}
