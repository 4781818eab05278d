//! Something comes across beside the CAV, one earlier list does not show it, and a track says that it goes away: whether that
//! track counts depends on one term of `spec/hardened/what-the-cav-saw.md`, clearly or nearly.

use mufasa_model::input::cycle::{Cycle, Detection, DetectionList, Profile, Track, TrackList};
use mufasa_model::input::parameters::Parameters;
use mufasa_model::services::configuration::Configuration;

use super::base::{self, Frame, bend, seconds};
use super::draw::Draw;
use super::obstacle;
use super::track_validation::{detection, track};

/// A vector in the frame of the CAV.
type Vector = (f64, f64);

/// What there is, in the frame of the CAV at the time of the detections.
struct Scene {
    /// The thing, its true velocity, and what its track says.
    at: Vector,
    true_velocity: Vector,
    velocity: Vector,
    /// Length and width of the thing, along which it comes across.
    size: Vector,
    /// From the thing to the place of the track.
    error: Vector,
    /// Ages of lists and of detections and tracks, ns.
    ages: [i64; 3],
    seen_age: i64,
    tracks_age: i64,
    /// The list that does not show the thing.
    missed: usize,
    /// Of each list, whether the track has an item there.
    known: [bool; 3],
    /// Further tracks, by place and velocity.
    others: Vec<(Vector, Vector)>,
    /// Further items of each list.
    items: [Vec<Vector>; 3],
}

/// A cycle in which the track is confirmed, or one thing is missing to that, or it has another list.
pub fn cycle(draw: &mut Draw<'_>, profile: Profile) -> Cycle {
    let frame = base::frame(draw);
    let configuration =
        draw.pick(&[Configuration::AllRemote, Configuration::MotRemote, Configuration::PlanRemote]);
    let mut cycle = base::cycle(draw, frame, profile, configuration);
    obstacle::widen(&mut cycle, frame);
    cycle.parameters =
        Parameters { delta: cycle.parameters.delta, theta_tr: 0.9, ..Parameters::default() };
    let ego = &mut cycle.ego;
    (ego.speed, ego.length, ego.width, ego.center_offset) = (8.0, 4.0, 2.0, 0.0);
    cycle.trajectory = Some(base::straight(&cycle.ego, frame, cycle.now_ns, &cycle.parameters));
    let mut scene = scene(draw);
    let limit = cycle.parameters.theta_track_max;
    match draw.below(13) {
        0 => {}
        1 => shared(draw, &mut scene, limit),
        2 | 3 => slanted(draw, &mut scene, cycle.parameters.theta_velocity),
        4 => scene.tracks_age = draw.near_ns(cycle.parameters.max_age_ns),
        5 => {
            scene.known =
                draw.pick(&[[true, false, false], [false, true, false], [false, true, true]]);
        }
        6 => scene.error = (draw.near(limit), 0.0),
        7 => cycle.parameters.v_object = draw.near(scene.velocity.1.hypot(scene.velocity.0)),
        8 => {
            // One list, at least, is 60 s old, or nearly so.
            cycle.parameters.max_age_ns = 60_000_000_000;
            let of = draw.pick(&[0, 2]);
            scene.missed = 2 - of;
            scene.seen_age = 60_000_000_000 - draw.near_ns(scene.ages[of]);
        }
        9 => shown(draw, &mut scene, &cycle.parameters),
        10 => {
            // Two lists have it, of which one is about as young or old as may be.
            scene.known = [true, false, true];
            if draw.below(3) == 0 {
                (scene.missed, scene.ages[0]) = (2, draw.near_ns(200_000_000));
            } else {
                (scene.missed, scene.ages[2]) = (0, draw.near_ns(1_000_000_000));
            }
        }
        // The thing, which is explained, may stand where something was farther off, and come from there.
        11 => scene.items[1].push((scene.at.0, scene.at.1 - draw.near(limit))),
        _ => of_several(draw, &mut scene, &cycle.parameters),
    }
    put(draw, frame, &mut cycle, &scene);
    cycle
}

fn scene(draw: &mut Draw<'_>) -> Scene {
    let length = draw.pick(&[2.0, 1.0, 1.0_f64.next_up(), 0.6, 4.0]);
    let beside = 1.0 + 0.5 * length + draw.pick(&[0.5, 1.5, 0.1]);
    let ages = [300, 500, 800].map(|ms| draw.odd_ns(ms * 1_000_000));
    let ages_of_both = [0, 20_000_000].map(|age| draw.odd_ns(age));
    Scene {
        at: (draw.pick(&[5.0, 4.0, 6.0]), -beside),
        true_velocity: (0.0, draw.pick(&[4.0, 6.0])),
        velocity: (0.0, draw.pick(&[-8.0, -16.0])),
        size: (length, 1.0),
        error: (0.0, 0.0),
        ages,
        seen_age: ages_of_both[0],
        tracks_age: ages_of_both[1],
        missed: draw.pick(&[0, 2]),
        known: [true; 3],
        others: Vec::new(),
        items: [Vec::new(), Vec::new(), Vec::new()],
    }
}

/// Another track beside it, of what stands there, has the same detection, or just has none.
fn shared(draw: &mut Draw<'_>, scene: &mut Scene, limit: f64) {
    let place = (scene.at.0 + draw.near(limit) - draw.pick(&[0.0, 0.5]), scene.at.1);
    scene.others.push((place, (0.0, 0.0)));
    scene.items.iter_mut().for_each(|items| items.push(place));
}

/// The track moves along its detection, or just does not.
fn slanted(draw: &mut Draw<'_>, scene: &mut Scene, theta_velocity: f64) {
    let forward = scene.velocity.1;
    let most = (0..40).fold(0.0, |across, _| theta_velocity + 0.1 * forward.hypot(across));
    scene.velocity.0 = -draw.near(most) - draw.pick(&[0.0, 0.5]);
}

/// That list shows it all the same, as far from an even motion as tyres may have bent it, or just farther.
fn shown(draw: &mut Draw<'_>, scene: &mut Scene, p: &Parameters) {
    let [age, dt] = [scene.ages[scene.missed], scene.ages[1]].map(seconds);
    let off = draw.near(0.3 + bend(p, dt, age));
    let (x, y) = back(scene.at, scene.true_velocity, scene.ages[scene.missed]);
    scene.items[scene.missed].push(draw.pick(&[(x + off, y), (x - off, y), (x, y - off)]));
}

/// Another track has the same origin in the reference list, where an item near the track's past means that the thing
/// comes across; in the track's own list there is none.
fn of_several(draw: &mut Draw<'_>, scene: &mut Scene, p: &Parameters) {
    scene.velocity = (0.0, -1.0);
    scene.true_velocity = (0.0, 30.0);
    let dt = seconds(scene.ages[1]);
    let past = back(scene.at, scene.velocity, scene.ages[1]);
    let reach = p.theta_track_max + p.theta_velocity * dt;
    scene.items[1].push((past.0, past.1 - draw.near(reach)));
    if !draw.one_in(4) {
        let place = (scene.at.0 - 10.0, scene.at.1 - 8.0);
        scene.others.push((place, ((place.0 - past.0) / dt, (place.1 - past.1) / dt)));
    }
}

/// Where something was so long ago.
fn back(at: Vector, velocity: Vector, age_ns: i64) -> Vector {
    let dt = seconds(age_ns);
    (at.0 - velocity.0 * dt, at.1 - velocity.1 * dt)
}

/// The lists of the scene.
fn put(draw: &mut Draw<'_>, frame: Frame, cycle: &mut Cycle, scene: &Scene) {
    let across = frame.turn((0.0, 1.0));
    let seen_ns = cycle.now_ns.saturating_sub(scene.seen_age);
    let tracks_ns = cycle.now_ns.saturating_sub(scene.tracks_age);
    let thing = |place: Vector| {
        let (cos, sin) = across;
        let (length, width) = scene.size;
        Detection { cos, sin, length, width, ..detection(frame, place) }
    };
    let small = |place: Vector| Detection { length: 0.5, width: 0.5, ..detection(frame, place) };
    let place = (scene.at.0 + scene.error.0, scene.at.1 + scene.error.1);
    let tracked = |id: i64, place: Vector, velocity: Vector, size: Vector| {
        let (vx, vy) = frame.turn(velocity);
        let t_ns = seen_ns - tracks_ns;
        let (cos, sin) = across;
        let (length, width) = size;
        let now = back(place, velocity, t_ns);
        Track { vx, vy, cos, sin, length, width, ..track(frame, now, id) }
    };
    let mut items = vec![tracked(1, place, scene.velocity, scene.size)];
    for (id, (place, velocity)) in (2..).zip(&scene.others) {
        items.push(tracked(id, *place, *velocity, (0.5, 0.5)));
    }
    let mut seen = vec![thing(scene.at)];
    let mut lists = Vec::new();
    for (index, age) in scene.ages.iter().enumerate() {
        let mut items = Vec::new();
        if index != scene.missed {
            items.push(thing(back(scene.at, scene.true_velocity, *age)));
        }
        if scene.known[index] {
            items.push(small(back(place, scene.velocity, *age)));
        }
        for (place, velocity) in scene.others.iter().filter(|(_, w)| *w != (0.0, 0.0)) {
            if index != 1 {
                items.push(small(back(*place, *velocity, *age)));
            }
        }
        items.extend(scene.items[index].iter().map(|place| small(*place)));
        lists.push(DetectionList { stamp_ns: seen_ns - age, items });
    }
    if draw.one_in(2) {
        // Beyond the farthest other thing, so that all tracks are gated.
        let far = (60.0, -20.0);
        items.push(tracked(90, far, (0.0, 0.0), (4.0, 2.0)));
        seen.push(detection(frame, far));
        lists.iter_mut().for_each(|list| list.items.push(detection(frame, far)));
    }
    cycle.tracks = Some(TrackList { stamp_ns: tracks_ns, items });
    cycle.detections = Some(DetectionList { stamp_ns: seen_ns, items: seen });
    cycle.detection_history = lists;
}
