//! The CAV's own numbers: parameters, pose, speed and size (`spec/4-arithmetic.md#domain`).

use crate::input::cycle::Ego;
use crate::input::domain::place::{ANY, Check, POSITION, Place, SIZE, SPEED};
use crate::input::parameters::Parameters;

const AT: Place = Place { index: None };

pub(crate) fn check_parameters(parameters: &Parameters) -> Check {
    // DOM-01; A-20
    macro_rules! check {
        ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
            $(AT.$number(concat!("parameters.", stringify!($name)), parameters.$name, $domain)?;)*
        };
    }
    crate::parameters!(check);
    Ok(())
}

pub(super) fn check_ego(ego: &Ego) -> Check {
    AT.f64("ego.x", ego.x, POSITION)?;
    AT.f64("ego.y", ego.y, POSITION)?;
    AT.f64("ego.cos", ego.cos, ANY)?;
    AT.f64("ego.sin", ego.sin, ANY)?;
    AT.direction("ego.cos", ego.cos, ego.sin)?;
    // DIST-02
    AT.f64("ego.speed", ego.speed, SPEED)?;
    AT.f64("ego.length", ego.length, SIZE)?;
    AT.f64("ego.width", ego.width, SIZE)?;
    AT.f64("ego.center_offset", ego.center_offset, [-100.0, 100.0])
}
