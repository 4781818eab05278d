"""What became of a cycle."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, TypedDict

from . import _native

if TYPE_CHECKING:
    from ._types import Profile

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
    _checked: tuple[str, Profile | None] | None = field(default=None, repr=False, compare=False)

    def __bool__(self) -> bool:
        return self.safe

    def to_svg(self) -> str:
        """A picture of the cycle from above, with what failed in a strong colour.

        Raises ``ValueError`` for a verdict of a monitor, which does not keep its inputs."""
        if self._checked is None:
            raise ValueError("only what check() decided has a picture; a monitor keeps no inputs")
        return _native.svg(*self._checked)

    def _repr_svg_(self) -> str | None:
        return None if self._checked is None else self.to_svg()


@dataclass(frozen=True)
class Brake:
    """Why control has to brake: one of these is given."""

    failed_stage: FailedStage | None = None
    """Where the CAV's own plan fails."""
    witness: dict[str, Any] | None = None
    """The numbers that were compared there; None where nothing compared the plan with obstacles."""
    input: InputProblem | None = None
    """What is invalid."""
    missing: Literal["trajectory"] | None = None
    """The CAV has no current plan of its own."""


def brake_of(line: str) -> Brake:
    """The reason of a decision as JSON."""
    return Brake(**json.loads(line))


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
