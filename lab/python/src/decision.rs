//! What a cycle ends in.

use std::sync::Arc;

use mufasa::monitor::{Brake, Decision as NativeDecision};
use mufasa_props::bridge;
use mufasa_records::monitor_answer::BrakeAnswer;
use pyo3::prelude::*;

use crate::actions::{Actions, ToDo};
use crate::answers::{of_json, verdict};
use crate::errors::{UnsafeCycle, invalid};
use crate::verified::{Call, Calls, VerifiedTracks, VerifiedTrajectory};

/// The end of a cycle, true when it was safe. The requester has been told: after an unsafe cycle no group is
/// remote.
#[pyclass(frozen, module = "mufasa")]
pub struct Decision {
    pub call: Call,
    data: Option<Data>,
    report: Option<Py<PyAny>>,
    error: Option<Py<PyAny>>,
    brake: Option<Py<PyAny>>,
    actions: Py<Actions>,
}

/// Of a safe cycle.
struct Data {
    tracks: Option<Py<VerifiedTracks>>,
    trajectory: Option<Py<VerifiedTrajectory>>,
}

impl Decision {
    pub fn new(
        py: Python<'_>,
        calls: &Calls,
        decision: &NativeDecision<'_>,
        to_do: Arc<ToDo>,
    ) -> PyResult<Self> {
        let call = || calls.current();
        let actions = Py::new(py, Actions::new(to_do))?;
        let report = |report| {
            let report = bridge::report_from_impl(report);
            verdict(py, String::new(), report).map(Bound::unbind)
        };
        let brake = |brake: &Option<Brake>| {
            let brake = brake.map(|it| BrakeAnswer::new(bridge::brake_from_impl(it)));
            let brake = brake.map(|it| of_json(py, "brake_of", &it)).transpose()?;
            PyResult::Ok(brake.map(Bound::unbind))
        };
        Ok(match decision {
            NativeDecision::Safe { tracks, trajectory, report: of_safe, brake: says } => {
                let tracks = tracks.as_ref().map(|it| Py::new(py, VerifiedTracks::new(call(), it)));
                let trajectory =
                    trajectory.as_ref().map(|it| Py::new(py, VerifiedTrajectory::new(call(), it)));
                let data =
                    Some(Data { tracks: tracks.transpose()?, trajectory: trajectory.transpose()? });
                let (report, error) = (Some(report(of_safe)?), None);
                Self { call: call(), data, report, error, brake: brake(says)?, actions }
            }
            NativeDecision::Unsafe { report: why, brake: says } => {
                let (report, error) = match why {
                    Ok(of_unsafe) => (Some(report(of_unsafe)?), None),
                    Err(problem) => {
                        let problem = invalid(bridge::invalid_input_from_impl(problem));
                        (None, Some(problem.into_value(py).into_any()))
                    }
                };
                Self { call: call(), data: None, report, error, brake: brake(says)?, actions }
            }
        })
    }

    /// What has to be done, whether or not it was looked at.
    pub fn to_do<'py>(&self, py: Python<'py>) -> &Bound<'py, Actions> {
        self.actions.bind(py)
    }

    fn data(&self) -> PyResult<&Data> {
        self.call.is_last()?;
        self.data.as_ref().ok_or_else(|| {
            UnsafeCycle::new_err(
                "the cycle was unsafe: nothing of it may reach control; look at report or error, and \
                 go on with the local services",
            )
        })
    }
}

#[pymethods]
impl Decision {
    /// Whether the cycle was safe.
    #[getter]
    fn safe(&self) -> bool {
        self.data.is_some()
    }

    fn __bool__(&self) -> bool {
        self.safe()
    }

    /// The tracks of the station, while MOT is remote, they are current, and the CAV had current detections
    /// to compare them with.
    ///
    /// Raises ``UnsafeCycle``, and ``Expired`` from the monitor's next call on.
    #[getter]
    fn tracks(&self, py: Python<'_>) -> PyResult<Option<Py<VerifiedTracks>>> {
        Ok(self.data()?.tracks.as_ref().map(|it| it.clone_ref(py)))
    }

    /// The trajectory that was checked, while a group is remote, it is current and, in the hardened
    /// profile, the CAV has current detections: that of the station, or while MOT alone is remote that of
    /// the CAV's own planner. In Local nothing is checked.
    ///
    /// Raises ``UnsafeCycle``, and ``Expired`` from the monitor's next call on.
    #[getter]
    fn trajectory(&self, py: Python<'_>) -> PyResult<Option<Py<VerifiedTrajectory>>> {
        Ok(self.data()?.trajectory.as_ref().map(|it| it.clone_ref(py)))
    }

    /// What the stages found; None when local input is invalid.
    #[getter]
    fn report(&self, py: Python<'_>) -> Option<Py<PyAny>> {
        self.report.as_ref().map(|it| it.clone_ref(py))
    }

    /// What local input is invalid; then the cycle is unsafe.
    #[getter]
    fn error(&self, py: Python<'_>) -> Option<Py<PyAny>> {
        self.error.as_ref().map(|it| it.clone_ref(py))
    }

    /// Why control has to brake with at least ``a_b`` along what it followed last, from this cycle on until one says None:
    /// the CAV's own plan is missing or fails. Only with ``supervise_local``.
    #[getter]
    fn brake(&self, py: Python<'_>) -> Option<Py<PyAny>> {
        self.brake.as_ref().map(|it| it.clone_ref(py))
    }

    /// Releases to be sent, and local services that start or stop.
    #[getter]
    fn actions(&self, py: Python<'_>) -> Py<Actions> {
        self.actions.clone_ref(py)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let shown = |it: &Option<Py<PyAny>>| match it {
            Some(it) => it.bind(py).repr().map(|text| text.to_string()),
            None => Ok(String::from("None")),
        };
        let (safe, error) = (if self.safe() { "True" } else { "False" }, shown(&self.error)?);
        Ok(format!("Decision(safe={safe}, report={}, error={error})", shown(&self.report)?))
    }
}
