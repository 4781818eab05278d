//! What has to be done about an event or a cycle.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use mufasa::monitor::DropReason;
use mufasa::offloading::requester::Action as NativeAction;
use mufasa_model::offloading::requester::Action;
use mufasa_props::bridge;
use mufasa_records::names;
use pyo3::prelude::*;
use pyo3::types::{PyIterator, PyList};

/// What has to be done about a call, kept by the monitor before anything of Python runs: whatever is raised
/// then, the next call has them.
pub struct ToDo {
    items: Vec<Action>,
    /// Why the element that arrived is of no use, if there is one.
    why: Option<DropReason>,
    taken: AtomicBool,
}

impl ToDo {
    pub fn new(actions: &[NativeAction], why: Option<DropReason>) -> Arc<Self> {
        let items: Vec<Action> = actions.iter().copied().map(bridge::action_from_impl).collect();
        Arc::new(Self { taken: AtomicBool::new(items.is_empty()), items, why })
    }

    pub fn are_taken(&self) -> bool {
        self.taken.load(Ordering::Relaxed)
    }
}

/// What has to be done, in this order. Iterate over it: the monitor's next call raises ``ActionsNotTaken``
/// when there are some that nobody has looked at.
#[pyclass(frozen, module = "mufasa")]
pub struct Actions {
    to_do: Arc<ToDo>,
}

impl Actions {
    pub const fn new(to_do: Arc<ToDo>) -> Self {
        Self { to_do }
    }

    fn list<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let actions = self.to_do.items.iter().map(|it| action(py, it, self.to_do.why));
        let actions: PyResult<Vec<_>> = actions.collect();
        PyList::new(py, actions?)
    }

    fn take<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let list = self.list(py)?;
        self.to_do.taken.store(true, Ordering::Relaxed);
        Ok(list)
    }
}

#[pymethods]
impl Actions {
    fn __len__(&self) -> usize {
        self.to_do.items.len()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.take(py)?.try_iter()
    }

    fn __getitem__<'py>(&self, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.take(index.py())?.as_any().get_item(index)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("Actions({})", self.list(py)?.repr()?))
    }
}

/// An action as Python's; `why` of an element that is dropped.
fn action<'py>(
    py: Python<'py>,
    action: &Action,
    why: Option<DropReason>,
) -> PyResult<Bound<'py, PyAny>> {
    let class = |name| py.import("mufasa._types")?.getattr(name);
    match *action {
        Action::Request { station, group, session } => {
            class("Request")?.call1((station, names::group(group), session))
        }
        Action::Release { station, group, session } => {
            class("Release")?.call1((station, names::group(group), session))
        }
        Action::Activate(group) => class("Activate")?.call1((names::group(group),)),
        Action::Deactivate(group) => class("Deactivate")?.call1((names::group(group),)),
        Action::Drop(group) => class("Drop")?.call1((names::group(group), why.map(word))),
    }
}

/// As `DropReason` of `mufasa._types` has it.
const fn word(why: DropReason) -> &'static str {
    match why {
        DropReason::TooLong => "too_long",
        DropReason::OtherSession => "other_session",
        DropReason::FromTheFuture => "from_the_future",
        DropReason::Late => "late",
        DropReason::TooOld => "too_old",
        DropReason::Starved => "starved",
        DropReason::AfterSilence => "after_silence",
        DropReason::NotNewer => "not_newer",
    }
}
