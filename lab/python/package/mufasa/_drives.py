"""Readers of drives."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from typing import Any, overload

from . import _native
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
        ``empty-tracks@2..5`` (seconds). Its cycles are made at once, and kept.

        Raises ``InvalidInput`` when that is no attack, or changes nothing."""
        return Drive(self._stream.attacked(attack))

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
