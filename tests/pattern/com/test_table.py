"""The names of the CoM generators."""

import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.pattern.com.table import COM_GENERATORS, com_generator


@pytest.mark.parametrize("name", COM_GENERATORS)
def test_every_generator_starts_at_rest_where_it_is_put(name: str) -> None:
    com = np.array((0.3, -0.1))
    state = com_generator(name, 0.9).rejoin(com, com, com)
    assert (state.com == com).all()
    assert (state.array[1:4] == 0.0).all()
    assert state.zmp == pytest.approx(com)


@pytest.mark.parametrize("name", ["lqr", "", None, 3, ["dcm"]])
def test_another_name_is_refused_with_those_allowed(name: object) -> None:
    with pytest.raises(InvalidInput, match="must be one of preview, mpc, dcm") as caught:
        com_generator(name, 0.9)  # type: ignore[arg-type]
    assert caught.value.argument == "com_generator"
