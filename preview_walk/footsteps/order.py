"""What may follow a footstep in a plan: later in time, by the other foot or after a stand."""

from __future__ import annotations

from preview_walk.errors import InvalidInput
from preview_walk.footsteps.footstep import Footstep
from preview_walk.types import other


def is_stand(pause: float, weight_shift: float) -> bool:
    """Return whether the ZMP comes to rest between the feet in a double support.

    Args:
        pause: duration of the double support, s.
        weight_shift: time in which the ZMP goes between one foot and midfeet, s.
    """
    return pause >= 2.0 * weight_shift - 1e-9


def check_order(before: Footstep, step: Footstep, number: int, weight_shift: float) -> None:
    """Do nothing if a step may follow the footstep before it.

    Args:
        before: a step, or for the first step the stance.
        step: the step after it.
        number: of that step, from 1.
        weight_shift: of the plan, s.

    Raises:
        InvalidInput: it may not.
    """
    if step.type != "swing_end":
        raise InvalidInput(
            f"step {number} must be of type 'swing_end', got {step.type!r}.", argument="steps"
        )
    if step.lift <= before.land:
        since = f"step {number - 1} lands" if number > 1 else "the plan starts"
        raise InvalidInput(
            f"step {number} must lift after {since} at {before.land:.3f} s, "
            f"got a lift at {step.lift:.3f} s.",
            argument="steps",
        )
    pause = step.lift - before.land
    free = number == 1 or step.again or is_stand(pause, weight_shift)
    if step.foot == before.foot and not free:
        raise InvalidInput(
            f"step {number} must be taken by the {other(step.foot)} foot, because step "
            f"{number - 1} was taken by the {step.foot} foot {pause:.3f} s before "
            f"(a foot may go twice after a stand of {2 * weight_shift:.3f} s).",
            argument="steps",
        )
