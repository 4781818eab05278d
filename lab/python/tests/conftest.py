"""A road, a CAV on it, a station, and a monitor that offloads to it."""

from __future__ import annotations

from datetime import timedelta
from pathlib import Path
from typing import Any

import pytest
from mufasa import (
    CrossSection,
    Decision,
    Detection,
    Detections,
    Ego,
    Gap,
    Lead,
    Monitor,
    Request,
    Time,
    Track,
    TrajectoryPoint,
)

ROOT = Path(__file__).resolve().parents[3]
PERIOD = timedelta(milliseconds=100)


def at(ms: int) -> Time:
    return Time.from_milliseconds(ms)


class Scene:
    """The CAV stands, a car is parked beside the road, the plan is to stay."""

    road = [CrossSection(float(x), 0.0, (x, 2.0), (x, -2.0)) for x in (-10, 90)]
    ego = Ego(0.0, 0.0, 1.0, 0.0, speed=0.0, length=4.5, width=1.9, center_offset=1.4)
    parked = [Detection(3.0, 5.0, 1.0, 0.0, length=4.5, width=1.9)]
    tracks = [Track(1, 3.0, 5.0, 1.0, 0.0, 0.0, 0.0, length=4.5, width=1.9)]
    aside = [tracks[0]._replace(y=4.0)]

    @staticmethod
    def plan(ms: int) -> list[TrajectoryPoint]:
        return [TrajectoryPoint(ms * 1_000_000, 0.0, 0.0, 1.0, 0.0)]

    @staticmethod
    def monitor(**settings: Any) -> Monitor:
        """With everything local, and a route; it has seen enough to ask a station at 0 ms."""
        settings.setdefault("parameters", {"dt_max_ns": 150_000_000, "tau": 0.25})
        monitor = Monitor(PERIOD, **settings)
        monitor.set_route(Scene.road)
        for ms in range(-500, 0, 100):
            assert Scene.decide(monitor, ms).safe
        return monitor

    @staticmethod
    def offloading(**settings: Any) -> Monitor:
        """With both groups remote at 0 ms, in the sessions 1 and 2."""
        monitor = Scene.monitor(**settings)
        list(monitor.offer(at(0), 1, ["mot", "plan"]))
        for request in list(monitor.tick(at(0))):
            assert isinstance(request, Request)
            list(monitor.confirm(at(0), 1, request.group, request.session))
        assert monitor.configuration == "AllRemote"
        return monitor

    @staticmethod
    def send(monitor: Monitor, ms: int, tracks: Any = tracks, points: Any = None) -> None:
        """The station's results of this time."""
        now = at(ms)
        [mot, plan] = monitor.session_of("mot"), monitor.session_of("plan")
        assert mot is not None and plan is not None
        of: dict[str, Any] = {"station": 1, "generated": now, "stamp": now}
        points = Scene.plan(ms) if points is None else points
        assert not monitor.tracks(now, session=mot.session, items=tracks, **of)
        assert not monitor.trajectory(now, session=plan.session, points=points, **of)

    @staticmethod
    def decide(monitor: Monitor, ms: int, **more: Any) -> Decision:
        """A tick and a cycle, their actions taken."""
        if monitor.configuration != "Local":
            list(monitor.tick(at(ms)))
        given = {"detections": Detections(at(ms), Scene.parked), **more}
        decision = monitor.cycle(at(ms), given.pop("ego", Scene.ego), **given)
        list(decision.actions)
        return decision

    @staticmethod
    def safe(monitor: Monitor, ms: int) -> Decision:
        """A safe cycle with results of the station."""
        Scene.send(monitor, ms)
        decision = Scene.decide(monitor, ms)
        assert decision.safe, decision
        return decision

    @staticmethod
    def lead(ms: int, gap: Gap) -> Lead:
        return Lead(at(ms), gap, 0.0)


@pytest.fixture
def scene() -> Scene:
    return Scene()
