"""A CommonRoad drive: its cycles as records, checked in both profiles, attacked, and driven with the
monitor. ``python commonroad.py [SCENARIO.xml [SOLUTION.xml]]``; without files the drive of the demo. The
cells (``# %%``) open as a notebook."""

# %% The drive. Its cycles are made when they are asked for.
from __future__ import annotations

import base64
import sys
from collections import Counter
from collections.abc import Iterable
from datetime import timedelta
from pathlib import Path
from typing import Any

import mufasa
from mufasa import Detections, Gap, GridMap, Lead, Monitor, Time, Trajectory

DEMO = Path(__file__).resolve().parents[2] / "drives" / "data" / "demo"
files = [Path(name) for name in sys.argv[1:]] or [DEMO / "urban.xml", DEMO / "urban.solution.xml"]
[drive] = mufasa.read_drives(*files)
print(f"{drive.name}: {len(drive)} cycles")
for note in drive.notes:
    print(f"  {note}")

# %% A record is plain data (spec/5-interfaces.md#cycle).
record = drive[0]
print(f"{len(record['tracks']['items'])} tracks, {len(record['detections']['items'])} detections,")
print(f"a plan of {len(record['trajectory']['points'])} points, a gap of {record['lead']}")

# %% Each cycle in both profiles. A verdict is true when the cycle is safe.
PROFILES: tuple[mufasa.Profile, ...] = ("paper", "hardened")


def tally(records: Iterable[mufasa.Record | str], profile: mufasa.Profile) -> str:
    ends: Counter[str] = Counter()
    for record in records:
        verdict = mufasa.check(record, profile)
        ends["safe" if verdict else f"stage {verdict.failed_stage}"] += 1
    return ", ".join(f"{count} {end}" for end, count in ends.most_common())


for profile in PROFILES:
    print(f"as recorded, {profile}: {tally(drive.lines(), profile)}")

# %% The paper's own attack: the track list is emptied, and the remote planner, who knows of no object, goes
# on at speed. The published method accepts it.
half_s = (drive[-1]["now_ns"] - drive[0]["now_ns"]) / 2e9
attacked = drive.attacked(f"empty-tracks@{min(2.0, half_s)}..")
for profile in PROFILES:
    print(f"under attack, {profile}: {tally(attacked.lines(), profile)}")

# %% What decided: the rule, where, and the two numbers that were compared.
for index, record in enumerate(attacked):
    verdict = mufasa.check(record)
    if not verdict:
        failed = {name: end["witness"] for name, end in verdict.stages.items() if "witness" in end}
        print(f"cycle {index}: {failed}")
        break

# %% A mistake names field and index.
broken = drive[0]
broken["route"]["stations"][1]["x"] = float("nan")
try:
    mufasa.check(broken)
except mufasa.InvalidInput as error:
    print(f"{error.field}, item {error.index}: {error.message}")

# %% The attacked drive through the monitor, which has configuration, history and route itself. The station
# sends the tracks and plans of the records.


def grid_map(grid: dict[str, Any]) -> GridMap:
    occupied, unknown = grid["occupied"], grid["unknown"]
    return GridMap(
        Time.from_nanoseconds(grid["stamp_ns"]),
        grid["x"],
        grid["y"],
        grid["cos"],
        grid["sin"],
        grid["resolution"],
        grid["width"],
        grid["height"],
        occupied=base64.b64decode(occupied),
        unknown=None if unknown is None else base64.b64decode(unknown),
    )


def period(drive: mufasa.Drive) -> timedelta:
    first, second = drive[0]["now_ns"], drive[1]["now_ns"]
    return timedelta(microseconds=(second - first) // 1000)


monitor = Monitor(period(drive), parameters={"dt_max_ns": 250_000_000, "t_wait_ns": 3_000_000_000, "tau": 0.25})
monitor.set_route(drive[0]["route"]["stations"], closed=drive[0]["route"]["closed"])
sessions: dict[mufasa.Group, int] = {}
asked: list[mufasa.Request] = []
timeline: list[str] = []
driven: Counter[str] = Counter()


def take(actions: mufasa.Actions) -> None:
    """The station confirms in the next period; the CAV's own services would start and stop here."""
    for action in actions:
        if isinstance(action, mufasa.Request):
            asked.append(action)
        elif isinstance(action, mufasa.Release):
            sessions.pop(action.group, None)
        elif isinstance(action, mufasa.Drop):
            raise SystemExit(f"dropped: {action}")


for index, record in enumerate(attacked):
    now = Time.from_nanoseconds(record["now_ns"])
    if index == 0:
        take(monitor.offer(now, 1, ["mot", "plan"]))
    confirmed, asked = asked, []
    for request in confirmed:
        take(monitor.confirm(now, request.station, request.group, request.session))
        sessions[request.group] = request.session
    take(monitor.tick(now))
    if (session := sessions.get("mot")) is not None:
        stamp = Time.from_nanoseconds(record["tracks"]["stamp_ns"])
        items = record["tracks"]["items"]
        take(
            monitor.tracks(
                now, station=1, session=session, generated=stamp, stamp=stamp, items=items
            )
        )
    if (session := sessions.get("plan")) is not None:
        stamp = Time.from_nanoseconds(record["trajectory"]["stamp_ns"])
        points = record["trajectory"]["points"]
        take(
            monitor.trajectory(
                now, station=1, session=session, generated=stamp, stamp=stamp, points=points
            )
        )

    seen, lead = record["detections"], record["lead"]
    decision = monitor.cycle(
        now,
        record["ego"],
        detections=Detections(Time.from_nanoseconds(seen["stamp_ns"]), seen["items"]),
        lead=lead
        and Lead(
            Time.from_nanoseconds(lead["stamp_ns"]), Gap.between_bumpers(lead["gap"]), lead["speed"]
        ),
        grid=grid_map(record["grid"]),
        local_trajectory=Trajectory(now, record["trajectory"]["points"]),
    )
    take(decision.actions)
    if decision.safe:
        trajectory = decision.trajectory
        driven["local" if trajectory is None else f"station {trajectory.station}"] += 1
    else:
        driven["local, after an unsafe cycle"] += 1
    if not timeline or not timeline[-1].endswith(monitor.configuration):
        timeline.append(f"from cycle {index} {monitor.configuration}")

print("; ".join(timeline))
print("driven: " + ", ".join(f"{count} by {source}" for source, count in driven.items()))
