"""What can go wrong. Every error says what is wrong and what would be right."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._native import Actions


class MufasaError(Exception):
    """Any error that this package raises, but ``TypeError``, ``AttributeError`` and ``IndexError``."""


class InvalidInput(MufasaError, ValueError):
    """A value that is missing, of the wrong kind, or outside its domain."""

    field: str
    """Dotted path without indices, such as ``tracks.items.vx``; empty for a whole record."""
    index: int | None
    """Index in the innermost list, if the value is in one."""
    message: str
    """What is wrong and what would be right."""

    def __init__(self, field: str, index: int | None, message: str) -> None:
        item = "" if index is None else f", item {index}"
        super().__init__(message if message.startswith(field) else f"{field}{item}: {message}")
        self.field = field
        self.index = index
        self.message = message


class UnreadableInputs(InvalidInput):
    """What a cycle was given cannot be read. The monitor has fallen back as after an unsafe cycle."""

    actions: Actions
    """Releases to be sent, and local services that start."""

    def __init__(self, field: str, index: int | None, message: str, actions: Actions) -> None:
        super().__init__(field, index, message)
        self.actions = actions


class ReadError(MufasaError):
    """A file that gives no drive: the place as precisely as it is known."""

    file: str
    line: int | None
    """From 1; None for binary files and for errors of the whole file."""
    element: str
    """Path of tag names with ids, such as ``commonRoad/lanelet[12]/leftBound``."""
    field: str
    """Within the element; empty when the element itself is meant."""
    index: int | None
    """Within a list (points, states, rows), from 0."""
    message: str
    """What is wrong and what would be right."""

    def __init__(
        self,
        text: str,
        file: str,
        line: int | None,
        element: str,
        field: str,
        index: int | None,
        message: str,
    ) -> None:
        super().__init__(text)
        self.file = file
        self.line = line
        self.element = element
        self.field = field
        self.index = index
        self.message = message


class ActionsNotTaken(MufasaError, RuntimeError):
    """The actions of an earlier call were not looked at: a fallback would be lost."""

    actions: Actions
    """These; the monitor goes on when they have been iterated over or indexed."""

    def __init__(self, actions: Actions) -> None:
        super().__init__(f"{actions!r} of an earlier call were not taken: iterate over them first")
        self.actions = actions


class NotVerified(MufasaError, RuntimeError):
    """Data were asked for that no safe cycle covers now."""


class UnsafeCycle(NotVerified):
    """The cycle was unsafe: nothing of it may reach control."""


class Expired(NotVerified):
    """The monitor has taken an event or another cycle since."""


class OtherMonitor(NotVerified):
    """The data were verified by another monitor."""
