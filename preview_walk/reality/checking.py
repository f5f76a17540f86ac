"""Values made of numbers from zero on: checked when they are made."""

from __future__ import annotations

from dataclasses import fields

from preview_walk.arguments import number_from_zero, real_array, shown
from preview_walk.errors import InvalidInput


class Checked:
    """A frozen dataclass whose numbers are all finite and not negative."""

    def __post_init__(self) -> None:
        """Check every number, and every pair of numbers, and take them as plain ones."""
        for each in fields(self):  # type: ignore[arg-type]
            value = getattr(self, each.name)
            if each.type in ("float", "int"):
                number = number_from_zero(value, each.name, "")
                object.__setattr__(self, each.name, int(number) if each.type == "int" else number)
            elif each.type == "tuple[float, float] | None" and value is not None:
                pair = real_array(value, each.name, "two numbers")
                if pair.shape != (2,) or not 0.0 < pair[0] <= pair[1]:
                    raise InvalidInput(
                        f"{each.name} must be two numbers, 0 < least <= most, got {shown(value)}.",
                        each.name,
                    )
                object.__setattr__(self, each.name, (float(pair[0]), float(pair[1])))
