"""A record as a table: one column a number, one row a tick; and as labelled arrays."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from preview_walk.arguments import shown
from preview_walk.errors import InvalidInput
from preview_walk.extras import require
from preview_walk.geometry.quaternions import quaternions_of
from preview_walk.record.fields import FIELDS, FieldInfo
from preview_walk.record.sensed import SENSED

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

PREFIX = "sensed_"
"""With which the names of what was sensed begin."""

INFOS: dict[str, FieldInfo] = {
    **FIELDS,
    **{PREFIX + name: info for name, info in SENSED.items()},
}
"""Every array that a record may have."""

_PLACE, _TURN = ("x", "y", "z"), ("qx", "qy", "qz", "qw")
_LABELS: dict[object, tuple[str, ...]] = {
    2: _PLACE[:2],
    3: _PLACE,
    6: ("fx", "fy", "fz", "mx", "my", "mz"),
    9: tuple(f"{kind}{axis}" for kind in ("turn_", "v", "p") for axis in _PLACE),
}


def labels_of(info: FieldInfo, width: int, joints: Sequence[str]) -> tuple[str, ...]:
    """Return how the numbers of a field's row are called.

    Args:
        info: of the field.
        width: how many there are.
        joints: names of the joints, in the order of the torques.
    """
    names = list(joints) or [f"joint_{k}" for k in range(width)]
    base = {"nq": (*_PLACE, *_TURN), "nv": ("vx", "vy", "vz", "wx", "wy", "wz"), "nu": ()}
    size = info.shape[0]
    if size in base:
        first = tuple(f"base_{name}" for name in base[size])
        return (*first, *names)[:width]
    return _LABELS[size]


def frame_of(
    arrays: Mapping[str, NDArray[Any]], joints: Sequence[str], fields: Sequence[str] | None
) -> pd.DataFrame:
    """Return arrays as a table over `time`; see `Record.to_dataframe`."""
    require("a record as a table", "export", "pandas")
    import pandas as pd

    columns = dict(_columns(arrays, joints, _chosen(arrays, fields)))
    table = pd.DataFrame(columns, index=pd.Index(arrays["time"], name="time"))
    table.attrs["units"] = {name: INFOS[name].unit for name in _chosen(arrays, fields)}
    return table


def dataset_of(
    arrays: Mapping[str, NDArray[Any]], joints: Sequence[str], facts: Mapping[str, Any]
) -> xr.Dataset:
    """Return arrays with named axes; see `Record.to_xarray`."""
    require("a record as labelled arrays", "export", "xarray")
    import xarray as xr

    found = {}
    for name, array in arrays.items():
        info = INFOS[name]
        dims: tuple[str, ...] = ("time",)
        if info.shape == (4, 4):
            dims = ("time", "row", "column")
        elif info.shape:
            dims = ("time", _axis(info))
        if name != "time":
            found[name] = (dims, array, {"units": info.unit, "long_name": info.doc})
    coords: dict[str, Any] = {"time": ("time", arrays["time"], {"units": "s"})}
    for name, array in arrays.items():
        info = INFOS[name]
        if info.shape and info.shape != (4, 4):
            coords[_axis(info)] = list(labels_of(info, array.shape[1], joints))
    plain = {name: str(value) for name, value in facts.items() if value is not None}
    dataset: xr.Dataset = xr.Dataset(found, coords=coords, attrs=plain)
    return dataset


def _axis(info: FieldInfo) -> str:
    names = {2: "xy", 3: "xyz", 6: "wrench", 9: "spread", "nq": "q", "nv": "v", "nu": "joint"}
    axis = names[info.shape[0]]
    return f"{axis}_axis" if axis in INFOS else axis


def _columns(
    arrays: Mapping[str, NDArray[Any]], joints: Sequence[str], fields: Sequence[str]
) -> Iterator[tuple[str, NDArray[Any]]]:
    for name in fields:
        array, info = arrays[name], INFOS[name]
        if not info.shape:
            yield name, array
        elif info.shape == (4, 4):
            names = [f"{name}_{label}" for label in (*_PLACE, *_TURN)]
            values = np.hstack((array[:, :3, 3], quaternions_of(array[:, :3, :3])))
            yield from zip(names, values.T, strict=True)
        else:
            labels = labels_of(info, array.shape[1], joints)
            yield from zip([f"{name}_{label}" for label in labels], array.T, strict=True)


def _chosen(arrays: Mapping[str, NDArray[Any]], fields: Sequence[str] | None) -> list[str]:
    """Return the names of the arrays that become columns, in the order of the record."""
    if fields is None:
        return [name for name in arrays if name != "time"]
    wanted = [fields] if isinstance(fields, str) else list(fields)
    for name in wanted:
        if name not in arrays or name == "time":
            raise InvalidInput(
                f"fields must be names of arrays ({', '.join(n for n in arrays if n != 'time')}), "
                f"got {shown(name)}.",
                argument="fields",
            )
    return wanted
