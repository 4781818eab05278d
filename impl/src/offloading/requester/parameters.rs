//! Times of a requester, with defaults (`spec/2-offloading.md`, paper Table II).

use crate::offloading::quality_of_service::Limits;

/// All parameters of a requester; nothing else of this crate names them all.
/// `requester_parameters!(each)` expands to `each! { .. }` with one entry for each:
/// `/// what it is` `name: type = default;`, the type being `i64` (from 0 to 2^63 - 1) or `bool`.
/// Source: `spec/2-offloading.md`, `spec/4-arithmetic.md#domain`.
#[macro_export]
macro_rules! requester_parameters {
    ($each:ident) => {
        $each! {
            /// How long offloading is barred after a safety issue, ns.
            t_wait_ns: i64 = 10_000_000_000;
            /// How long a request waits for its confirmation, ns.
            request_timeout_ns: i64 = 500_000_000;
            /// Largest latency that is no violation, ns.
            l_max_ns: i64 = 50_000_000;
            /// Largest inter-arrival time that is no violation, ns.
            dt_max_ns: i64 = 100_000_000;
            /// Whether a violation of quality of service starts a hold, too (I-09).
            qos_hold: bool = false;
        }
    };
}

macro_rules! fields {
    ($($(#[$doc:meta])* $name:ident: $kind:ident = $default:literal;)*) => {
        /// The times of a requester, each from 0 to 2^63 - 1 ns. Source: `spec/2-offloading.md`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct Parameters {
            $(
                $(#[$doc])*
                ///
                #[doc = concat!("Default ", stringify!($default), ".")]
                pub $name: $kind,
            )*
        }

        impl Default for Parameters {
            fn default() -> Self {
                // DOM-02
                Self { $($name: $default,)* }
            }
        }

        impl Parameters {
            /// The first time below 0.
            pub(super) fn negative(&self) -> Option<&'static str> {
                // DOM-01
                $(if i64::from(self.$name) < 0 {
                    return Some(stringify!($name));
                })*
                None
            }
        }
    };
}

requester_parameters!(fields);

impl Parameters {
    pub(super) const fn limits(&self) -> Limits {
        Limits { l_max_ns: self.l_max_ns, dt_max_ns: self.dt_max_ns }
    }
}
