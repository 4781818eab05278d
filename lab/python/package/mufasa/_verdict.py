"""What became of a cycle."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypedDict

Stage = Literal["i", "ii", "iii", "iv", "v"]
FailedStage = Literal["input", "i", "ii", "iii", "iv", "v", "no_obstacle_check"]


class _Outcome(TypedDict):
    outcome: Literal["passed", "failed", "skipped", "not_applicable", "not_scheduled"]


class StageOutcome(_Outcome, total=False):
    """What became of a stage (``spec/5-interfaces.md#cycle``)."""

    witness: dict[str, Any]
    """Of failed: the rule, where, and the two numbers that were compared."""
    reason: str
    """Of skipped."""
    missing: str
    """Of not_applicable: the key of that input in the record."""


class InputProblem(TypedDict):
    """Where remote data are invalid."""

    field: str
    index: int | None


@dataclass(frozen=True)
class Verdict:
    """The answer of the implementation to one cycle. It is true when the cycle is safe, and only then."""

    id: str
    """Of the record; empty for a cycle of a monitor."""
    safe: bool
    failed_stage: FailedStage | None
    input: InputProblem | None
    """When the failed stage is ``input``."""
    stages: Mapping[Stage, StageOutcome]

    def __bool__(self) -> bool:
        return self.safe


def of_answer(line: str) -> Verdict:
    """The verdict of an answer as JSON."""
    answer = json.loads(line)
    return Verdict(
        id=answer["id"],
        safe=answer["verdict"] == "safe",
        failed_stage=answer["failed_stage"],
        input=answer.get("input"),
        stages=answer["stages"],
    )
