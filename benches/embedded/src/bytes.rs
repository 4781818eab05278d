//! Cases as bytes, little endian, field by field: every number keeps its bits. What is read stays, as the rest
//! of a run.

use alloc::vec::Vec;

use mufasa::input::cycle::{
    CrossSection, Cycle, Detection, DetectionList, Ego, Grid, Lead, Route, Track, TrackList,
    Trajectory, TrajectoryPoint,
};
use mufasa::input::parameters::Parameters;
use mufasa::input::profile::Profile;
use mufasa::monitor::Calibration;
use mufasa::report::Stage;
use mufasa::services::configuration::Configuration;

use crate::{Case, Task};

/// What can be written and read again.
pub trait Bytes: Sized {
    /// Puts it behind what is there.
    fn write(&self, to: &mut Vec<u8>);

    /// Takes it from the front.
    ///
    /// # Panics
    /// When something else was written.
    fn read(from: &mut &[u8]) -> Self;
}

macro_rules! numbers {
    ($($number:ident)*) => {$(
        impl Bytes for $number {
            fn write(&self, to: &mut Vec<u8>) {
                to.extend(self.to_le_bytes());
            }

            fn read(from: &mut &[u8]) -> Self {
                let (first, rest) = from.split_first_chunk().expect("a number");
                *from = rest;
                Self::from_le_bytes(*first)
            }
        }
    )*};
}

numbers!(u8 i64 f64);

/// By the index in a list of all values.
macro_rules! choices {
    ($($choice:ty: $all:expr;)*) => {$(
        impl Bytes for $choice {
            fn write(&self, to: &mut Vec<u8>) {
                let index = $all.iter().position(|it| it == self).expect("one of them");
                to.extend(u8::try_from(index));
            }

            fn read(from: &mut &[u8]) -> Self {
                $all[usize::from(u8::read(from))]
            }
        }
    )*};
}

choices! {
    bool: [false, true];
    Profile: [Profile::PAPER, Profile::HARDENED];
    Configuration: [
        Configuration::Local, Configuration::MotRemote, Configuration::AllRemote, Configuration::PlanRemote,
    ];
    Task: [
        Task::Check, Task::Kept, Task::Stage(Stage::I), Task::Stage(Stage::Ii), Task::Stage(Stage::Iii),
        Task::Stage(Stage::Iv), Task::Stage(Stage::V), Task::Input,
        Task::Calibrate(Calibration::Motions), Task::Calibrate(Calibration::Assignment),
    ];
}

impl<T: Bytes> Bytes for Option<T> {
    fn write(&self, to: &mut Vec<u8>) {
        self.is_some().write(to);
        self.iter().for_each(|it| it.write(to));
    }

    fn read(from: &mut &[u8]) -> Self {
        bool::read(from).then(|| T::read(from))
    }
}

impl<T: Bytes> Bytes for &[T] {
    fn write(&self, to: &mut Vec<u8>) {
        i64::try_from(self.len()).expect("a length").write(to);
        self.iter().for_each(|it| it.write(to));
    }

    fn read(from: &mut &[u8]) -> Self {
        (0..i64::read(from)).map(|_| T::read(from)).collect::<Vec<_>>().leak()
    }
}

impl Bytes for [f64; 2] {
    fn write(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|it| it.write(to));
    }

    fn read(from: &mut &[u8]) -> Self {
        [f64::read(from), f64::read(from)]
    }
}

macro_rules! structs {
    ($($name:ident $(<$life:lifetime>)? { $($field:ident)* })*) => {$(
        impl $(<$life>)? Bytes for $name $(<$life>)? {
            fn write(&self, to: &mut Vec<u8>) {
                let Self { $($field),* } = self;
                $($field.write(to);)*
            }

            fn read(from: &mut &[u8]) -> Self {
                Self { $($field: Bytes::read(from)),* }
            }
        }
    )*};
}

structs! {
    Case<'a> { task cycle }
    Cycle<'a> {
        profile parameters now_ns configuration ego trajectory tracks detections lead route grid detection_history
    }
    Ego { x y cos sin speed length width center_offset }
    Trajectory<'a> { stamp_ns points }
    TrajectoryPoint { t_ns x y cos sin }
    TrackList<'a> { stamp_ns items }
    Track { id x y cos sin vx vy length width }
    DetectionList<'a> { stamp_ns items }
    Detection { x y cos sin length width }
    Lead { stamp_ns gap speed }
    Route<'a> { closed cross_sections }
    CrossSection { x y left right }
    Grid<'a> { stamp_ns x y cos sin resolution width height occupied unknown }
}

macro_rules! parameters {
    ($($(#[$doc:meta])* $name:ident: $number:ident = $default:literal in $domain:expr;)*) => {
        structs! { Parameters { $($name)* } }
    };
}

mufasa::parameters!(parameters);
