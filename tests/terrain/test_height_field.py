"""Height fields: planes by hand, MuJoCo's own surface, files that are and files that are none."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from matplotlib.image import imsave

from preview_walk.errors import InvalidInput
from preview_walk.simulation.ground_geoms import add_ground
from preview_walk.terrain.height_field import HeightField, height_field, rough


def test_a_plane_is_the_plane_itself() -> None:
    field = HeightField.of(lambda x, y: 0.1 * x - 0.2 * y + 0.3, (-1.0, 2.0), (-1.0, 1.0), 0.1)
    x, y = np.random.default_rng(0).uniform(-0.9, 0.9, (2, 100))
    assert field.height(x, y) == pytest.approx(0.1 * x - 0.2 * y + 0.3, abs=1e-12)
    normal = np.array((-0.1, 0.2, 1.0))
    assert field.normal(0.33, -0.21) == pytest.approx(normal / np.linalg.norm(normal), abs=1e-12)


def test_it_is_what_mujoco_makes_of_it() -> None:
    """Rays from above meet the ground at its height, in every cell of a random field."""
    random = np.random.default_rng(1)
    field = HeightField(random.uniform(-0.1, 0.2, (12, 7)), 0.1, -0.3, -0.2)
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=(5, 5, 1))
    add_ground(spec, field)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    hit, down = np.zeros(1, np.int32), np.array((0.0, 0.0, -1.0))
    for x, y in zip(random.uniform(-0.5, 1.0, 300), random.uniform(-0.4, 0.6, 300), strict=True):
        above = np.array((x, y, 1.0))
        distance = mujoco.mj_ray(model, data, above, down, None, 1, -1, hit)
        assert field.height(x, y) == pytest.approx(1.0 - distance, abs=1e-6)


def test_beside_it_is_the_floor() -> None:
    field = HeightField(np.zeros((3, 3)), 0.1, 0.0, 0.0)
    assert field.height([0.2, 0.21, -0.01], [0.1, 0.1, 0.1]) == pytest.approx((0.0, -1.0, -1.0))
    assert field.normal(5.0, 0.0) == pytest.approx((0.0, 0.0, 1.0))


def test_rough_ground_is_as_rough_as_asked_and_random_by_its_seed() -> None:
    field = rough(0.04, 0.1, length=20.0, seed=1)
    beyond = field.heights[60:]
    assert beyond.std() == pytest.approx(0.04, rel=0.1)
    assert (rough(0.04, 0.1, seed=1).heights == rough(0.04, 0.1, seed=1).heights).all()
    assert (rough(0.04, 0.1, seed=1).heights != rough(0.04, 0.1, seed=2).heights).mean() > 0.5
    slopes = np.diff(beyond, axis=0) / field.spacing
    assert slopes.std() == pytest.approx(0.04 / (np.sqrt(2.0) * 0.1), rel=0.15)


def test_files_of_all_kinds_are_read_alike(tmp_path: Path) -> None:
    """x goes down the rows of an array and to the right in a picture, y to the left."""
    heights = np.array([[0.0, 0.05, 0.1], [0.1, 0.15, 0.2]])
    np.save(tmp_path / "a.npy", heights)
    np.savetxt(tmp_path / "a.csv", heights, delimiter=",")
    np.savetxt(tmp_path / "a.txt", heights)
    imsave(tmp_path / "a.png", heights.T[::-1], cmap="gray", vmin=0.0, vmax=0.2)
    for name in ("a.npy", "a.csv", "a.txt", "a.png"):
        field = height_field(tmp_path / name, length=2.0, height=0.2)
        assert field.heights == pytest.approx(heights, abs=1e-3)
        assert (field.spacing, field.x, field.y) == (2.0, -1.0, -2.0)


@pytest.mark.parametrize("content", [b"", b"nonsense", b"1,2\n3,x\n", b"1,2,3\n", b"1,nan\n2,3\n"])
@pytest.mark.parametrize("name", ["f.csv", "f.npy", "f.png", "f.txt"])
def test_files_that_hold_no_heights(tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InvalidInput, match="height"):
        height_field(tmp_path / name)


@pytest.mark.parametrize(
    "values",
    [
        {"heights": np.zeros((1, 5))},
        {"heights": np.zeros(5)},
        {"heights": [[0.0, np.inf], [0.0, 0.0]]},
        {"heights": "hills"},
        {"heights": np.zeros((2, 2)), "spacing": 0.0},
        {"heights": np.zeros((2, 2)), "x": np.nan},
    ],
)
def test_fields_that_cannot_be(values: dict[str, object]) -> None:
    with pytest.raises(InvalidInput):
        HeightField(**values)  # type: ignore[arg-type]


def test_functions_that_cannot_be() -> None:
    for function in (None, lambda x, y: "high", lambda x, y: np.zeros(3)):
        with pytest.raises(InvalidInput):
            HeightField.of(function)  # type: ignore[arg-type]
    with pytest.raises(InvalidInput, match="x must go up"):
        HeightField.of(lambda x, y: x, x=(1.0, 0.0))
