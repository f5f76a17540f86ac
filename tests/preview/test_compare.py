"""One call, four laws, a table and a plot."""

from pathlib import Path

import control
import numpy as np
import pytest

from preview_walk.errors import InvalidInput
from preview_walk.preview.cart_table import cart_table
from preview_walk.preview.compare import LAWS, Comparison, compare
from preview_walk.preview.comparison_plot import plot_comparison
from preview_walk.preview.gains import preview_gains
from preview_walk.preview.limits import Limits
from preview_walk.preview.response import track
from preview_walk.preview.zmp_mpc import zmp_mpc
from preview_walk.types import Array


@pytest.fixture(scope="module")
def walk() -> Comparison:
    """The cart-table at 20 ms: the ZMP moves 0.1 m in 40 ms and may not pass 0.101 m."""
    design = preview_gains(cart_table(0.814, 0.02), 1.0, 0.0, 1e-6, 80)
    reference = np.interp(np.arange(250) * 0.02, [2.0, 2.04], [0.0, 0.1])
    return compare(design, reference, limits=Limits(y_min=-0.001, y_max=0.101))


def test_every_law_does_what_it_is_known_for(walk: Comparison) -> None:
    assert tuple(result.name for result in walk.results) == LAWS[:4]
    np.testing.assert_allclose(
        walk["preview"].run.u, track(walk.design, walk.reference).u, atol=1e-9
    )
    errors = {r.name: np.sqrt(np.mean(r.run.error**2)) for r in walk.results}
    assert errors["preview"] < 0.1 * errors["LQI"]
    # Only within limits the limits hold, and at little cost.
    assert walk["preview"].outside > 1e-4
    assert walk["MPC"].outside < 1e-6
    assert errors["MPC"] == pytest.approx(errors["preview"], rel=0.05)
    assert walk["MPC"].failures == 0


def box(x: float, y: float, length: float = 0.2) -> Array:
    half = length / 2
    corners = np.array([[-half, -0.05], [half, -0.05], [0.1, 0.05], [-0.1, 0.05]])
    return corners + np.array([x, y])


def test_five_laws_walk_within_support_polygons(tmp_path: Path) -> None:
    """Two cart-tables at 40 ms: three feet, each under the ZMP's reference, and soles askew."""
    plant = cart_table(0.8, 0.04)
    design = preview_gains(control.append(plant, plant), 1.0, 0.0, 1e-6, 40)
    feet = [(0.0, 0.0)] * 30 + [(0.1, 0.08)] * 20 + [(0.2, -0.08)] * 20 + [(0.3, 0.0)] * 30
    supports = [box(x, y, 0.16) for x, y in feet]
    walk = compare(design, feet, limits=Limits(polygons=supports))
    assert tuple(result.name for result in walk.results) == LAWS
    # The offline walk is the same law; it starts where the law in the comparison does.
    own = zmp_mpc(supports, 0.8, 0.04, com=(0.0, 0.0))
    np.testing.assert_allclose(walk["Wieber"].run.y, own.zmp, atol=1e-9)
    rms = {r.name: np.sqrt(np.mean(r.run.error**2)) for r in walk.results}
    jerk = {r.name: np.sqrt(np.mean(r.run.u**2)) for r in walk.results}
    assert walk["LQI"].outside > 0.1
    assert max(walk["MPC"].outside, walk["Wieber"].outside) < 1e-6
    assert walk["MPC"].failures == walk["Wieber"].failures == 0
    assert rms["MPC"] < 0.5 * rms["Wieber"]
    assert jerk["Wieber"] < 0.8 * jerk["MPC"]
    assert plot_comparison(walk, tmp_path / "laws.png").stat().st_size > 10_000


def test_only_integral_action_or_foresight_removes_a_constant_disturbance() -> None:
    system = ([[0.9]], [[0.1]], [[1.0]], [[0.0]])
    design = preview_gains(system, 1.0, 0.0, 0.1, 30, E=[0.05])
    runs = compare(design, np.ones(300), disturbance=np.ones(300), laws=("LQR", "LQI", "preview"))
    last = {result.name: abs(result.run.error[-1, 0]) for result in runs.results}
    assert last["LQI"] < 1e-9
    assert last["preview"] < 1e-9
    assert last["LQR"] > 0.01


def test_the_table_and_the_plot(walk: Comparison, tmp_path: Path) -> None:
    lines = str(walk).splitlines()
    assert [line.split()[0] for line in lines] == ["law", *LAWS[:4]]
    assert len({len(line) for line in lines}) == 1
    assert repr(walk) == "Comparison(LQR, LQI, preview, MPC: 250 samples)"
    assert plot_comparison(walk, tmp_path / "laws.png").stat().st_size > 10_000
    with pytest.raises(InvalidInput, match="ends in one of"):
        plot_comparison(walk, tmp_path / "laws.xyz")


def test_refusals(walk: Comparison) -> None:
    for call, argument in (
        (lambda: compare(walk.design, np.zeros((3, 2))), "reference"),
        (lambda: compare(walk.design, [0.0], laws=("PID",)), "laws"),
        (lambda: compare(walk.design, [0.0], disturbance=[1.0]), "disturbance"),
        (lambda: compare(walk.design, [0.0], x0="rest"), "x0"),
        (lambda: compare(walk.design, [0.0], limits=Limits(y_max=np.ones(7))), "y_max"),
        (lambda: walk["PID"], "name"),
        (lambda: plot_comparison("laws", "laws.png"), "comparison"),
    ):
        with pytest.raises(InvalidInput) as caught:
            call()
        assert caught.value.argument == argument
