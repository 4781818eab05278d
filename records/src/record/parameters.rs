//! The parameters of records: defaults overridden by name (`spec/5-interfaces.md#cycle`).

use mufasa_model::input::domain::check_parameters;
use mufasa_model::input::parameters as stages;
use mufasa_model::offloading::requester as protocol;
use mufasa_model::report::InvalidInput;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer};
use serde_json::{Map, Value, json};

use super::value::{Integer, Number};
use super::{Recorded, from_object};
use crate::typed::from_json;

/// How a parameter of this type is written.
macro_rules! written {
    (f64) => {
        Number
    };
    (i64) => {
        Integer
    };
    (bool) => {
        bool
    };
}

/// Parameters of a record: those of a type of the model, and more that mean nothing here. Those at
/// their default are left out when they are written; their order is that of the list.
macro_rules! overrides {
    (
        $(#[$meta:meta])*
        $name:ident = $model:path {
            $($(#[$doc:meta])* $field:ident: $type:ident,)*
        } + { $($(#[$more_doc:meta])* $more:ident: $more_type:ident,)* }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, Deserialize, JsonSchema)]
        #[serde(remote = "Self", default, deny_unknown_fields, expecting = "an object")]
        pub struct $name {
            $($(#[$doc])* pub $field: written!($type),)*
            $($(#[$more_doc])* pub $more: written!($more_type),)*
            /// Whether defaults are written, too.
            #[serde(skip)]
            pub whole: bool,
        }

        from_object!($name);

        impl Default for $name {
            fn default() -> Self {
                Self::of_model(&<$model>::default())
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, json: S) -> Result<S::Ok, S::Error> {
                let usual = Self::default();
                let mut fields = vec![
                    $((stringify!($field), json!(self.$field), json!(usual.$field)),)*
                ];
                fields.retain(|(_, value, usual)| self.whole || differ(value, usual));
                json.collect_map(fields.into_iter().map(|(name, value, _)| (name, value)))
            }
        }

        impl Recorded for $name {
            type Model = $model;

            fn into_model(self) -> $model {
                $model { $($field: self.$field.into_model()),* }
            }

            fn of_model(model: &$model) -> Self {
                let $model { $($field),* } = model;
                Self {
                    $($field: Recorded::of_model($field),)*
                    $($more: Recorded::of_model(&protocol::Parameters::default().$more),)*
                    whole: false,
                }
            }
        }
    };
}

/// Whether two values are written differently: 0.0 and -0.0 are equal and do differ.
fn differ(value: &Value, usual: &Value) -> bool {
    let [value, usual] = [value, usual].map(Value::to_string);
    value != usual
}

macro_rules! stage_parameters {
    ($($(#[$doc:meta])* $name:ident: $type:ident = $default:literal in $domain:expr;)*) => {
        overrides! {
            /// Overrides of single defaults; the times of the protocol mean nothing for a cycle.
            StageParameters = stages::Parameters {
                $($(#[$doc])* $name: $type,)*
            } + {
                /// Of the protocol.
                t_wait_ns: i64,
                /// Of the protocol.
                request_timeout_ns: i64,
                /// Of the protocol.
                l_max_ns: i64,
                /// Of the protocol.
                dt_max_ns: i64,
            }
        }
    };
}

mufasa_model::parameters!(stage_parameters);

overrides! {
    /// Overrides of single defaults; times in ns from 0 on.
    ProtocolParameters = protocol::Parameters {
        /// Waiting time after a safety issue.
        t_wait_ns: i64,
        /// Time in which a request is to be confirmed.
        request_timeout_ns: i64,
        /// Largest latency.
        l_max_ns: i64,
        /// Largest inter-arrival time.
        dt_max_ns: i64,
        /// Whether a violation of quality of service starts the waiting time too (I-09).
        qos_hold: bool,
    } + {}
}

macro_rules! all_parameters {
    ($($(#[$doc:meta])* $name:ident: $type:ident = $default:literal in $domain:expr;)*) => {
        /// The parameters of the stages and of the protocol.
        #[derive(Clone, Debug, PartialEq)]
        #[expect(missing_docs, reason = "documented in `mufasa_model`")]
        pub struct All {
            $(pub $name: $type,)*
            pub t_wait_ns: i64,
            pub request_timeout_ns: i64,
            pub l_max_ns: i64,
            pub dt_max_ns: i64,
            pub qos_hold: bool,
        }

        impl All {
            /// Both in one.
            pub fn of(stages: &stages::Parameters, protocol: &protocol::Parameters) -> Self {
                let stages::Parameters { $($name),* } = stages.clone();
                let protocol::Parameters {
                    t_wait_ns,
                    request_timeout_ns,
                    l_max_ns,
                    dt_max_ns,
                    qos_hold,
                } = *protocol;
                Self { $($name,)* t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold }
            }

            /// Those of the stages.
            pub fn stages(&self) -> stages::Parameters {
                stages::Parameters { $($name: self.$name),* }
            }
        }

        overrides! {
            /// Overrides of single defaults; times of the protocol in ns from 0 on.
            MonitorParameters = All {
                $($(#[$doc])* $name: $type,)*
                /// Waiting time after a safety issue.
                t_wait_ns: i64,
                /// Time in which a request is to be confirmed.
                request_timeout_ns: i64,
                /// Largest latency.
                l_max_ns: i64,
                /// Largest inter-arrival time.
                dt_max_ns: i64,
                /// Whether a violation of quality of service starts the waiting time too (I-09).
                qos_hold: bool,
            } + {}
        }
    };
}

mufasa_model::parameters!(all_parameters);

impl Default for All {
    fn default() -> Self {
        Self::of(&stages::Parameters::default(), &protocol::Parameters::default())
    }
}

impl All {
    /// Those of the protocol.
    pub fn protocol(&self) -> protocol::Parameters {
        let &Self { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold, .. } = self;
        protocol::Parameters { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, qos_hold }
    }
}

impl StageParameters {
    /// Whether the times of the protocol are in their domain.
    pub fn check(&self) -> Result<(), InvalidInput> {
        let &Self { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, .. } = self;
        let usual = ProtocolParameters::default();
        let times =
            ProtocolParameters { t_wait_ns, request_timeout_ns, l_max_ns, dt_max_ns, ..usual };
        times.check().map(|_| ())
    }
}

impl ProtocolParameters {
    /// The parameters if they are in their domain.
    pub fn check(self) -> Result<protocol::Parameters, InvalidInput> {
        let parameters = self.into_model();
        match parameters.first_outside_domain() {
            None => Ok(parameters),
            Some(name) => {
                let field = format!("parameters.{name}");
                let message = format!("{field} must be from 0 to 2^63 - 1 ns");
                Err(InvalidInput { field, index: None, message })
            }
        }
    }
}

/// The parameters of the stages and of the protocol that an object overrides by name. Errors: an
/// unknown name, a value of the wrong type or outside its domain.
pub fn settings(
    object: Map<String, Value>,
) -> Result<(stages::Parameters, protocol::Parameters), InvalidInput> {
    let names = json!(ProtocolParameters { whole: true, ..ProtocolParameters::default() });
    let is_protocol = |(name, _): &(String, Value)| names.get(name).is_some();
    let (protocol, stages): (Map<_, _>, Map<_, _>) = object.into_iter().partition(is_protocol);
    let protocol: ProtocolParameters = from_json(&Value::Object(protocol).to_string())?;
    let stages: StageParameters = from_json(&Value::Object(stages).to_string())?;
    let (stages, protocol) = (stages.into_model(), protocol.check()?);
    check_parameters(&stages)?;
    Ok((stages, protocol))
}

/// The names of all parameters.
pub fn names() -> Vec<String> {
    let stages = json!(StageParameters { whole: true, ..StageParameters::default() });
    let protocol = json!(ProtocolParameters { whole: true, ..ProtocolParameters::default() });
    let fields = [stages, protocol].into_iter().filter_map(|it| it.as_object().cloned());
    fields.flat_map(|fields| fields.into_iter().map(|(name, _)| name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names of an object in the order in which they are written, without their unit.
    fn written(parameters: &impl Serialize) -> Vec<String> {
        let text = serde_json::to_string(parameters).unwrap();
        let names = text.split('"').skip(1).step_by(2);
        names.map(|name| name.strip_suffix("_ns").unwrap_or(name).to_owned()).collect()
    }

    #[test]
    fn parameters_are_written_in_the_order_of_the_text() {
        let text = include_str!("../../../spec/3-stages.md");
        let list = text.lines().find(|line| line.starts_with("Parameters (")).unwrap();
        let pieces: Vec<_> = list.split(" = ").collect();
        let named = pieces.iter().take(pieces.len() - 1).filter_map(|it| it.split(' ').next_back());
        let whole = StageParameters { whole: true, ..StageParameters::default() };
        assert_eq!(written(&whole), named.chain(["delta"]).collect::<Vec<_>>());

        let text = include_str!("../../../spec/2-offloading.md");
        let (_, list) = text.split_once("Defaults: ").unwrap();
        let (list, _) = list.split_once(", lease").unwrap();
        let named = list.split(", ").filter_map(|it| it.split(' ').next());
        let whole = ProtocolParameters { whole: true, ..ProtocolParameters::default() };
        assert_eq!(written(&whole), named.chain(["qos_hold"]).collect::<Vec<_>>());
    }
}
