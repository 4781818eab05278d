"""The monitor beside ``check``, and what it takes."""

from __future__ import annotations

import base64
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass
from datetime import timedelta
from typing import Any

import mufasa
import numpy as np
import pytest
from conftest import ROOT, Scene, at
from mufasa import Detections, Gap, GridMap, Lead, Time, Track, Verdict

# Of the monitor, and of the records that `check` is asked: the monitor refuses a record's default of tau with a period of 100 ms.
PARAMETERS: dict[str, Any] = {"dt_max_ns": 150_000_000, "tau": 0.25}
DEMO = [ROOT / "lab/drives/data/demo" / name for name in ("urban.xml", "urban.solution.xml")]


def ns(value: int) -> Time:
    return Time.from_nanoseconds(value)


def grid_map(grid: dict[str, Any]) -> GridMap:
    values = {key: value for key, value in grid.items() if key != "stamp_ns"}
    for key in ("occupied", "unknown"):
        values[key] = values[key] and base64.b64decode(values[key])
    return GridMap(stamp=ns(grid["stamp_ns"]), **values)


def seen_by(record: dict[str, Any]) -> Detections:
    seen = record["detections"]
    return Detections(ns(seen["stamp_ns"]), seen["items"])


def decided(records: list[dict[str, Any]], profile: mufasa.Profile) -> Verdict | None:
    """The report of the last cycle by a monitor that has seen those before, and is offloading in it."""
    monitor = mufasa.Monitor(timedelta(milliseconds=100), profile=profile, parameters=PARAMETERS)
    [*before, record] = records
    now, route = ns(record["now_ns"]), record["route"]
    monitor.set_route(route["stations"], closed=route["closed"])
    for earlier in before:
        decision = monitor.cycle(
            ns(earlier["now_ns"]), earlier["ego"], detections=seen_by(earlier)
        )
        assert decision.safe and not decision.actions
    list(monitor.offer(now, 1, ["mot", "plan"]))
    for request in monitor.tick(now):
        assert isinstance(request, mufasa.Request)
        list(monitor.confirm(now, 1, request.group, request.session))
    [mot, plan] = monitor.session_of("mot"), monitor.session_of("plan")
    assert mot is not None and plan is not None
    tracks, trajectory = record["tracks"], record["trajectory"]
    of: dict[str, Any] = {"station": 1, "generated": now, "stamp": ns(tracks["stamp_ns"])}
    assert not monitor.tracks(now, session=mot.session, items=tracks["items"], **of)
    of["stamp"] = ns(trajectory["stamp_ns"])
    assert not monitor.trajectory(now, session=plan.session, points=trajectory["points"], **of)
    lead = record["lead"]
    decision = monitor.cycle(
        now,
        record["ego"],
        detections=seen_by(record),
        lead=lead and Lead(ns(lead["stamp_ns"]), Gap.between_bumpers(lead["gap"]), lead["speed"]),
        grid=grid_map(record["grid"]),
    )
    list(decision.actions)
    return decision.report


@pytest.mark.parametrize("attack", [None, "ghost-tracks@3..", "missing-track@2.."])
@pytest.mark.parametrize("profile", ["paper", "hardened"])
def test_the_monitor_decides_as_check_does(attack: str | None, profile: mufasa.Profile) -> None:
    [drive] = mufasa.read_drives(*DEMO)
    drive = drive if attack is None else drive.attacked(attack)
    records = [{**record, "parameters": PARAMETERS} for record in drive]
    ends: Counter[str | None] = Counter()
    without_history = 0
    # In the first second the monitor remembers less than the record.
    for index in range(9, len(records)):
        record, found = records[index], decided(records[index - 9 : index + 1], profile)
        assert found is not None
        expected = mufasa.check(record, profile)
        assert (found.safe, found.stages) == (expected.safe, expected.stages), index
        ends[found.failed_stage] += 1
        forgetful = mufasa.check({**record, "detection_history": []}, profile)
        without_history += forgetful.stages != expected.stages
    assert ends[None] >= 10
    if attack is not None and profile == "hardened":
        assert len(ends) > 1, "the attack is seen"
    if attack == "missing-track@2..":
        assert (without_history > 0) == (profile == "hardened"), "the history is kept and used"


@dataclass
class Seen:
    """A user's own type, in an order of its own."""

    vx: float
    vy: float
    id: int
    width: float
    length: float
    sin: float
    cos: float
    y: float
    x: float
    color: str = "red"


TRACKS = [
    Track(7, 3.0, 5.0, 1.0, 0.0, 0.0, 0.0, 4.5, 1.9),
    Track(-8, 40.0, 9.0, 0.6, -0.8, 1.5, -2.5, 4.25, 1.75),
]
BY_NAME = [(name, "i8" if name == "id" else "f8") for name in Track._fields]
FORMS: dict[str, Any] = {
    "named tuples": TRACKS,
    "a generator": (track for track in TRACKS),
    "mappings": [track._asdict() for track in TRACKS],
    "mappings with more": [{**track._asdict(), "color": "red"} for track in TRACKS],
    "dataclasses": [Seen(**track._asdict()) for track in TRACKS],
    "rows": [list(track) for track in TRACKS],
    "arrays of one dimension": [np.array(track) for track in TRACKS],
    "a plain array": np.array(TRACKS),
    "a plain array of another order in memory": np.asfortranarray(np.array(TRACKS)),
    "a structured array": np.array(TRACKS, dtype=BY_NAME),
    "a structured array of other columns": np.array(
        [(*track[::-1], 0.0) for track in TRACKS], dtype=[*BY_NAME[::-1], ("age", "f8")]
    ),
    "rows of a structured array": list(np.array(TRACKS, dtype=BY_NAME)),
}


@pytest.mark.parametrize("form", FORMS)
def test_lists_come_in_many_forms(scene: Scene, form: str) -> None:
    monitor = scene.offloading()
    scene.send(monitor, 10, tracks=FORMS[form])
    decision = scene.decide(monitor, 10)
    assert decision.tracks is not None and decision.tracks.items == TRACKS
    assert [type(it.id) for it in decision.tracks.items] == [int, int]


def test_arrays_are_copied(scene: Scene) -> None:
    monitor = scene.offloading()
    items, points = np.array(TRACKS), np.array(scene.plan(10))
    scene.send(monitor, 10, items, points)
    items[:], points[:] = 0.0, 0.0
    decision = scene.decide(monitor, 10, ego=np.array(scene.ego))
    assert decision.tracks is not None and decision.tracks.items == TRACKS
    assert decision.trajectory is not None
    assert np.array_equal(np.array(decision.trajectory.points), np.array(scene.plan(10)))


def test_empty_lists_are_lists(scene: Scene) -> None:
    forms: list[Any] = [[], (), np.empty((0, 9)), np.array([])]
    for empty in forms:
        monitor = scene.offloading()
        scene.send(monitor, 10, tracks=empty)
        decision = scene.decide(monitor, 10)
        assert decision.tracks is not None and decision.tracks.items == []


def test_routes_come_in_many_forms(scene: Scene) -> None:
    flat = [(it.x, it.y, *it.left, *it.right) for it in scene.road]
    kinds = [("x", "f8"), ("y", "f8"), ("left", "f8", 2), ("right", "f8", 2)]
    forms: list[Any] = [
        [it._asdict() for it in scene.road],
        flat,
        np.array(flat),
        np.array([tuple(it) for it in scene.road], dtype=kinds),
        [list(it) for it in scene.road],
    ]
    for form in forms:
        monitor = scene.offloading()
        monitor.set_route(form)
        scene.safe(monitor, 10)
        monitor.set_route(np.array(flat) + [0.0, 50.0, 0.0, 50.0, 0.0, 50.0])
        scene.send(monitor, 20)
        assert not scene.decide(monitor, 20).safe, "now the route is elsewhere"


def test_all_of_the_domain_fits(scene: Scene) -> None:
    """``spec/4-arithmetic.md#domain``: sizes."""
    # What H-14 examines of so many is above the default.
    parameters = {"dt_max_ns": 150_000_000, "tau": 0.25, "work_limit": 10**9}
    monitor = scene.offloading(parameters=parameters)
    x = np.linspace(-10.0, 90.0, 8192)
    zero, two = np.zeros_like(x), np.full_like(x, 2.0)
    monitor.set_route(np.column_stack([x, zero, x, two, x, -two]))
    many = [scene.parked[0]._replace(x=1000.0 + 10.0 * i) for i in range(2047)]
    far = [scene.tracks[0]._replace(id=i, x=1000.0 + 10.0 * i) for i in range(2, 1025)]
    scene.send(monitor, 10, tracks=[*scene.tracks, *far])
    assert scene.decide(monitor, 10, detections=Detections(at(10), [*scene.parked, *many])).safe
    scene.send(monitor, 20)
    more = scene.decide(monitor, 20, detections=Detections(at(20), [*scene.parked, *many] * 2))
    assert not more and more.error is not None and more.error.field == "detections.items"
    with pytest.raises(mufasa.InvalidInput) as error:
        monitor.set_route([scene.road[0]._replace(x=float(i)) for i in range(8193)])
    assert error.value.field == "route.stations"


BROKEN: list[tuple[Any, str, int | None]] = [
    ([scene_track := TRACKS[0]._asdict(), {**scene_track, "vx": "fast"}], "tracks.items.vx", 1),
    ([{key: it for key, it in scene_track.items() if key != "vy"}], "tracks.items.vy", 0),
    ([{**scene_track, "id": 7.5}], "tracks.items.id", 0),
    ([{**scene_track, "id": 2**63}], "tracks.items.id", 0),
    ([{**scene_track, "id": 2.0**60}], "tracks.items.id", 0),
    ([{**scene_track, "id": True}], "tracks.items.id", 0),
    ([{**scene_track, "x": True}], "tracks.items.x", 0),
    ([TRACKS[0], TRACKS[1][:8]], "tracks.items", 1),
    (np.zeros((3, 10)), "tracks.items", 0),
    (np.zeros(9), "tracks.items.id", 0),
    (np.array(TRACKS, dtype=BY_NAME)[["id", "x", "y"]], "tracks.items.cos", None),
    (7, "tracks.items", None),
    (None, "tracks.items", None),
    ("no list", "tracks.items.id", 0),
]


@pytest.mark.parametrize(("items", "field", "index"), BROKEN)
def test_data_that_cannot_be_read_are_refused_by_name(
    scene: Scene, items: Any, field: str, index: int | None
) -> None:
    monitor = scene.offloading()
    now = at(10)
    with pytest.raises(mufasa.InvalidInput) as error:
        monitor.tracks(now, station=1, session=1, generated=now, stamp=now, items=items)
    assert (error.value.field, error.value.index) == (field, index)
    assert field in str(error.value)
    scene.safe(monitor, 10)


def test_invalid_local_input_is_unsafe_and_named(scene: Scene) -> None:
    monitor = scene.offloading()
    scene.send(monitor, 10)
    broken = [*scene.parked, scene.parked[0]._replace(width=float("nan"))]
    decision = scene.decide(monitor, 10, detections=Detections(at(10), broken))
    assert not decision and decision.report is None and decision.error is not None
    assert (decision.error.field, decision.error.index) == ("detections.items.width", 1)
    assert monitor.configuration == "Local"


def test_invalid_remote_data_are_unsafe_and_named(scene: Scene) -> None:
    monitor = scene.offloading()
    scene.send(monitor, 10, tracks=[scene.tracks[0]._replace(vx=float("inf"))])
    decision = scene.decide(monitor, 10)
    assert decision.error is None and decision.report is not None
    assert decision.report.failed_stage == "input"
    assert decision.report.input == {"field": "tracks.items.vx", "index": 0}


def test_a_grid_map_is_seen(scene: Scene) -> None:
    """A cell under the CAV: row 10, column 12 of 0.5 m, from (-5, -5) on."""
    cells = np.zeros((20, 30), dtype=bool)

    def stage_v(cells: Any) -> Any:
        monitor = scene.offloading()
        scene.send(monitor, 10)
        occupied = np.packbits(cells, bitorder="little").tobytes()
        grid = GridMap(at(10), -5.0, -5.0, 1.0, 0.0, 0.5, 30, 20, occupied)
        report = scene.decide(monitor, 10, grid=grid).report
        assert report is not None
        return report.stages["v"]

    assert stage_v(cells) == {"outcome": "passed"}
    cells[10, 12] = True
    assert stage_v(cells)["witness"]["cell"] == [12, 10]


def test_a_grid_map_of_the_wrong_kind_is_named(scene: Scene) -> None:
    grid = GridMap(at(10), 0.0, 0.0, 1.0, 0.0, 0.5, 30, 20, bytes(75))
    kinds: dict[str, Any] = {"occupied": "no bytes", "width": 30.5, "resolution": None}
    for field, wrong in kinds.items():
        with pytest.raises(mufasa.UnreadableInputs) as error:
            scene.monitor().cycle(at(10), scene.ego, grid=grid._replace(**{field: wrong}))
        assert error.value.field == f"grid.{field}"
    short = scene.decide(scene.monitor(), 10, grid=grid._replace(occupied=bytes(74)))
    assert short.error is not None and short.error.field == "grid.occupied"


def test_the_requester_can_be_looked_at(scene: Scene) -> None:
    monitor = scene.offloading()
    assert (monitor.source("mot"), monitor.hold_until) == (0, None), "local until used (H-08)"
    scene.safe(monitor, 10)
    assert (monitor.source("mot"), monitor.sessions) == (1, 2)
    assert monitor.session_of("plan") == mufasa.Session(station=1, session=2)
    scene.send(monitor, 20, tracks=[])
    assert scene.decide(monitor, 20).safe, "an empty list is a list (I-11)"
    list(monitor.lost(at(30), 1))
    assert monitor.session_of("plan") is None and monitor.configuration == "Local"


def test_numpy_is_not_needed() -> None:
    code = """
import runpy, sys
sys.modules["numpy"] = None
runpy.run_path(sys.argv[1], run_name="__main__")
"""
    example = ROOT / "lab/python/examples/vehicle.py"
    subprocess.run([sys.executable, "-c", code, str(example)], check=True, timeout=60)
