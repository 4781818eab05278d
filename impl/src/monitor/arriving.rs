//! What becomes of a message (`spec/monitor.md#monitor`).

use super::element::DropReason;
use super::served::Served;
use crate::offloading::requester::per_group::PerGroup;
use crate::offloading::requester::{ByKind, Event, EventKind, Requester, RequesterError};
use crate::services::configuration::Group;
use crate::stages::order::is_current;

/// Sessions are numbered from 1.
const NO_SESSION: i64 = 0;

/// A message but for its items. Source: `spec/monitor.md#monitor`.
#[derive(Clone, Copy, Debug)]
pub struct Arriving {
    /// The station's id.
    pub station: i64,
    /// Whose results these are.
    pub group: Group,
    /// The session that it names.
    pub session: i64,
    /// When the station made it, ns.
    pub generated_ns: i64,
    /// Its stamp, ns.
    pub stamp_ns: i64,
    /// It has more tracks than the lent memory is for.
    pub is_too_long: bool,
}

impl PerGroup<Served> {
    /// Why the message is of no use, if it is not; and what has to be done about it.
    ///
    /// Errors: a station below 1.
    pub(crate) fn receive(
        &mut self,
        requester: &mut Requester<'_>,
        now_ns: i64,
        message: &Arriving,
        max_age_ns: i64,
        period_ns: impl Fn() -> i64,
    ) -> Result<(Option<DropReason>, ByKind), RequesterError> {
        let Arriving { station, group, session, generated_ns, stamp_ns, is_too_long } = *message;
        // What is in time, but so old that no cycle can use it any more, is of no session, so that it is
        // no arrival; nor is what no cycle could hold. What is stamped ahead may be for the next cycle, as
        // long as cycles use any.
        let is_in_time = is_current(generated_ns, now_ns, requester.parameters().l_max_ns);
        let is_too_old = stamp_ns < now_ns && !is_current(stamp_ns, now_ns, max_age_ns);
        let is_starved = self.get(group).is_starved;
        // MON-20, MON-30, MON-32
        let is_no_arrival = is_too_long || (is_in_time && (is_too_old || is_starved));
        let named = if is_no_arrival { NO_SESSION } else { session };
        let running = requester.session_of(group);
        //
        let is_running = running.is_some_and(|it| (it.station, it.session) == (station, session));
        let kind = EventKind::Data { station, group, session: named, generated_ns };
        let by_kind = self.step(requester, &Event { t_ns: now_ns, kind }, false, period_ns)?;
        let [drops, ..] = by_kind;
        if drops == [None; 2] {
            return Ok((None, by_kind));
        }
        // MON-09
        let why = if !is_running {
            DropReason::OtherSession
        } else if is_too_long {
            DropReason::TooLong
        } else if generated_ns > now_ns {
            DropReason::FromTheFuture
        } else if !is_in_time {
            DropReason::Late
        } else if is_too_old {
            DropReason::TooOld
        } else if is_starved {
            DropReason::Starved
        } else if requester.session_of(group).is_none() {
            DropReason::AfterSilence
        } else {
            DropReason::NotNewer
        };
        Ok((Some(why), by_kind))
    }
}
