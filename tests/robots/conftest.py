"""The walking lab's robot, as it is and to be changed."""

import mujoco
import pytest

from preview_walk.robots.load import load_robot
from preview_walk.robots.reading.description import models_folder


@pytest.fixture
def spec():
    """Return the walker as MuJoCo's editable model, one's own to change."""
    return mujoco.MjSpec.from_file(str(models_folder() / "humanoid-walker.xml"))


@pytest.fixture(scope="session")
def original():
    return load_robot("humanoid-walker")
