//! The intelligent driver model (Treiber, Hennecke and Helbing, 2000).

/// Parameters of a driver. The default is that of the institute's simulation (uulm-mrm/tpl, `SimIdmParams`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Idm {
    /// Speed on a free road, m/s.
    pub v0: f64,
    /// Time gap, s.
    pub headway: f64,
    /// Gap at standstill, m.
    pub s0: f64,
    /// Acceleration, m/s^2.
    pub a: f64,
    /// Comfortable deceleration, above zero, m/s^2.
    pub b: f64,
}

impl Default for Idm {
    fn default() -> Self {
        Self { v0: 50.0 / 3.6, headway: 1.5, s0: 2.0, a: 1.5, b: 3.0 }
    }
}

impl Idm {
    /// Acceleration with nobody ahead, m/s^2: a (1 - (v/v0)^4).
    pub fn free(&self, speed: f64) -> f64 {
        let share = speed / self.v0.max(0.1);
        let square = share * share;
        self.a * (1.0 - square * square)
    }

    /// Acceleration behind somebody, m/s^2: a (1 - (v/v0)^4 - (s*/s)^2) with
    /// s* = s0 + max(v T + v (v - v_lead) / (2 sqrt(a b)), 0); gaps below 10 cm count as 10 cm.
    pub fn behind(&self, speed: f64, gap: f64, lead_speed: f64) -> f64 {
        let approach = speed * (speed - lead_speed) / (2.0 * (self.a * self.b).sqrt());
        let wanted = self.s0 + (speed * self.headway + approach).max(0.0);
        let share = wanted / gap.max(0.1);
        self.free(speed) - self.a * share * share
    }
}
