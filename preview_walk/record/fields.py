"""What a record holds at every tick: the one table of names, shapes, units and meanings."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.types import Array


@dataclass(frozen=True)
class FieldInfo:
    """One array of a record.

    Attributes:
        shape: of a tick's value: numbers, or the names nq, nv, nu of sizes that depend on the
            robot.
        unit: of its values.
        doc: its meaning.
        dtype: type of its numbers.
        timing: whether a stopwatch measured it, the only thing in which two runs of the same walk
            differ.
    """

    shape: tuple[int | str, ...]
    unit: str
    doc: str
    dtype: type[np.generic] = np.float64
    timing: bool = False


def field_info(
    *shape: int | str,
    unit: str,
    doc: str,
    dtype: type[np.generic] = np.float64,
    timing: bool = False,
) -> Any:
    """Return a field of a dataclass of arrays, with what is to be known of it; see `FieldInfo`."""
    return field(metadata={"info": FieldInfo(shape, unit, doc, dtype, timing)})


_WRENCH = "ground on {} foot: [force; moment about the sole origin], world axes"


@dataclass(frozen=True, eq=False, kw_only=True)
class Ticks:
    """The arrays of a run, first axis time: row i is the state at `time[i]` and what it led to.

    `q`, `v` and the forces are what the plant measures. `com`, `com_velocity`, `dcm`, the soles'
    poses and `torso_tilt` follow from `q` and `v` by the robot's own model, as the controller has
    them: where the physics carries something that the model does not know of, a payload say, the
    CoM of the bodies is elsewhere. Where the robot has real sensors, they follow from the estimate
    instead (`Record.sensed`). What ends in `_ref` is what the plan asked for at the same tick.
    World frame: z up. A sole frame has its origin at the centre of the sole, x towards
    the toes, z up. Floats that a run did not write are nan, integers -1.
    """

    time: Array = field_info(unit="s", doc="simulated time at the start of the tick")
    q: Array = field_info(
        "nq", unit="m, 1, rad", doc="configuration: base position, quaternion xyzw, joint angles"
    )
    v: Array = field_info(
        "nv", unit="m/s, rad/s", doc="velocity: base linear and angular in base axes, joint rates"
    )
    tau: Array = field_info("nu", unit="N·m", doc="joint torques sent, in the order of v[6:]")

    com: Array = field_info(
        3, unit="m", doc="centre of mass (CoM) of the robot's model at q, world"
    )
    com_ref: Array = field_info(3, unit="m", doc="CoM reference")
    com_velocity: Array = field_info(3, unit="m/s", doc="its velocity, of the model at q and v")
    com_velocity_ref: Array = field_info(3, unit="m/s", doc="CoM velocity reference")
    com_acceleration_ref: Array = field_info(3, unit="m/s²", doc="CoM acceleration reference")
    dcm: Array = field_info(
        2, unit="m", doc="divergent component of motion, com + velocity / omega"
    )
    dcm_ref: Array = field_info(2, unit="m", doc="DCM of the references")
    zmp: Array = field_info(
        2, unit="m", doc="zero-moment point of the contact forces; nan in flight"
    )
    zmp_ref: Array = field_info(2, unit="m", doc="ZMP that the plan asks for")
    zmp_preview: Array = field_info(2, unit="m", doc="ZMP of the CoM reference")

    left_foot: Array = field_info(4, 4, unit="m", doc="pose of the left sole frame in the world")
    right_foot: Array = field_info(4, 4, unit="m", doc="pose of the right sole frame in the world")
    left_foot_ref: Array = field_info(4, 4, unit="m", doc="planned pose of the left sole")
    right_foot_ref: Array = field_info(4, 4, unit="m", doc="planned pose of the right sole")
    left_force: Array = field_info(6, unit="N, N·m", doc=_WRENCH.format("left"))
    right_force: Array = field_info(6, unit="N, N·m", doc=_WRENCH.format("right"))
    left_force_ref: Array = field_info(6, unit="N, N·m", doc="the same as the QP planned it")
    right_force_ref: Array = field_info(6, unit="N, N·m", doc="the same as the QP planned it")
    push: Array = field_info(3, unit="N", doc="force of the pushes, world axes")
    torso_tilt: Array = field_info(
        unit="rad", doc="angle between the torso's z axis and the vertical"
    )

    phase: NDArray[np.int8] = field_info(
        unit="1",
        dtype=np.int8,
        doc="support measured: 0 double, 1 left, 2 right, -1 no contact",
    )
    phase_ref: NDArray[np.int8] = field_info(
        unit="1", dtype=np.int8, doc="support planned: 0 double, 1 left, 2 right"
    )

    qp_iterations: NDArray[np.int32] = field_info(
        unit="1", dtype=np.int32, doc="iterations of the tick's QP"
    )
    qp_status: NDArray[np.int8] = field_info(
        unit="1",
        dtype=np.int8,
        doc="0 solved, 1 fell back to the last solution, 2 fell back to the damped posture",
    )
    qp_solver: NDArray[np.int8] = field_info(
        unit="1",
        dtype=np.int8,
        doc="who solved the QP: 0 the run's solver, 1 the exact method that finishes for it",
    )
    tick_time: Array = field_info(unit="s", timing=True, doc="wall time of the whole control tick")
    terms_time: Array = field_info(unit="s", timing=True, doc="wall time of the model's terms")
    assembly_time: Array = field_info(unit="s", timing=True, doc="wall time of the QP's assembly")
    qp_time: Array = field_info(unit="s", timing=True, doc="wall time of the QP's solution")


FIELDS: dict[str, FieldInfo] = {f.name: f.metadata["info"] for f in fields(Ticks)}
"""Every array of a record by name, in the order in which `record.npz` holds them."""


def field_table() -> str:
    """Return the table of all fields as text: name, shape, unit, meaning."""
    lines = []
    for name, info in FIELDS.items():
        shape = ", ".join(["N", *map(str, info.shape)]) + ("," if not info.shape else "")
        lines.append(f"{name:22}({shape})".ljust(36) + f"{info.unit:12}{info.doc}")
    return "\n".join(lines)
