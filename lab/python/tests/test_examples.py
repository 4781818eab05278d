"""The examples run, and end as they say."""

from __future__ import annotations

import subprocess
import sys

import pytest
from conftest import ROOT

ENDS = {
    "vehicle.py": [
        " 4.0 s: unsafe: stage i, back to the local services",
        "400 points driven, one fallback, offloading again",
    ],
    "commonroad.py": [
        "as recorded, hardened: 188 safe",
        "under attack, paper: 188 safe",
        "under attack, hardened: 170 safe, 18 stage iv",
        "route.stations.x, item 1: not a finite number; give a finite one",
        "from cycle 0 Local; from cycle 6 AllRemote; from cycle 147 Local; from cycle 178 AllRemote",
    ],
}


@pytest.mark.parametrize("name", ENDS)
def test_the_example_ends_as_it_says(name: str) -> None:
    example = ROOT / "lab/python/examples" / name
    run = subprocess.run(
        [sys.executable, str(example)], capture_output=True, text=True, check=True, timeout=120
    )
    lines = run.stdout.splitlines()
    for line in ENDS[name]:
        assert line in lines


def test_there_are_no_other_examples() -> None:
    assert {path.name for path in (ROOT / "lab/python/examples").glob("*.py")} == set(ENDS)
