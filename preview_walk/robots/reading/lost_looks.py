"""Files that a model only looks at (meshes, textures, skins) may be missing: it walks without."""

from __future__ import annotations

from pathlib import Path

import mujoco

POINTER = b"version https://git-lfs"
"""Start of the few lines that stand for a file of a large-file store until it is fetched."""


def without_lost_looks(spec: mujoco.MjSpec) -> list[str]:
    """Take missing files that are only looked at out of a spec; return remarks.

    A mesh that touches or weighs something is left in, for MuJoCo to say that it is missing.
    """
    folder = Path(spec.modelfiledir)
    lost: list[str] = []
    for mesh in list(spec.meshes):
        if not _lost(spec, folder / spec.compiler.meshdir, mesh.file):
            continue
        shown = [geom for geom in spec.geoms if geom.meshname == mesh.name]
        if all(_only_looked_at(spec, geom) for geom in shown):
            lost.append(mesh.file)
            for geom in shown:
                spec.delete(geom)
            spec.delete(mesh)
    for skin in list(spec.skins):
        if _lost(spec, folder / spec.compiler.meshdir, skin.file):
            lost.append(skin.file)
            spec.delete(skin)
    for texture in spec.textures:
        if _lost(spec, folder / spec.compiler.texturedir, texture.file):
            lost.append(texture.file)
            texture.file, texture.builtin = "", mujoco.mjtBuiltin.mjBUILTIN_FLAT
            texture.width, texture.height = 1, 6 if texture.type else 1
    return [f"not found or not fetched, drawn without: {', '.join(lost)}"] if lost else []


def _lost(spec: mujoco.MjSpec, folder: Path, file: str) -> bool:
    """Return whether a file is named that is missing or a pointer to one."""
    if not file or file in spec.assets:
        return False
    path = folder / (Path(file).name if spec.strippath else file)
    try:
        with path.open("rb") as content:
            return content.read(len(POINTER)) == POINTER
    except (OSError, ValueError):
        return True


def _only_looked_at(spec: mujoco.MjSpec, geom: mujoco.MjsGeom) -> bool:
    """Return whether a geom neither touches anything nor gives its body mass."""
    paired = geom.name and any(geom.name in (p.geomname1, p.geomname2) for p in spec.pairs)
    weightless = geom.parent.explicitinertial or geom.mass == 0.0 or geom.density == 0.0
    return bool(weightless and not (geom.contype or geom.conaffinity or paired))
