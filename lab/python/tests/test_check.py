"""``check`` gives the answers of the program ``mufasa``, and refuses what it refuses."""

from __future__ import annotations

import json
import os
import subprocess
from dataclasses import make_dataclass
from functools import cache
from pathlib import Path
from typing import Any

import mufasa
import numpy as np
import pytest
from conftest import ROOT
from mufasa import TrajectoryPoint


@cache
def vectors() -> list[dict[str, Any]]:
    """Those of cycles; a line that is no record has no kind."""
    lines = [
        json.loads(line)
        for path in sorted((ROOT / "vectors").rglob("*.jsonl"))
        for line in path.read_text().splitlines()
    ]
    found = [
        it
        for it in lines
        if isinstance(it["input"], str) or it["input"].get("kind") not in ("offloading", "composition", "monitor")
    ]
    assert len(found) > 1300
    return found


def program() -> Path:
    """The program ``mufasa``; ``MUFASA`` says where it is."""
    places = [ROOT / "target" / profile / "mufasa" for profile in ("release", "debug")]
    if "MUFASA" in os.environ:
        places = [Path(os.environ["MUFASA"])]
    found = [place for place in places if place.exists()]
    if not found:
        pytest.fail("the program is missing: cargo build --release -p mufasa-oracle")
    return found[0]


def answer(record: Any) -> dict[str, Any]:
    """What ``check`` says, as the program would."""
    try:
        found = mufasa.check(record)
    except mufasa.InvalidInput as error:
        place = {"field": error.field, "index": error.index, "message": error.message}
        return {"verdict": "error", "failed_stage": None, "error": place}
    told: dict[str, Any] = {
        "id": found.id,
        "verdict": "safe" if found else "unsafe",
        "failed_stage": found.failed_stage,
        "stages": dict(found.stages),
    }
    return told if found.input is None else {**told, "input": found.input}


def test_every_vector_is_answered_as_the_program_does() -> None:
    lines = [
        it["input"] if isinstance(it["input"], str) else json.dumps(it["input"]) for it in vectors()
    ]
    # A line with a newline in it would be two.
    assert not any("\n" in line for line in lines)
    told = subprocess.run(
        [program(), "oracle", "--implementation"],
        input="".join(line + "\n" for line in lines),
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=True,
        timeout=300,
    )
    answers = [json.loads(line) for line in told.stdout.splitlines()]
    assert len(answers) == len(lines)
    ends = {"safe": 0, "unsafe": 0, "error": 0}
    for vector, line, expected in zip(vectors(), lines, answers):
        if expected["verdict"] == "error":
            expected.pop("id")
            number = expected["error"].pop("line")
            message = expected["error"]["message"]
            expected["error"]["message"] = message.removeprefix(f"line {number}: ")
        assert answer(line) == expected, vector["id"]
        if not isinstance(vector["input"], str):
            assert answer(vector["input"]) == expected, f"{vector['id']} as a dict"
        ends[expected["verdict"]] += 1
    assert all(count >= 50 for count in ends.values()), ends


def test_every_vector_is_decided_as_it_says() -> None:
    count = 0
    for vector in vectors():
        if "may answer otherwise" in vector["note"]:
            continue
        found, expected = answer(vector["input"]), vector["expect"]
        for key in ("verdict", "failed_stage"):
            assert found[key] == expected[key], vector["id"]
        count += 1
    assert count > 1200


def record() -> dict[str, Any]:
    """A safe cycle."""
    found = next(
        it["input"]
        for it in vectors()
        if it["expect"]["verdict"] == "safe"
        and (it["input"]["profile"], it["input"]["configuration"]) == ("paper", "AllRemote")
        and it["input"].get("trajectory")
        and it["input"].get("tracks")
        and it["input"]["tracks"]["items"]
    )
    copied: dict[str, Any] = json.loads(json.dumps(found))
    return copied


def test_a_verdict_is_true_when_the_cycle_is_safe_and_only_then() -> None:
    safe = mufasa.check(record())
    assert safe and safe.safe and safe.failed_stage is None
    away = record()
    away["ego"]["x"] += 1000.0
    assert mufasa.check(away, "hardened").safe is False
    assert not mufasa.check(away, "hardened")


def test_the_profile_can_be_another_one() -> None:
    found = next(
        it["input"] for it in vectors() if it["requirement"].startswith("H-07.") and not isinstance(it["input"], str)
    )
    verdicts = {"paper": mufasa.check(found, "paper"), "hardened": mufasa.check(found, "hardened")}
    assert verdicts["paper"] != verdicts["hardened"]
    assert verdicts[found["profile"]] == mufasa.check(found)
    with pytest.raises(mufasa.InvalidInput) as error:
        mufasa.check(found, "lax")  # type: ignore[arg-type]
    assert error.value.field == "profile"


def test_what_a_record_holds_may_be_of_other_types() -> None:
    plain = record()
    other = record()
    own = make_dataclass("Own", list(plain["ego"]))
    other["ego"] = own(**{key: np.float64(it) for key, it in plain["ego"].items()})
    other["now_ns"] = np.int64(plain["now_ns"])
    points = [TrajectoryPoint(**it) for it in plain["trajectory"]["points"]]
    other["trajectory"] = {**plain["trajectory"], "points": tuple(points)}
    assert mufasa.check(other) == mufasa.check(plain) == mufasa.check(json.dumps(plain))


@pytest.mark.parametrize("number", [float("nan"), float("inf"), -float("inf")])
def test_numbers_that_json_cannot_write_name_field_and_index(number: float) -> None:
    broken = record()
    broken["ego"]["speed"] = number
    with pytest.raises(mufasa.InvalidInput) as error:
        mufasa.check(broken)
    assert (error.value.field, error.value.index) == ("ego.speed", None)
    broken = record()
    broken["route"]["stations"][1]["left"][0] = np.float64(number)
    with pytest.raises(mufasa.InvalidInput) as error:
        mufasa.check(broken)
    assert (error.value.field, error.value.index) == ("route.stations.left", 1)
    broken = record()
    broken["tracks"]["items"][-1]["vx"] = number
    verdict = mufasa.check(broken)
    index = len(broken["tracks"]["items"]) - 1
    assert verdict.failed_stage == "input"
    assert verdict.input == {"field": "tracks.items.vx", "index": index}


@pytest.mark.parametrize(
    ("broken", "field"),
    [
        ("{", ""),
        ("", ""),
        ("[]", ""),
        ({}, "kind"),
        ({"kind": "cycle"}, "id"),
        ({"kind": "composition", "id": "c", "services": [], "goal": "g"}, "kind"),
        ({**record(), "now_ns": 1.5}, "now_ns"),
        ({**record(), "now": 1}, "now"),
        ({**record(), "parameters": {"theta": 1}}, "parameters.theta"),
    ],
)
def test_what_is_no_record_of_a_cycle_is_refused_by_name(broken: Any, field: str) -> None:
    with pytest.raises(mufasa.InvalidInput) as error:
        mufasa.check(broken)
    assert (error.value.field, error.value.index) == (field, None)
    assert isinstance(error.value, (mufasa.MufasaError, ValueError)) and str(error.value)


def test_a_record_is_no_number() -> None:
    for wrong in (7, None, b"{}"):
        with pytest.raises((TypeError, mufasa.InvalidInput)):
            mufasa.check(wrong)  # type: ignore[arg-type]
