//! F-01 to F-11: thresholds, horizons, the map, the grid.

use mufasa_model::input::cycle::Track;
use mufasa_model::services::configuration::Configuration::{AllRemote, MotRemote, PlanRemote};

use crate::vectors::base::{
    base, cross_section, detection, detections, lead, move_point, point, points, road, straight,
    track, tracks, turn, with,
};
use crate::vectors::book::Book;
use crate::vectors::expected::{fails, fails_by, safe};
use crate::vectors::findings::{bare, finding, witness};
use crate::vectors::hardened::objects::ghost_in_the_mean;
use crate::vectors::stages::collision::standing;
use crate::vectors::stages::grid::stage_v;
use crate::vectors::stages::schedule::without;
use crate::vectors::stages::track_validation::stage_i;

/// Adds their vectors.
pub fn add(book: &mut Book) {
    assignment(book);
    horizons(book);
    checks(book);
    map(book);
}

fn assignment(book: &mut Book) {
    let topic = finding("findings/F-01", "F-01");
    let note = "Six gated tracks, theta_tr = 0.25 m: a ghost 1.4 m from every detection, less than \
                6 theta_tr, hides in the mean.";
    let caught = fails_by("i", "no_assignment");
    witness(book, topic, ("hidden", note), &caught, |p| ghost_in_the_mean(p, 1.4, 0));
    let note = "From k theta_tr = 1.5 m on it is caught.";
    let cycle = ghost_in_the_mean(mufasa_model::input::cycle::Profile::Paper, 1.5, 0);
    book.cycle(topic, "caught", note, &cycle, &fails_by("i", "mean_cost"));
    let topic = finding("findings/F-02", "F-02");
    let note = "Two gated tracks, one detection: the ghost at 30 m is compared with nothing.";
    witness(book, topic, ("", note), &caught, |profile| {
        let received = vec![track(1, 60.0, 0.0), track(2, 30.0, 0.0)];
        stage_i(profile, received, vec![detection(60.0, 0.0)])
    });
    let topic = finding("findings/F-03", "F-03");
    let note = "A lorry of 12 m overlaps the CAV, its centre is 5 m away.";
    witness(book, topic, ("", note), &fails_by("iii", "collision"), |profile| {
        standing(profile, Track { length: 12.0, ..track(1, 5.0, 0.0) })
    });
}

fn horizons(book: &mut Book) {
    let topic = finding("findings/F-04", "F-04");
    let note = "40 m/s: s_CAV = 72 m, but braking takes s_b = 100 m. The car is touched at 76 m.";
    witness(book, topic, ("", note), &fails_by("iii", "collision"), |profile| {
        bare(profile, PlanRemote, |cycle| {
            cycle.ego.speed = 40.0;
            cycle.trajectory = Some(straight(51, 4.0));
            cycle.route = road(-100.0, 300.0);
            cycle.tracks = Some(tracks(vec![track(1, 80.0, 0.0)]));
        })
    });
    let topic = finding("findings/F-05", "F-05");
    let note = "16 m/s: s_b = 16 m. A made-up leading vehicle at 40 m/s shortens s_valid to \
                s_follow = 8 m, and the obstacle is touched at 16 m.";
    witness(book, topic, ("", note), &fails_by("iv", "collision"), |profile| {
        bare(profile, MotRemote, |cycle| {
            cycle.ego.speed = 16.0;
            cycle.parameters.safety_time = 0.5;
            cycle.trajectory = Some(straight(21, 1.6));
            cycle.lead = lead(100.0, 40.0);
            cycle.detections = Some(detections(vec![detection(20.0, 0.0)]));
        })
    });
    let topic = finding("findings/F-06", "F-06");
    let note = "At rest every horizon is 0, and the first step ends in a car.";
    witness(book, topic, ("", note), &fails_by("iii", "collision"), |profile| {
        bare(profile, PlanRemote, |cycle| {
            cycle.ego.speed = 0.0;
            cycle.trajectory = Some(straight(3, 1.0));
            cycle.tracks = Some(tracks(vec![track(1, 5.0, 0.0)]));
        })
    });
}

fn checks(book: &mut Book) {
    let topic = finding("findings/F-07", "F-07");
    for (name, configuration, missing) in
        [("plan", PlanRemote, "tdg"), ("mot", MotRemote, "dg"), ("all", AllRemote, "tdg")]
    {
        let note = "Without these inputs the trajectory is compared with no obstacle.";
        let caught = fails("no_obstacle_check");
        witness(book, topic, (name, note), &caught, |profile| {
            without(base(profile, configuration), missing)
        });
    }
    let topic = finding("findings/F-08", "F-08");
    let note = "A disk of r = 1.118 m around (7.5, 0.99) covers the corner of the occupied cell \
                from (8, 1) to (9, 2), whose centre is 1.414 m from the centre of the disk's cell.";
    witness(book, topic, ("", note), &fails_by("v", "occupied"), |profile| {
        with(stage_v(profile, [8, 1]), |cycle| {
            for point in crate::vectors::base::points_of(cycle) {
                point.y = 0.99;
            }
        })
    });
}

fn map(book: &mut Book) {
    let topic = finding("findings/F-09", "F-09");
    let note = "A point 0.2 m beside the path is nearer than theta_map = 0.3 m, though the \
                corridor ends at 0.125 m.";
    witness(book, topic, ("", note), &fails_by("ii", "corridor"), |profile| {
        bare(profile, PlanRemote, |cycle| {
            cycle.tracks = Some(tracks(vec![]));
            cycle.route.cross_sections =
                vec![cross_section(-100.0, 0.125), cross_section(200.0, 0.125)];
            move_point(cycle, 9, [9.0, 0.2]);
        })
    });
    let note = "Only the reference point is tested: the footprint is 2 m wide, the corridor 1 m.";
    witness(book, topic, ("footprint", note), &safe(), |profile| {
        bare(profile, PlanRemote, |cycle| {
            cycle.tracks = Some(tracks(vec![]));
            cycle.route.cross_sections =
                vec![cross_section(-100.0, 0.5), cross_section(200.0, 0.5)];
        })
    });
    let topic = finding("findings/F-10", "F-10");
    let note = "The trajectory is driven backwards.";
    witness(book, topic, ("backwards", note), &fails_by("ii", "direction"), |profile| {
        bare(profile, PlanRemote, |cycle| {
            cycle.tracks = Some(tracks(vec![]));
            turn(cycle, -1.0, 0.0);
        })
    });
    let note = "The trajectory starts 90 m from the CAV.";
    witness(book, topic, ("far", note), &fails_by("ii", "start_position"), |profile| {
        bare(profile, PlanRemote, |cycle| {
            cycle.tracks = Some(tracks(vec![]));
            cycle.ego.x = 90.0;
        })
    });
    let topic = finding("findings/F-11", "F-11");
    let note = "Points are 10 m apart: an obstacle of 1 m between two of them is jumped over.";
    witness(book, topic, ("", note), &fails("ii"), |profile| {
        bare(profile, PlanRemote, |cycle| {
            let every = |i: i32| point(i64::from(i) * 1_000_000_000, f64::from(i) * 10.0, 0.0);
            cycle.trajectory = Some(points((0..4).map(every).collect()));
            let small = Track { length: 1.0, ..track(1, 5.0, 0.0) };
            cycle.tracks = Some(tracks(vec![small]));
        })
    });
}
