//! Parameters of the protocol and their defaults (`spec/2-offloading.md`, paper Table II).

/// Times of the protocol in ns, each 0 to 2^63 - 1. `spec/2-offloading.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Parameters {
    /// Waiting time after a safety issue.
    pub t_wait_ns: i64,
    /// Time in which a request is to be confirmed.
    pub request_timeout_ns: i64,
    /// Largest latency.
    pub l_max_ns: i64,
    /// Largest inter-arrival time.
    pub dt_max_ns: i64,
    /// Whether a violation of quality of service starts the waiting time too (I-09).
    pub qos_hold: bool,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            t_wait_ns: 10_000_000_000,
            request_timeout_ns: 500_000_000,
            l_max_ns: 50_000_000,
            dt_max_ns: 100_000_000,
            qos_hold: false,
        }
    }
}

impl Parameters {
    /// Name of the first time outside 0 to 2^63 - 1, if any. `spec/4-arithmetic.md#domain`.
    pub fn first_outside_domain(&self) -> Option<&'static str> {
        [
            ("t_wait_ns", self.t_wait_ns),
            ("request_timeout_ns", self.request_timeout_ns),
            ("l_max_ns", self.l_max_ns),
            ("dt_max_ns", self.dt_max_ns),
        ]
        .into_iter()
        .find(|(_, value)| *value < 0)
        .map(|(name, _)| name)
    }
}
