"""A vehicle loop at 20 Hz around the monitor, with a stand-in for the road and for a station. From 4 s on
to 5 s the station's tracks are 3 m aside: the monitor falls back to the local services, waits t_wait, and
offloads again. The same loop as ``impl/examples/vehicle.rs``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import timedelta
from typing import Any

from mufasa import (
    Activate,
    Actions,
    CrossSection,
    Deactivate,
    Detection,
    Detections,
    Ego,
    Gap,
    Group,
    InvalidInput,
    Lead,
    Monitor,
    Release,
    Request,
    Time,
    Track,
    Trajectory,
    TrajectoryPoint,
    VerifiedTrajectory,
)

# As docs/configuration.md advises.
PERIOD = timedelta(milliseconds=50)
TAU_NS = 250_000_000
BUILD_UP = timedelta(milliseconds=100)  # from the command to full braking, the vehicle's own
# Cycles.
SECOND = 20
CYCLES = 20 * SECOND
LOST = 2 * SECOND  # the cycle whose messages are lost


def main() -> None:
    # From now of a cycle to braking with a_b (docs/assumptions.md, A-07).
    monitor = Monitor(PERIOD, parameters={"tau": TAU_NS / 1e9})
    # A straight road of 300 m, 6 m wide.
    road = [CrossSection(x, 0.0, (x, 3.0), (x, -3.0)) for x in range(-50, 260, 10)]
    monitor.set_route(road)

    station = Station()
    driven: list[TrajectoryPoint] = []
    fallbacks = copied = 0
    kept: list[TrajectoryPoint] = []
    brake_by: Time | None = None
    for cycle in range(CYCLES):
        # The period after the loss comes 1 ms late, which a dt_max of two periods alone would not bear.
        now = Time.from_milliseconds(1000 // SECOND * cycle + (cycle == LOST + 1))
        world = World(now)

        # What came over the network since the last period, and time itself.
        if cycle == 0:
            station.hear(monitor.offer, now, 1, ["mot", "plan"])
            station.hear(monitor.offer, now, 0, ["mot", "plan"])
        asked, station.asked = station.asked, []
        for request in asked:
            station.hear(monitor.confirm, now, 1, request.group, request.session)
        station.take(monitor.tick(now))
        if (session := station.sessions.get("mot")) is not None and cycle != LOST:
            aside = 3.0 if 4 * SECOND <= cycle < 5 * SECOND else 0.0
            station.hear(
                monitor.tracks, now, station=1, session=session, generated=now, stamp=now, items=world.tracks(aside)
            )
        if (session := station.sessions.get("plan")) is not None and cycle != LOST:
            station.hear(
                monitor.trajectory, now, station=1, session=session, generated=now, stamp=now, points=world.trajectory()
            )

        # What the CAV measured and planned itself; then the one way to what the station sent.
        # A planner that stands has no plan, also in the period in which it is told to start.
        own_plan = None if station.planner_stands else world.trajectory()
        is_local = monitor.configuration == "Local"
        decision = monitor.cycle(
            now,
            world.ego,
            detections=Detections(now, world.detections()),
            lead=Lead(now, Gap.between_bumpers(world.gap), 5.0),
            local_trajectory=None if own_plan is None else Trajectory(now, own_plan),
        )
        station.take(decision.actions)
        if cycle in (LOST, LOST + 1) and decision.trajectory is None:
            raise SystemExit("a lost message was not bridged")
        # What contradicts itself, told once: for a log that somebody reads.
        if (advice := monitor.advice()) is not None:
            print("advice:", advice)
        if decision.safe and decision.trajectory is not None:
            driven.append(follow(decision.trajectory))
            kept, brake_by = list(decision.trajectory.points), decision.trajectory.brake_by
        elif own_plan is not None and is_local:
            # Of a cycle with anything remote an own plan is driven only when it came out (MON-67).
            driven.append(own_plan[0])
            kept, brake_by = list(own_plan), Time.from_nanoseconds(now.nanoseconds + TAU_NS)
        elif kept and (brake_by is None or brake_by - now > BUILD_UP):
            # No other is there, also after an unsafe cycle: the copy of what was followed last. By its brake_by the CAV
            # brakes fully; control, which runs more often than cycles do, looks at that time itself.
            driven.append(next(point for point in kept if point.t_ns > now.nanoseconds))
            copied += 1
        if not decision.safe:
            report = decision.report
            why = decision.error if report is None else f"stage {report.failed_stage}"
            print(f"{cycle / SECOND:4.1f} s: unsafe: {why}, back to the local services")
            fallbacks += 1
        if cycle % SECOND == 0:
            print(f"{cycle / SECOND:4.1f} s: {monitor.configuration}")

    if fallbacks != 1 or copied != 1 or station.ignored != 1 or monitor.configuration != "AllRemote":
        raise SystemExit(f"{fallbacks} fallbacks, {copied} copies, {monitor.configuration}")
    print(f"{len(driven)} points driven, one fallback, offloading again")


def follow(trajectory: VerifiedTrajectory) -> TrajectoryPoint:
    """A controller for what others planned takes a verified trajectory and nothing else."""
    return trajectory.points[0]


class World:
    """The CAV, driving at 5 m/s, a car 20 m ahead of it and one beside the road that do the same."""

    gap = 20.0

    def __init__(self, now: Time) -> None:
        self.now = now
        x = 5e-9 * now.nanoseconds
        self.ego = Ego(x, 0.0, 1.0, 0.0, speed=5.0, length=4.5, width=1.9, center_offset=1.4)
        self.ahead = x + self.ego.center_offset + 0.5 * self.ego.length + self.gap + 2.25

    def detections(self) -> list[Detection]:
        places = [(self.ahead, 0.0), (self.ahead + 20.0, 8.0)]
        return [Detection(x, y, 1.0, 0.0, length=4.5, width=1.9) for x, y in places]

    def tracks(self, aside: float) -> list[Track]:
        places = [(7, self.ahead, aside), (8, self.ahead + 20.0, 8.0)]
        return [Track(name, x, y, 1.0, 0.0, 5.0, 0.0, length=4.5, width=1.9) for name, x, y in places]

    def trajectory(self) -> list[TrajectoryPoint]:
        start_ns, x = self.now.nanoseconds, self.ego.x
        return [
            TrajectoryPoint(start_ns + i * 100_000_000, x + 0.5 * i, 0.0, 1.0, 0.0) for i in range(30)
        ]


@dataclass
class Station:
    """It confirms what it is asked for, and sends results until it is released."""

    asked: list[Request] = field(default_factory=list)
    sessions: dict[Group, int] = field(default_factory=dict)
    planner_stands: bool = False
    ignored: int = 0

    def hear(self, call: Callable[..., Actions], *given: Any, **named: Any) -> None:
        """What the monitor says to a message. A station can make it an error, such as a station below 1 or a full table:
        nothing has changed then, and the loop goes on."""
        try:
            self.take(call(*given, **named))
        except InvalidInput as why:
            print(f"ignored: {why}")
            self.ignored += 1

    def take(self, actions: Actions) -> None:
        """Where the vehicle's actions go: to the network, and to its own services."""
        for action in actions:
            if isinstance(action, Request):
                self.asked.append(action)
                self.sessions[action.group] = action.session
            elif isinstance(action, Release):
                self.sessions.pop(action.group, None)
            elif isinstance(action, Activate):
                print(f"        local services of {action.group} start")
                self.planner_stands &= action.group != "plan"
            elif isinstance(action, Deactivate):
                print(f"        local services of {action.group} stop")
                self.planner_stands |= action.group == "plan"


if __name__ == "__main__":
    main()
