//! What the planner knows.

/// What the planner knows. Ways are along the path from the CAV's reference point, m, negative behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Arc length of the CAV on the path, m.
    pub s: f64,
    /// How far left of the path it is, m.
    pub left: f64,
    /// Sine and cosine of the angle from the path's direction to its own.
    pub aside: (f64, f64),
    /// The leading vehicle.
    pub lead: Option<Leading>,
    /// Those that are crossing the path or will be.
    pub crossings: Vec<Crossing>,
    /// Where the map asks to stop, nearest first.
    pub stops: Vec<f64>,
}

/// A track in coordinates of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Way to its centre, m.
    pub ahead: f64,
    /// How far left of the path its centre is, m.
    pub left: f64,
    /// Half of what it covers along the path, m.
    pub half_length: f64,
    /// Half of what it covers across it, m.
    pub half_width: f64,
    /// Speed along the path, m/s.
    pub along: f64,
    /// Speed to the left of it, m/s.
    pub across: f64,
}

/// The leading vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leading {
    /// Way to its nearest point, m.
    pub ahead: f64,
    /// Speed along the path, m/s, at least 0.
    pub speed: f64,
}

/// When and where somebody is in our way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// First and last time that it is in the corridor, s from now; the last one is the horizon when it does
    /// not leave it before.
    pub time: [f64; 2],
    /// The stretch of the path that it covers then, m.
    pub ways: [f64; 2],
}
