//! Of what kinds a scene is.

use crate::named::named;
use crate::services::detectors::random::Draws;

named! {
    /// What is remote.
    Remote {
        /// The tracks.
        Mot = "mot-remote",
        /// The trajectory; the tracks are the CAV's own, and true.
        Plan = "plan-remote",
        /// Both.
        All = "all-remote",
    }

    /// How the trajectory differs from what the CAV drives.
    Shift {
        /// It begins at the CAV, now.
        None = "none",
        /// It begins up to 1.9 m ahead.
        Ahead = "ahead",
        /// It begins up to 0.49 m aside, turned by up to 0.16.
        Aside = "aside",
        /// It begins up to 4 m ahead, up to 100 ms ago.
        Old = "old",
        /// It begins up to 1.9 m behind, in up to 100 ms.
        Early = "early",
        /// It changes into another lane, and may begin ahead.
        LaneChange = "lane-change",
        /// It ends in the other's way.
        Ends = "ends",
    }

    /// What the tracks say about the other.
    Lie {
        /// The truth.
        True = "true",
        /// Nothing.
        LeftOut = "left-out",
        /// That it stands.
        Stands = "stands",
        /// That it goes elsewhere, or faster or slower.
        Velocity = "velocity",
        /// That it is smaller.
        Size = "size",
    }

    /// Where the other comes from.
    Side {
        /// From the left or the right, on a straight line.
        Crossing = "crossing",
        /// Along the way, towards the CAV.
        Oncoming = "oncoming",
        /// Along the way, faster than the CAV, beside it.
        Behind = "behind",
        /// Along the way, slower than the CAV.
        AheadInLane = "ahead-in-lane",
        /// Along the adjacent lane.
        Adjacent = "adjacent",
        /// From nowhere.
        Standing = "standing",
    }

    /// What the other does.
    Motion {
        /// It keeps its speed.
        Keeps = "keeps",
        /// It brakes, to a stop.
        Brakes = "brakes",
        /// It speeds up.
        SpeedsUp = "speeds-up",
        /// It turns.
        Turns = "turns",
    }

    /// What the CAV does when nobody stops it.
    Drive {
        /// It keeps its speed.
        Keeps = "keeps",
        /// It creeps.
        Creeps = "creeps",
        /// It starts from rest.
        Starts = "starts",
        /// It speeds up.
        SpeedsUp = "speeds-up",
        /// It stops.
        Stops = "stops",
    }
}

/// One of these, each as likely as the others.
pub(super) fn pick<T: Copy>(draws: &mut Draws, of: &[T]) -> T {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "few kinds"
    )]
    let index = (draws.share() * of.len() as f64) as usize;
    of[index.min(of.len() - 1)]
}
