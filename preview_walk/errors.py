"""The errors that `preview_walk` raises on purpose; each message is one sentence."""

from __future__ import annotations


class PreviewWalkError(Exception):
    """Base of every error raised by this package."""


class InvalidInput(PreviewWalkError, ValueError):
    """An argument that cannot be: says what was expected, what came and what is allowed."""


class RobotError(InvalidInput):
    """A robot file or description that cannot walk; names the offending body, joint or frame."""
