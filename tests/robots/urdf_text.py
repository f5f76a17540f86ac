"""A robot written as a URDF."""

import xml.etree.ElementTree as ElementTree

import mujoco
import numpy as np


def numbers(values):
    return " ".join(repr(float(value)) for value in values)


def urdf_of(robot):
    """Return the walker as a URDF tree: one link per joint, so that some links have no mass."""
    mj = robot.mj
    root = ElementTree.Element("robot", name="walker")
    for body in range(1, mj.nbody):
        name = mj.body(body).name
        first, count = int(mj.body_jntadr[body]), int(mj.body_jntnum[body])
        joints = [] if body == 1 else list(range(first, first + count))
        chain = [f"{name}_{i}" for i in range(len(joints) - 1)] + [name]
        for i, joint in enumerate(joints):
            element = ElementTree.SubElement(
                root, "joint", name=mj.joint(joint).name, type="revolute"
            )
            above = mj.body(int(mj.body_parentid[body])).name if i == 0 else chain[i - 1]
            ElementTree.SubElement(element, "parent", link=above)
            ElementTree.SubElement(element, "child", link=chain[i])
            place = mj.body_pos[body] if i == 0 else np.zeros(3)
            ElementTree.SubElement(element, "origin", xyz=numbers(place))
            ElementTree.SubElement(element, "axis", xyz=numbers(mj.jnt_axis[joint]))
            low, high = mj.jnt_range[joint]
            effort = robot.effort[joint - 1]
            ElementTree.SubElement(
                element,
                "limit",
                lower=f"{low}",
                upper=f"{high}",
                effort=f"{effort}",
                velocity="9.5",
            )
            ElementTree.SubElement(element, "dynamics", damping="0.5")
        for link in chain:
            element = ElementTree.SubElement(root, "link", name=link)
            if link != name:
                continue
            inertial = ElementTree.SubElement(element, "inertial")
            ElementTree.SubElement(inertial, "origin", xyz=numbers(mj.body_ipos[body]))
            ElementTree.SubElement(inertial, "mass", value=repr(float(mj.body_mass[body])))
            axes = np.empty(9)
            mujoco.mju_quat2Mat(axes, mj.body_iquat[body])
            axes = axes.reshape(3, 3)
            inertia = axes @ np.diag(mj.body_inertia[body]) @ axes.T
            entries = {
                f"i{a}{b}": repr(float(inertia["xyz".index(a), "xyz".index(b)]))
                for a, b in ("xx", "xy", "xz", "yy", "yz", "zz")
            }
            ElementTree.SubElement(inertial, "inertia", entries)
            if name.endswith("foot"):
                add_box(element, "0.2 0.085 0.025", "0.03 0 -0.0625")
    return root


def add_box(link, size, place, kind="collision"):
    element = ElementTree.SubElement(link, kind)
    ElementTree.SubElement(element, "origin", xyz=place)
    ElementTree.SubElement(ElementTree.SubElement(element, "geometry"), "box", size=size)
    return element
