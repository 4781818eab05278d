"""Readers of drives."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Sequence
from pathlib import Path

import mufasa
import pytest
from conftest import ROOT

DEMO = [ROOT / "lab/drives/data/demo" / name for name in ("urban.xml", "urban.solution.xml")]
READERS = ROOT / "lab/drives/data/readers"


def test_a_solution_in_its_scenario_is_a_drive() -> None:
    [drive] = mufasa.read_drives(*DEMO)
    assert isinstance(drive, Sequence) and len(drive) == 188
    assert drive.name == "urban.solution" and str(DEMO[1]) in drive.source and drive.notes
    first = drive[0]
    assert (first["kind"], first["id"]) == ("cycle", "urban.solution#0")
    assert (first["profile"], first["configuration"]) == ("hardened", "AllRemote")
    times = [record["now_ns"] for record in drive]
    assert times == sorted(times) and len(set(times)) == 188


def test_a_drive_is_a_sequence_that_makes_its_records() -> None:
    [drive] = mufasa.read_drives(*DEMO)
    assert drive[-1] == drive[187] == drive[187:][0] and drive[187] is not drive[187]
    assert [it["id"] for it in drive[3:9:3]] == ["urban.solution#3", "urban.solution#6"]
    assert [json.loads(line) for line in drive.lines()] == list(drive)
    for outside in (188, -189):
        with pytest.raises(IndexError):
            drive[outside]
    with pytest.raises(TypeError):
        drive["0"]  # type: ignore[call-overload]


def test_the_records_are_not_kept() -> None:
    """Of 188 records of about 60 kB one at a time is in Python's memory."""
    [drive] = mufasa.read_drives(*DEMO)
    one = len(json.dumps(drive[0]))
    tracemalloc.start()
    count = sum(1 for _ in drive)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.reset_peak()
    kept = list(drive)
    _, peak_of_all = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert count == len(kept) == 188
    assert peak < 20 * one < peak_of_all


def test_options_say_what_a_recording_does_not() -> None:
    [drive] = mufasa.read_drives(
        *DEMO, profile="paper", configuration="MotRemote", horizon_s=2.0, keep_tail=True
    )
    assert (drive[0]["profile"], drive[0]["configuration"]) == ("paper", "MotRemote")
    assert len(drive[0]["trajectory"]["points"]) == 21 and len(drive) > 188
    [other] = mufasa.read_drives(*DEMO, seed=2)
    [usual] = mufasa.read_drives(*DEMO)
    assert other[0]["detections"] != usual[0]["detections"]
    [recorded] = mufasa.read_drives(DEMO[0])
    assert recorded.name == "urban" and any("CAV" in note for note in recorded.notes)
    for wrong in ({"profile": "lax"}, {"configuration": "Remote"}):
        with pytest.raises(mufasa.InvalidInput) as error:
            mufasa.read_drives(*DEMO, **wrong)  # type: ignore[arg-type]
        assert error.value.field in wrong


def test_every_safe_cycle_of_the_demo_is_safe() -> None:
    [drive] = mufasa.read_drives(*DEMO)
    assert all(mufasa.check(line) for line in drive.lines())
    assert not all(map(mufasa.check, drive.attacked("empty-tracks@2..")))


@pytest.mark.parametrize("attack", ["empty", "empty-tracks@900..", "empty-tracks@2..1", ""])
def test_an_attack_that_is_none_is_refused(attack: str) -> None:
    [drive] = mufasa.read_drives(*DEMO)
    with pytest.raises(mufasa.InvalidInput) as error:
        drive.attacked(attack)
    assert error.value.field == "attack"


def test_records_as_lines_are_a_drive(tmp_path: Path) -> None:
    [drive] = mufasa.read_drives(*DEMO)
    path = tmp_path / "cycles.jsonl"
    path.write_text("".join(line + "\n" for line in drive.lines()))
    [again] = mufasa.read_drives(path, profile="paper")
    assert list(again) == list(drive), "options do not touch records"


def test_several_files_are_several_drives() -> None:
    drives = mufasa.read_drives(*DEMO, DEMO[0])
    assert [drive.name for drive in drives] == ["urban.solution", "urban"]
    assert mufasa.read_drives() == []


def test_a_file_that_gives_no_drive_says_where(tmp_path: Path) -> None:
    with pytest.raises(mufasa.ReadError) as error:
        mufasa.read_drives(tmp_path / "none.xml")
    assert error.value.file == str(tmp_path / "none.xml") and error.value.line is None
    broken = tmp_path / "broken.xml"
    broken.write_text(DEMO[0].read_text().replace("<x>", "<x>wide", 1))
    with pytest.raises(mufasa.ReadError) as error:
        mufasa.read_drives(broken)
    assert error.value.line is not None and error.value.element.startswith("commonRoad/")
    assert error.value.element.endswith("/x") and "wide" in error.value.message
    assert str(error.value).startswith(f"{broken}:{error.value.line}: ")
    with pytest.raises(mufasa.ReadError, match="its scenario"):
        mufasa.read_drives(DEMO[1])


def test_the_small_files_of_the_readers_are_read_or_refused_by_name() -> None:
    [drive] = mufasa.read_drives(READERS / "small-2020a.xml", keep_tail=True)
    assert len(drive) > 0 and mufasa.check(drive[0]).stages
