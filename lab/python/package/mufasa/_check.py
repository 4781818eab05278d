"""Checks of records."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

from . import _native
from ._types import Profile, Record
from ._verdict import Verdict


def check(record: Record | str, profile: Profile | None = None) -> Verdict:
    """Checks one cycle (``spec/5-interfaces.md#cycle``) with the implementation.

    ``record``: the line, or what it holds: mappings, dataclasses, named tuples, lists; numbers that
    JSON cannot write are taken as they are. ``profile``: instead of the record's.

    Raises ``InvalidInput`` where the answer would be an error: what is no record, and invalid local
    input. Remote data that are invalid make the cycle unsafe.
    """
    text = record if isinstance(record, str) else json.dumps(_plain(record))
    return replace(_native.check(text, profile), _checked=(text, profile))


def _plain(value: Any) -> Any:
    """The value as JSON can write it."""
    if isinstance(value, float) and not math.isfinite(value):
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, Mapping):
        return {key: _plain(it) for key, it in value.items()}
    if is_dataclass(value) and not isinstance(value, type):
        return {it.name: _plain(getattr(value, it.name)) for it in fields(value)}
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        return _plain(value._asdict())
    if isinstance(value, (list, tuple)):
        return [_plain(it) for it in value]
    if hasattr(value, "tolist"):
        return _plain(value.tolist())
    return value
