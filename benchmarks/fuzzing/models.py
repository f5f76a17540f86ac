"""Model files: URDF, MJCF and descriptions with parts left out, doubled, moved, renamed, spoilt."""

from __future__ import annotations

import json
import re
import warnings
from functools import lru_cache, partial
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from random import Random
from xml.etree import ElementTree

import preview_walk as pw
from fuzzing.api import TESTS
from fuzzing.verdict import ACCEPTED, Verdict, of_error
from preview_walk import load_robot
from preview_walk.robots.reading.description import models_folder

NUMBERS = (
    "0", "-1", "1", "1e-300", "1e30", "1e308", "nan", "inf", "-inf", "", "text", "1 2", "0 0 0",
    "1 0 0", "1e30 1e30 1e30", "nan 0 0", "1 2 3 4 5 6 7", "0 0 0 0", "1,5", "0x10", "-0", "1e-9",
)  # fmt: skip
WORDS = (
    "world", "base", "torso", "", "free", "hinge", "slide", "ball", "floating", "fixed", "planar",
    "continuous", "mesh", "box", "sphere", "\u00e9\u4e16", "x" * 3000, "&#0;", "../../x.stl",
    "package://a/b.dae", "file:///dev/null", "true", "degree", "radian",
)  # fmt: skip
STARTS = (
    "<?xml version='1.0' encoding='utf-32'?>", "<?xml version='1.0' encoding='base64'?>",
    "<?xml version='9' encoding='latin-1'?>", "<!DOCTYPE a [<!ENTITY b 'c'>]>", "\x00", "\ufeff",
    "<!-- -->", "<robot/>", "<mujoco/>",
)  # fmt: skip
FACTS = {
    "title": "a", "model": "robot.xml", "torso": "torso", "feet": {}, "soles": {}, "posture": {},
    "locked": [], "front": [1, 0, 0], "base": "torso",
}  # fmt: skip


@lru_cache(maxsize=1)
def bases() -> dict[str, str]:
    """Return the texts that are changed, by the ending of their file."""
    file = TESTS / "robots" / "urdf_text.py"
    spec = spec_from_file_location("urdf_of_the_walker", file)
    assert spec is not None
    assert spec.loader is not None
    writer = module_from_spec(spec)
    spec.loader.exec_module(writer)
    mjcf = (models_folder() / "humanoid-walker.xml").read_text(encoding="utf-8")
    tree = writer.urdf_of(load_robot("humanoid-walker"))
    return {"xml": mjcf, "urdf": ElementTree.tostring(tree, encoding="unicode")}


def _tags(text: str) -> list[str]:
    """Return a text as tags and what is between them."""
    return re.split(r"(<[^>]+>)", text)


def draw(rng: Random) -> list[str]:
    """Return the kind of file and changes, one to three."""
    kind = rng.choice(("xml", "urdf", "urdf", "json"))
    if kind == "json":
        names = rng.sample(sorted(FACTS), rng.randint(1, 3))
        return [kind, *(f"fact {name} {json.dumps(_fact(rng))}" for name in names)]
    pieces = _tags(bases()[kind])
    parts = [kind]
    for _ in range(rng.choice((1, 1, 2, 3))):
        at, other = rng.randrange(1, len(pieces), 2), rng.randrange(1, len(pieces), 2)
        attributes = re.findall(r"([\w:]+)=", pieces[at])
        choice = rng.random()
        if attributes and choice < 0.6:
            value = rng.choice(NUMBERS if rng.random() < 0.6 else WORDS)
            if rng.random() < 0.3:
                value = rng.choice(re.findall(r'"([^"]*)"', pieces[other]) or [value])
            parts.append(f"attribute {at} {rng.choice(attributes)} {value}")
        elif attributes and choice < 0.68:
            parts.append(f"without {at} {rng.choice(attributes)}")
        elif choice < 0.78:
            parts.append(f"drop {at}")
        elif choice < 0.86:
            parts.append(f"double {at}")
        elif choice < 0.93:
            parts.append(f"put {at} {other}")
        elif choice < 0.97:
            parts.append(f"start {rng.choice(STARTS)}")
        else:
            parts.append(f"cut {at}")
    return parts


def _fact(rng: Random) -> object:
    plain = (
        None,
        "",
        "torso",
        "x\0y",
        "x" * 5000,
        [],
        {},
        -1,
        1e308,
        float("nan"),
        [1, 2, 3],
        True,
    )
    sole = {"size": rng.choice((*plain, [0.2, 0.1], [0, 0])), "center": rng.choice(plain)}
    sides = {"left": rng.choice((*plain, sole)), "right": rng.choice((*plain, sole))}
    return rng.choice(
        (*plain, sides, {"left_foot": sole}, [[[[]]]], {"left_knee": rng.choice(plain)})
    )


def _text(kind: str, changes: list[str]) -> str:
    if kind == "json":
        table: dict[str, object] = {"title": "a", "model": "robot.xml"}
        for change in changes:
            _, name, value = change.split(" ", 2)
            table[name] = json.loads(value)
        return json.dumps(table)
    pieces = _tags(bases()[kind])
    start, end = "", len(pieces)
    out = list(pieces)
    for change in changes:
        what, _, rest = change.partition(" ")
        if what == "start":
            start = rest
            continue
        at, _, rest = rest.partition(" ")
        i = int(at)
        if what == "attribute":
            name, _, value = rest.partition(" ")
            out[i] = re.sub(rf'\b{name}="[^"]*"', partial(_put, name, value), out[i], count=1)
        elif what == "without":
            out[i] = re.sub(rf'\b{rest}="[^"]*"', "", out[i], count=1)
        elif what == "drop":
            out[i] = ""
        elif what == "double":
            out[i] += pieces[i]
        elif what == "put":
            out[i] += pieces[int(rest)]
        elif what == "cut":
            end = min(end, i)
    return start + "".join(out[:end])


def _put(name: str, value: str, found: re.Match[str]) -> str:
    return f'{name}="{value}"'


def attempt(parts: list[str], folder: Path) -> Verdict:
    """Load the file, and inspect what cannot walk."""
    if not parts or parts[0] not in ("xml", "urdf", "json"):
        return Verdict(ACCEPTED)
    path = folder / f"changed.{parts[0]}"
    (folder / "robot.xml").write_text(bases()["xml"], encoding="utf-8")
    path.write_text(_text(parts[0], parts[1:]), encoding="utf-8", errors="surrogatepass")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            robot = pw.load_robot(path)
            pw.Walk.standing(robot).run(until=0.004)
    except Exception as error:
        verdict = of_error(error, named=True)
        try:
            str(pw.inspect_robot(path))
        except Exception as second:
            return of_error(second)
        return verdict
    return Verdict(ACCEPTED)
