"""The sequences of ``vectors/monitor`` through ``Monitor``: everything of a state that it shows.

It shows neither that a group is requested nor ``given_back_ns``, and has no memory of a size and no period between
microseconds: sequences with these are left out, and counted."""

from __future__ import annotations

import json
import subprocess
from collections import Counter
from datetime import timedelta
from pathlib import Path
from typing import Any, Optional

import mufasa
import pytest
from conftest import ROOT
from mufasa import Detections, Gap, Lead, Monitor, Time, Tracks, Trajectory
from test_check import program
from test_monitor import grid_map, ns

MEMORY = {"tracks": 1024, "detections": 2048, "cross_sections": 8192}
REASONS = {
    "too_long": "does_not_fit",
    "too_old": "stale",
    "from_the_future": "late",
    "after_silence": "late",
    # Of one that is not newer Python does not say whether it is older.
    "not_newer": "repeated",
    "older": "repeated",
}


def left_out(record: dict[str, Any]) -> str | None:
    """What of a sequence cannot be said in Python."""
    if record["stall"] is not None and record["stall"]["time_ns"] % 1000:
        return "stall"
    if record["memory"] != MEMORY:
        return "memory"
    return "period" if record["period_ns"] % 1000 else None


def started(record: dict[str, Any]) -> Monitor:
    period = timedelta(microseconds=record["period_ns"] // 1000)
    # A record has the whole domain, and its own defaults of tau and dt_max.
    parameters = {"tau": 0.1, "dt_max_ns": 100_000_000} | record["parameters"]
    given = {"profile": record["profile"], "parameters": parameters, "meant": [*parameters, "period"]}
    given |= {"sessions_before": record["last_session"], "supervise_local": record["supervise_local"]}
    if (stall := record["stall"]) is not None:
        given["stall"] = (stall["way"], timedelta(microseconds=stall["time_ns"] // 1000))
    monitor = Monitor(period, **given)
    monitor.set_route(record["route"]["stations"], closed=record["route"]["closed"])
    return monitor


def action(it: mufasa.Action) -> tuple[Any, ...]:
    if isinstance(it, mufasa.Drop):
        return "drop", it.group, REASONS.get(it.why, it.why)
    return (type(it).__name__.lower(), *it)


def wanted_action(it: dict[str, Any], why: str | None) -> tuple[Any, ...]:
    if "send" in it:
        return it["send"], it["station"], it["group"], it["session"]
    [(kind, group)] = it.items()
    return (kind, group, REASONS.get(why or "", why)) if kind == "drop" else (kind, group)


def taken(monitor: Monitor, event: dict[str, Any]) -> tuple[Any, Any]:
    """The actions of an event, and the decision of a cycle."""
    kind, now = event["type"], ns(event["t_ns"])
    if kind in ("tracks", "trajectory"):
        data, list_name = event[kind], "items" if kind == "tracks" else "points"
        of = {key: event[key] for key in ("station", "session")}
        of |= {"generated": ns(event["generated_ns"]), "stamp": ns(data["stamp_ns"])}
        return getattr(monitor, kind)(now, **of, **{list_name: data[list_name]}), None
    if kind == "cycle":
        seen = event["measured"]
        given: dict[str, Any] = {}
        for name, key, make, items in (
            ("detections", "detections", Detections, "items"),
            ("local_tracks", "tracks", Tracks, "items"),
            ("local_trajectory", "trajectory", Trajectory, "points"),
        ):
            if seen.get(key) is not None:
                given[name] = make(ns(seen[key]["stamp_ns"]), seen[key][items])
        if (lead := seen.get("lead")) is not None:
            gap = Gap.between_bumpers(lead["gap"])
            given["lead"] = Lead(ns(lead["stamp_ns"]), gap, lead["speed"])
        if seen.get("grid") is not None:
            given["grid"] = grid_map(seen["grid"])
        decision = monitor.cycle(now, seen["ego"], **given)
        return decision.actions, decision
    words = [event[key] for key in ("station", "group", "groups", "session") if key in event]
    return getattr(monitor, kind)(now, *words), None


def decided(decision: mufasa.Decision) -> dict[str, Any]:
    error, safe, report = decision.error, decision.safe, decision.report
    shown: dict[str, Any] = {"verdict": "safe" if safe else "unsafe"}
    shown["failed_stage"] = None if report is None else report.failed_stage
    shown["error"] = {"field": error.field, "index": error.index} if error else None
    for key in ("tracks", "trajectory"):
        it = getattr(decision, key) if safe else None
        shown[key] = it and (it.stamp.nanoseconds, it.station)
    by = decision.trajectory and decision.trajectory.brake_by if safe else None
    brake = decision.brake
    shown["brake"] = brake and {
        "failed_stage": brake.failed_stage,
        "witness": brake.witness is not None,
        "input": brake.input,
        "missing": brake.missing,
    }
    return {**shown, "brake_by_ns": by and by.nanoseconds}


def wanted(decision: dict[str, Any]) -> dict[str, Any]:
    out = {
        key: decision[key] and (decision[key]["stamp_ns"], decision[key]["station"])
        for key in ("tracks", "trajectory")
    }
    keys = ("verdict", "failed_stage", "brake_by_ns")
    out |= {key: decision[key] for key in keys}
    brake = decision["brake"]
    if brake is not None:
        brake = {key: brake.get(key) for key in ("failed_stage", "witness", "input", "missing")}
        brake["witness"] = brake["witness"] is not None
    return {**out, "error": decision.get("error"), "brake": brake}


def play(monitor: Monitor, event: dict[str, Any], state: dict[str, Any]) -> None:
    actions, decision = taken(monitor, event)
    shown = None if decision is None else decided(decision)
    expected = state["decision"] and wanted(state["decision"])
    assert shown == expected
    found = [action(it) for it in actions]
    assert found == [wanted_action(it, state["dropped"]) for it in state["actions"]]
    hold = monitor.hold_until
    assert (hold and hold.nanoseconds) == state["hold_until_ns"]
    for group in ("mot", "plan"):
        session = monitor.session_of(group)
        remote = f"remote:{session.station}" if session else "local"
        assert remote == (state[group] if state[group].startswith("remote") else "local")


def numbers(value: Any) -> Any:
    """The value with what JSON has no number for as such."""
    if isinstance(value, dict):
        return {key: numbers(it) for key, it in value.items()}
    if isinstance(value, list):
        return [numbers(it) for it in value]
    return float(value) if value in ("nan", "inf", "-inf") else value


def played(name: str, record: dict[str, Any], expected: dict[str, Any]) -> Optional[int]:
    """How many events were played; ``None``: the settings are refused, as they should be."""
    if "error" in expected:
        with pytest.raises(mufasa.InvalidInput):
            started(record)
        return None
    monitor = started(record)
    for at, (event, state) in enumerate(zip(record["events"], expected["states"])):
        try:
            play(monitor, event, state)
        except AssertionError as error:
            raise AssertionError(f"{name}, event {at}: {error}") from error
    return len(record["events"])


def kept(states: list[dict[str, Any]]) -> int:
    """In how many cycles the tracks of the cycle before came out again: a newer list was late or lost."""
    stamps = [
        tracks and tracks["stamp_ns"]
        for state in states
        if (decision := state["decision"])
        for tracks in [decision["tracks"]]
    ]
    return sum(a is not None and a == b for a, b in zip(stamps, stamps[1:]))


def test_every_sequence_is_answered_as_its_vector_says() -> None:
    count: Counter[str] = Counter()
    for file in sorted((ROOT / "vectors/monitor").glob("*.jsonl")):
        for vector in map(json.loads, file.read_text().splitlines()):
            record = numbers(vector["input"])
            if (why := left_out(record)) is not None:
                count[f"left out: {why}"] += 1
                continue
            events = played(vector["id"], record, vector["expect"])
            count["refused" if events is None else "played"] += 1
            decisions = [it["decision"] for it in vector["expect"].get("states", [])]
            count["brakes"] += sum(bool(it and it["brake"]) for it in decisions)
            count["events"] += events or 0
    print(dict(count))
    assert count["played"] >= 120 and count["refused"] >= 10 and count["brakes"] >= 10, count


def test_random_sequences_are_answered_as_the_model_does(tmp_path: Path) -> None:
    """Those that ``mufasa conform`` asks, with the memory of Python."""
    asked = tmp_path / "asked.jsonl"
    kind = ["--kinds", "monitor", "--cases", "150", "--no-vectors"]
    command = [str(program()), "conform", "-q", *kind]
    asks = ["sh", "-c", f"tee '{asked}' | '{program()}' oracle"]
    subprocess.run([*command, "--out", str(tmp_path), "--", *asks], stdout=-3, check=True)
    records = [json.loads(line) for line in asked.read_text().splitlines()]
    records = [{**it, "memory": MEMORY} for it in records]
    lines = "".join(json.dumps(it) + "\n" for it in records)
    model = subprocess.run([program(), "oracle"], input=lines, stdout=-1, text=True, check=True)
    count: Counter[str] = Counter()
    for record, line in zip(records, model.stdout.splitlines()):
        if (why := left_out(record)) is not None:
            count[f"left out: {why}"] += 1
            continue
        expected = json.loads(line)
        events = played(line, numbers(record), expected)
        count["refused" if events is None else "played"] += 1
        count["events"] += events or 0
        count["tracks of two cycles"] += kept(expected.get("states", []))
    print(dict(count))
    assert count["played"] >= 100 and count["events"] >= 10_000, count
    assert count["tracks of two cycles"] >= 20, count
