"""What goes in and comes out. SI units; directions as cos and sin; places in one right-handed frame
(``spec/5-interfaces.md#cycle``). The order of the fields is that of the columns of an array."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Literal, NamedTuple, Union

from ._native import Gap, Time

Profile = Literal["paper", "hardened"]
Configuration = Literal["Local", "MotRemote", "AllRemote", "PlanRemote"]
Group = Literal["mot", "plan"]
DropReason = Literal[
    "other_session",
    "too_long",
    "from_the_future",
    "late",
    "too_old",
    "starved",
    "after_silence",
    "not_newer",
]

Record = Mapping[str, Any]
"""A record of ``spec/5-interfaces.md#cycle``."""

Rows = Iterable[Any]
"""Items of one kind: a plain N x k array, a structured one, or any iterable of named tuples, dataclasses,
mappings, or rows of numbers. By name what is more than asked for is not read; by place the number of
columns has to be right."""


class Ego(NamedTuple):
    """Pose, speed and size of the CAV."""

    x: float
    """Of the reference point: the rear axle, or up to L/2 ahead of it; m."""
    y: float
    cos: float
    sin: float
    speed: float
    """m/s."""
    length: float
    """m."""
    width: float
    """m."""
    center_offset: float
    """From the reference point forward to the centre of the rectangle, m."""


class Track(NamedTuple):
    """A tracked object; the centre of its rectangle, its velocity over ground."""

    id: int
    x: float
    y: float
    cos: float
    sin: float
    vx: float
    vy: float
    length: float
    width: float


class Detection(NamedTuple):
    """A detected object; the centre of its rectangle."""

    x: float
    y: float
    cos: float
    sin: float
    length: float
    width: float


class TrajectoryPoint(NamedTuple):
    """A pose of the CAV's reference point."""

    t_ns: int
    """When the CAV is to be there, in ns of its clock."""
    x: float
    y: float
    cos: float
    sin: float


class CrossSection(NamedTuple):
    """A reference point of the route with its boundary points. Flat rows have six columns: x, y,
    left x, left y, right x, right y."""

    x: float
    y: float
    left: tuple[float, float]
    right: tuple[float, float]


class Detections(NamedTuple):
    """All that the CAV's own detectors saw."""

    stamp: Time
    """When it was measured."""
    items: Rows
    """Of ``Detection``."""


class _Lead(NamedTuple):
    stamp: Time
    gap: Gap
    speed: float


class Lead(_Lead):
    """The leading vehicle: when it was measured, the gap, and its speed along the path at that time, at least 0, m/s.

    Raises ``TypeError`` for a bare number as time or gap."""

    __slots__ = ()

    def __new__(cls, stamp: Time, gap: Gap, speed: float) -> Lead:
        for name, value, kind in (("stamp", stamp, Time), ("gap", gap, Gap)):
            if not isinstance(value, kind):
                raise TypeError(f"lead.{name} must be a mufasa.{kind.__name__}, not {value!r}")
        return super().__new__(cls, stamp, gap, speed)


class Tracks(NamedTuple):
    """Tracks of the CAV's own MOT."""

    stamp: Time
    """The time that they are valid for."""
    items: Rows
    """Of ``Track``."""


class Trajectory(NamedTuple):
    """A trajectory of the CAV's own planner."""

    stamp: Time
    """When it was made."""
    points: Rows
    """Of ``TrajectoryPoint``."""


class GridMap(NamedTuple):
    """An occupancy grid map. The cell (column i, row k) is the square from (i, k) to (i+1, k+1) times
    the resolution, in the frame (x, y, cos, sin)."""

    stamp: Time
    """When it was measured."""
    x: float
    """Of the corner of the cell (0, 0), m."""
    y: float
    cos: float
    """Direction of the rows."""
    sin: float
    resolution: float
    """Side of a cell, m."""
    width: int
    """Columns."""
    height: int
    """Rows."""
    occupied: bytes
    """Bit row * width + column, least significant bit of each byte first: of a bool array ``cells`` of
    the shape (height, width) ``np.packbits(cells, bitorder="little").tobytes()``."""
    unknown: bytes | None = None
    """The same form; a cell both occupied and unknown is occupied."""


class Request(NamedTuple):
    """Ask a station to run a group."""

    station: int
    group: Group
    session: int


class Release(NamedTuple):
    """Tell a station that a session has ended."""

    station: int
    group: Group
    session: int


class Activate(NamedTuple):
    """Start the local services of a group."""

    group: Group


class Deactivate(NamedTuple):
    """Stop the local services of a group."""

    group: Group


class Drop(NamedTuple):
    """Do not use the element that arrived; ``why``: of several reasons the first in the order of
    ``DropReason``. ``from_the_future``, ``late`` and ``after_silence`` have ended its session."""

    group: Group
    why: DropReason


Action = Union[Request, Release, Activate, Deactivate, Drop]


class Session(NamedTuple):
    """A running session of a group."""

    station: int
    session: int
