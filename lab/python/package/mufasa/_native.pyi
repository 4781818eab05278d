"""The native part: the implementation, its monitor, readers of drives."""

from collections.abc import Iterator, Sequence
from datetime import timedelta
from typing import Any, TypeVar, final, overload

from ._errors import InvalidInput
from ._types import (
    Action,
    Configuration,
    Detections,
    Ego,
    GridMap,
    Group,
    Lead,
    Profile,
    Record,
    Rows,
    Session,
    Track,
    Tracks,
    Trajectory,
    TrajectoryPoint,
)
from ._verdict import Brake, Verdict

__all__ = [
    "ATTACKS",
    "Actions",
    "Decision",
    "Gap",
    "Monitor",
    "Stream",
    "Time",
    "VerifiedTracks",
    "VerifiedTrajectory",
    "__version__",
    "check",
    "streams",
    "svg",
]

__version__: str

ATTACKS: tuple[str, ...]

def svg(record: str, profile: Profile | None) -> str: ...
def check(record: str, profile: Profile | None) -> Verdict: ...
def streams(
    paths: list[str],
    profile: Profile,
    configuration: Configuration,
    ego: int | None,
    horizon_s: float,
    keep_tail: bool,
    seed: int,
) -> list[Stream]: ...

@final
class Stream:
    @property
    def name(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def count(self) -> int: ...
    def line(self, index: int) -> str: ...
    def attacked(self, attack: str) -> Stream: ...

@final
class Time:
    """A point in time on the CAV's one monotonic clock: the same clock for all that reaches one monitor,
    stamps of stations included. A bare number is not a time.

    What does not fit into 64 bits of nanoseconds raises ``InvalidInput``."""

    @staticmethod
    def from_nanoseconds(ns: int) -> Time: ...
    @staticmethod
    def from_microseconds(us: int) -> Time: ...
    @staticmethod
    def from_milliseconds(ms: int) -> Time: ...
    @staticmethod
    def from_seconds(seconds: float) -> Time:
        """To about the nearest nanosecond."""

    @property
    def nanoseconds(self) -> int: ...
    def __sub__(self, value: Time, /) -> timedelta:
        """To the nearest microseconds, which is what ``timedelta`` has; exact are ``nanoseconds``."""

    def __rsub__(self, value: Time, /) -> timedelta: ...
    def __hash__(self) -> int: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __lt__(self, value: Time, /) -> bool: ...
    def __le__(self, value: Time, /) -> bool: ...
    def __gt__(self, value: Time, /) -> bool: ...
    def __ge__(self, value: Time, /) -> bool: ...

@final
class Gap:
    """The free distance along the reference path to the leading vehicle, bumper to bumper. A bare number
    is no gap: measured from elsewhere it is wrong by metres."""

    @staticmethod
    def between_bumpers(metres: float) -> Gap:
        """From the CAV's front bumper to the rear bumper of the leading vehicle."""

    @staticmethod
    def from_reference_point(metres: float, ego: Ego | Record) -> Gap:
        """From the CAV's reference point (``ego.x``, ``ego.y``) to that rear bumper."""

    @property
    def metres(self) -> float: ...
    def __eq__(self, value: object, /) -> bool: ...

@final
class Actions:
    """What has to be done, in this order. Iterate over it: the monitor's next call raises
    ``ActionsNotTaken`` when there are some that nobody has looked at."""

    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[Action]: ...
    @overload
    def __getitem__(self, key: int, /) -> Action: ...
    @overload
    def __getitem__(self, key: slice, /) -> list[Action]: ...

@final
class VerifiedTracks:
    """Tracks of a station that a safe cycle has compared with what the CAV sees. Everything raises ``Expired`` from the
    monitor's next call on."""

    @property
    def stamp(self) -> Time:
        """When it was made, or what it is valid for."""

    @property
    def station(self) -> int:
        """The station that it comes from; 0 is the CAV."""

    @property
    def items(self) -> list[Track]: ...
    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        """For numpy: a structured array, or with a ``dtype`` of numbers a plain N x k one."""

@final
class VerifiedTrajectory:
    """A trajectory that a safe cycle has checked: what control follows should take nothing else.
    Everything raises ``Expired`` from the monitor's next call on."""

    @property
    def stamp(self) -> Time:
        """When it was made, or what it is valid for."""

    @property
    def station(self) -> int:
        """The station that it comes from; 0 is the CAV."""

    @property
    def points(self) -> list[TrajectoryPoint]: ...
    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        """For numpy: a structured array, or with a ``dtype`` of numbers a plain N x k one."""

    @property
    def brake_by(self) -> Time | None:
        """By when control has to brake along it, with at least ``a_b``, unless a later cycle has given one or,
        in Local, there is a plan of the CAV's own: what was examined covers no more. None in the paper profile."""

@final
class Decision:
    """The end of a cycle, true when it was safe. The requester has been told: after an unsafe cycle no
    group is remote."""

    @property
    def safe(self) -> bool: ...
    def __bool__(self) -> bool: ...
    @property
    def tracks(self) -> VerifiedTracks | None:
        """The tracks of the station, while MOT is remote, they are current, and the CAV had current
        detections to compare them with.

        Raises ``UnsafeCycle``, and ``Expired`` from the monitor's next call on."""

    @property
    def trajectory(self) -> VerifiedTrajectory | None:
        """The trajectory that was checked, while a group is remote, it is current and, in the hardened
        profile, the CAV has current detections: that of the station, or while MOT alone is remote that
        of the CAV's own planner. In Local nothing is checked.

        Raises ``UnsafeCycle``, and ``Expired`` from the monitor's next call on."""

    @property
    def report(self) -> Verdict | None:
        """What the stages found; None when local input is invalid."""

    @property
    def error(self) -> InvalidInput | None:
        """What local input is invalid; then the cycle is unsafe."""

    @property
    def brake(self) -> Brake | None:
        """Why control has to brake with at least ``a_b`` along what it followed last, from this cycle on until one says
        None: the CAV's own plan is missing or fails. Only with ``supervise_local``."""

    @property
    def actions(self) -> Actions:
        """Releases to be sent, and local services that start or stop."""

_Verified = TypeVar("_Verified", bound=VerifiedTracks | VerifiedTrajectory | Decision)

@final
class Monitor:
    """The monitor of one CAV (``spec/monitor.md#monitor``): events go in, actions come out; remote
    data are handed in and are out of reach until ``cycle`` has checked them.

    ``period``: the nominal period of the cycles and of the remote's results. ``parameters``: overrides of single defaults
    by the names of ``spec/`` (``theta_tr``, ``dt_max_ns``, ...); ``dt_max_ns``, two periods and 20 ms by default, has to
    be above the period, and ``tau`` is three periods and 0.1 s by default. ``sessions_before``: at least the last session of earlier lives, so that no
    message of one fits. ``most_stations``: that ever offer something, at most 65,536.
    ``supervise_local``: whether the CAV's own plan is examined in Local, so that ``Decision.brake`` says while it fails
    (F-48). ``stall``: the way, m, and the time after which planning that got no farther is given back (F-45); never where
    it is not given. ``check_time``: how long a cycle may take, any time where it is not given; it has memory for all of the domain.
    ``step_ps``: what a step costs here (``spec/4-arithmetic.md#steps``). ``meant``: names of parameters that are meant
    although no road vehicle has such a value (``spec/4-arithmetic.md#usual-settings``).

    Raises ``InvalidInput`` for settings that no monitor can keep. Every call raises ``ActionsNotTaken``
    when the one before gave actions that nobody has looked at, and ends what was verified before. An
    event that raises has changed nothing else. Not to be called by two threads at once.
    """

    def __new__(
        cls,
        period: timedelta,
        *,
        profile: Profile = "hardened",
        parameters: dict[str, Any] | None = None,
        sessions_before: int = 0,
        most_stations: int = 64,
        supervise_local: bool = False,
        stall: tuple[float, timedelta] | None = None,
        check_time: timedelta | None = None,
        step_ps: int = 1000,
        meant: Sequence[str] = (),
    ) -> Monitor: ...
    def set_route(self, cross_sections: Rows, *, closed: bool = False) -> None:
        """The CAV follows this route (``CrossSection``) from now on, of which a copy is kept. It has to lead up to s_stop."""

    def offer(self, now: Time, station: int, groups: Sequence[Group]) -> Actions:
        """A station, at least 1, offers groups; this replaces its previous offer."""

    def withdraw(self, now: Time, station: int) -> Actions:
        """A station withdraws its offer."""

    def lost(self, now: Time, station: int) -> Actions:
        """A station can no longer be reached."""

    def confirm(self, now: Time, station: int, group: Group, session: int) -> Actions:
        """A station confirms a session."""

    def reject(self, now: Time, station: int, group: Group, session: int) -> Actions:
        """A station rejects a session."""

    def area(self, now: Time, groups: Sequence[Group]) -> Actions:
        """From now on these groups may be offloaded (CODM)."""

    def tick(self, now: Time) -> Actions:
        """Time passes: to be called in each period, before its cycle."""

    def advice(self) -> str | None:
        """What the calling program seems to get wrong, each told once (``spec/4-arithmetic.md#advice``); else ``None``."""

    def tracks(
        self,
        now: Time,
        *,
        station: int,
        session: int,
        generated: Time,
        stamp: Time,
        items: Rows,
    ) -> Actions:
        """Tracks (``Track``) of a station arrive; they are copied. Used are those of the running session,
        in time, and newer than the last; of others the actions have a ``Drop`` that says why."""

    def trajectory(
        self,
        now: Time,
        *,
        station: int,
        session: int,
        generated: Time,
        stamp: Time,
        points: Rows,
    ) -> Actions:
        """As ``tracks``, for a trajectory (``TrajectoryPoint``)."""

    def cycle(
        self,
        now: Time,
        ego: Ego | Record,
        *,
        detections: Detections | None = None,
        lead: Lead | None = None,
        grid: GridMap | None = None,
        local_tracks: Tracks | None = None,
        local_trajectory: Trajectory | None = None,
    ) -> Decision:
        """Decides on what the CAV measured and what stations sent, and tells the requester: to be called
        in each period, offloading or not. What is not given is missing.

        Raises ``UnreadableInputs`` when something is of the wrong kind; the monitor has fallen back then,
        at ``now`` (of the wrong kind itself: at the time of the last call), and the error has the actions."""

    def own(self, verified: _Verified) -> _Verified:
        """The same data or decision, if they are of this monitor's last call.

        Raises ``OtherMonitor`` or ``Expired``."""

    @property
    def configuration(self) -> Configuration: ...
    def source(self, group: Group) -> int:
        """The station whose results of a group may reach control; 0 is the CAV."""

    def session_of(self, group: Group) -> Session | None:
        """The running session of a group that is remote."""

    @property
    def sessions(self) -> int:
        """The last session, for ``sessions_before`` of the next life."""

    @property
    def hold_until(self) -> Time | None:
        """No request is sent before this time; it stays when it has passed."""
