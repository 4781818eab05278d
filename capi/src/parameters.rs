//! The parameters of the stages and of a requester for C: the same names as in `mufasa`, as that
//! lists them. `tests/header.rs` writes these structs out for the header.

/// The type of a parameter for C; a truth value is a number there.
macro_rules! c_type {
    (f64) => {
        f64
    };
    (i64) => {
        i64
    };
    (bool) => {
        u32
    };
}

/// A parameter from C.
macro_rules! from_c {
    (bool, $value:expr) => {
        $value != 0
    };
    ($kind:ident, $value:expr) => {
        $value
    };
}

macro_rules! c_parameters {
    ($($(#[$doc:meta])* $name:ident: $kind:ident = $default:literal in $domain:expr;)*) => {
        same_names!(MufasaParameters, mufasa::input::parameters::Parameters, $($(#[$doc])* $name: $kind = $default;)*);
    };
}

macro_rules! c_requester_parameters {
    ($($(#[$doc:meta])* $name:ident: $kind:ident = $default:literal;)*) => {
        same_names!(MufasaRequesterParameters, mufasa::offloading::requester::Parameters, $($(#[$doc])* $name: $kind = $default;)*);
    };
}

macro_rules! same_names {
    ($c:ident, $rust:path, $($(#[$doc:meta])* $name:ident: $kind:ident = $default:literal;)*) => {
        /// Parameters; names, defaults and domains as in spec/.
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $c {
            $(
                $(#[$doc])*
                #[doc = concat!("Default: ", stringify!($default))]
                pub $name: c_type!($kind),
            )*
        }

        impl From<$rust> for $c {
            fn from(parameters: $rust) -> Self {
                Self { $($name: parameters.$name.into(),)* }
            }
        }

        impl From<$c> for $rust {
            fn from(raw: $c) -> Self {
                Self { $($name: from_c!($kind, raw.$name),)* }
            }
        }
    };
}

mufasa::parameters!(c_parameters);
mufasa::requester_parameters!(c_requester_parameters);
