//! Where the frame of the map lies on the earth (`spec/6-link.md#frame`).

use super::error::{EncodeError, Place, Problem};

/// Equatorial radius of WGS84, m.
const RADIUS: f64 = 6_378_137.0;
/// First eccentricity of WGS84, squared.
const ECCENTRICITY_SQUARED: f64 = 0.006_694_379_990_14;
/// Greatest latitude of a reference position, 0.1 microdegree.
const MOST_LATITUDE: i32 = 800_000_000;
/// Greatest longitude, 0.1 microdegree.
const MOST_LONGITUDE: i32 = 1_800_000_000;
/// How far a place may be from the reference position along each axis, m: 2^27 mm.
const REACH: f64 = 134_217.728;

/// The reference position: a point of the map's frame, and where it is on the earth. The map's x points
/// east and its y north. Vehicle and station need the same one. Source: `spec/6-link.md#frame`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    latitude: i32,
    longitude: i32,
    x: f64,
    y: f64,
    /// m in 0.1 microdegree to the east and to the north.
    scale: [f64; 2],
}

impl Frame {
    /// The frame whose point (x, y), in m, is at this latitude and longitude of WGS84, in 0.1
    /// microdegree, north and east positive.
    ///
    /// Errors: beyond 80 degrees of latitude or 180 of longitude; a point beyond +-2^24 m or not finite.
    /// Source: `spec/6-link.md#frame`.
    pub fn new(latitude: i32, longitude: i32, [x, y]: [f64; 2]) -> Result<Self, EncodeError> {
        let check = |field, value: f64, most: f64| {
            let problem = Problem::OutOfRange { least: -most, most };
            let is_inside = value.abs() <= most;
            is_inside.then_some(()).ok_or(EncodeError { place: Place::of("frame", field), problem })
        };
        check("latitude", latitude.into(), MOST_LATITUDE.into())?;
        check("longitude", longitude.into(), MOST_LONGITUDE.into())?;
        check("x", x, 16_777_216.0)?;
        check("y", y, 16_777_216.0)?;
        let unit = 1e-7_f64.to_radians();
        let (sin, cos) = libm::sincos(f64::from(latitude) * unit);
        let square = 1.0 - ECCENTRICITY_SQUARED * sin * sin;
        let across = RADIUS / libm::sqrt(square);
        let along = across * (1.0 - ECCENTRICITY_SQUARED) / square;
        Ok(Self { latitude, longitude, x, y, scale: [across * cos * unit, along * unit] })
    }

    /// The place of the reference position on the map, m.
    pub fn point(&self) -> [f64; 2] {
        [self.x, self.y]
    }

    /// Latitude and longitude of the reference position in WGS84, 0.1 microdegree.
    pub fn reference(&self) -> [i32; 2] {
        [self.latitude, self.longitude]
    }

    /// The place on the map of a latitude and longitude.
    pub(super) fn place(&self, [latitude, longitude]: [i32; 2]) -> [f64; 2] {
        let [east, north] = self.scale;
        let of = |value: i32, reference: i32| f64::from(value) - f64::from(reference);
        [
            self.x + of(longitude, self.longitude) * east,
            self.y + of(latitude, self.latitude) * north,
        ]
    }

    /// Latitude and longitude nearest to a place on the map, at most [`REACH`] away along each axis, and
    /// not beyond 180 degrees.
    pub(super) fn position(
        &self,
        part: &'static str,
        [x, y]: [f64; 2],
    ) -> Result<[i32; 2], EncodeError> {
        let of = |field, value: f64, own: f64, reference: i32, scale: f64, limit: i32| {
            let edge = |limit: i32| own + (f64::from(limit) - f64::from(reference)) * scale;
            let (least, most) = (edge(-limit).max(own - REACH), edge(limit).min(own + REACH));
            let place = Place::of(part, field);
            if !value.is_finite() {
                return Err(EncodeError { place, problem: Problem::NotFinite });
            }
            if !(least..=most).contains(&value) {
                return Err(EncodeError { place, problem: Problem::OutOfRange { least, most } });
            }
            #[allow(clippy::cast_possible_truncation, reason = "within the limit, as the value is")]
            let counts = libm::round((value - own) / scale) as i32;
            Ok(reference + counts)
        };
        let [east, north] = self.scale;
        Ok([
            of("y", y, self.y, self.latitude, north, 900_000_000)?,
            of("x", x, self.x, self.longitude, east, MOST_LONGITUDE)?,
        ])
    }
}
