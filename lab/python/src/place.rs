//! A monitor together with the memory that it is lent. `self_cell` keeps the two in one value, which
//! Rust alone cannot say: it is small, widely used, and leaves this package without `unsafe`.

use mufasa::monitor::{Monitor, MonitorError, Settings};
use mufasa_props::lent::Lent;
use self_cell::{MutBorrow, self_cell};

/// The most detections of a list, and cross sections of a route (`spec/4-arithmetic.md#domain`): the
/// memory is enough for all of the domain, 2.5 MB.
const DETECTIONS: usize = 2048;
const CROSS_SECTIONS: usize = 8192;

self_cell!(
    /// A monitor in memory of its own.
    pub struct Place {
        owner: MutBorrow<Lent>,

        #[not_covariant]
        dependent: Monitor,
    }
);

impl Place {
    /// Everything local, no offers, no route. Errors: as of `Monitor::new`.
    pub fn with(settings: &Settings, most_stations: usize) -> Result<Self, MonitorError> {
        let lent = Lent::new(most_stations, DETECTIONS, CROSS_SECTIONS);
        Self::try_new(MutBorrow::new(lent), |lent| {
            Monitor::new(*settings, lent.borrow_mut().memory())
        })
    }
}
