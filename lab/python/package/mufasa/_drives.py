"""Readers of drives."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from html import escape
from importlib import import_module
from typing import Any, overload

from . import _native
from ._check import check
from ._types import Configuration, Profile


class Drive(Sequence[dict[str, Any]]):
    """The cycles of a drive as records (``spec/5-interfaces.md#cycle``), each made when it is asked
    for, and not kept."""

    def __init__(self, stream: _native.Stream) -> None:
        self._stream = stream

    @property
    def name(self) -> str:
        """Unique among the drives of one call."""
        return self._stream.name

    @property
    def source(self) -> str:
        """The files that it was read from."""
        return self._stream.source

    @property
    def notes(self) -> list[str]:
        """Decisions of the reader that a judgement of this drive depends on."""
        return self._stream.notes

    def lines(self) -> Iterator[str]:
        """The records as JSON, a line each: what ``check`` reads fastest."""
        return (self._stream.line(index) for index in range(len(self)))

    def attacked(self, attack: str) -> Drive:
        """The same drive under an attack, as ``mufasa check --inject`` names it, such as
        ``empty-tracks@2..5`` (seconds; ``ATTACKS`` has the names). Its cycles are made at once, and kept.

        Raises ``InvalidInput`` when that is no attack, or changes nothing."""
        return Drive(self._stream.attacked(attack))

    def to_frame(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each cycle: its time, the CAV, how much is around it, the lead,
        and the verdict. Needs pandas."""
        return import_module("pandas").DataFrame([_row(line) for line in self.lines()])

    def plot(self, axes: Any = None) -> Any:
        """Draws the way of the CAV between the bounds of its route into matplotlib's ``axes``, new ones if none
        are given, which are returned. Needs matplotlib."""
        axes = axes or import_module("matplotlib.pyplot").subplots()[1]
        records = list(self)
        for side in ("left", "right"):
            axes.plot(*zip(*(it[side] for it in records[0]["route"]["stations"])), color="grey")
        axes.plot(*zip(*((it["ego"]["x"], it["ego"]["y"]) for it in records)), label=self.name)
        axes.set_aspect("equal")
        return axes

    def __repr__(self) -> str:
        return f"Drive({self.name!r}, {len(self)} cycles)"

    def _repr_html_(self) -> str:
        notes = "".join(f"<li>{escape(note)}</li>" for note in self.notes)
        return f"<p>{escape(repr(self))} of {escape(self.source)}</p><ul>{notes}</ul>"

    def __len__(self) -> int:
        return self._stream.count

    @overload
    def __getitem__(self, index: int) -> dict[str, Any]: ...

    @overload
    def __getitem__(self, index: slice) -> list[dict[str, Any]]: ...

    def __getitem__(self, index: int | slice) -> dict[str, Any] | list[dict[str, Any]]:
        places = range(len(self))[index]
        if isinstance(places, range):
            return [self._record(place) for place in places]
        return self._record(places)

    def _record(self, place: int) -> dict[str, Any]:
        record: dict[str, Any] = json.loads(self._stream.line(place))
        return record


def _row(line: str) -> dict[str, Any]:
    record, verdict = json.loads(line), check(line)
    ego, lead = record["ego"], record["lead"] or {}
    return {
        "id": record["id"],
        "t_s": record["now_ns"] / 1e9,
        **{name: ego[name] for name in ("x", "y", "speed")},
        **{name: len((record[name] or {"items": ()})["items"]) for name in ("detections", "tracks")},
        "lead_gap": lead.get("gap"),
        "lead_speed": lead.get("speed"),
        "safe": verdict.safe,
        "failed_stage": verdict.failed_stage,
    }


def read_drives(
    *paths: str | os.PathLike[str],
    profile: Profile = "hardened",
    configuration: Configuration = "AllRemote",
    ego: int | None = None,
    horizon_s: float = 5.0,
    keep_tail: bool = False,
    seed: int = 1,
) -> list[Drive]:
    """Reads drives from files: CommonRoad scenarios (one drive of a recorded vehicle, ``ego`` or one
    that is picked), scenarios followed by their solutions (one drive each), maps of control points,
    and cycles as JSON Lines (which the options do not touch); each may be packed as gz.

    ``horizon_s``: length of the planned trajectories. ``keep_tail``: also cycles whose rest is shorter
    than braking takes. ``seed``: of the simulated sensors.

    Raises ``ReadError`` for the first file that gives no drive.
    """
    streams = _native.streams(
        [os.fspath(path) for path in paths], profile, configuration, ego, horizon_s, keep_tail, seed
    )
    return [Drive(stream) for stream in streams]
