# SPDX-License-Identifier: MIT
"""The two arms of a cell with their sticks, as URDF."""

from __future__ import annotations

from collections.abc import Sequence

from .._core import StickArm
from ..arms import two_arms
from .description import (
    RANGE,
    SPEED,
    Floats,
    Link,
    indented,
    links_of,
    numbers,
    roll_pitch_yaw,
    tip_pose,
)

AXES = ("xx", "xy", "xz", "yy", "yz", "zz")


def urdf(arms: Sequence[StickArm] | None = None) -> str:
    """Two UR5e with sticks where they stand, as StickArm has them (default: the paper's), from the link
    `world` on.

    The joints are `left_shoulder_pan_joint` to `right_wrist_3_joint`. The links `left_tip` and `right_tip`
    are where the string is tied, x out along the stick. Masses, torques and speeds are those that Universal
    Robots publishes; inertias and the shape of the links are estimates. URDF knows no free bodies and no
    string: the diabolo is in `mjcf.cell` and `sdf.world`.

    Raises:
        ValueError: there is not one left and one right arm.
    """
    return indented(
        f'<robot name="diabolo_cell"><link name="world"/>{"".join(map(_arm, two_arms(arms)))}</robot>'
    )


def _arm(arm: StickArm) -> str:
    base = f"{arm.side}_base_link"
    parts = [f'<link name="{base}"/>', _fixed(f"{arm.side}_base_joint", "world", base, arm.base)]
    before = base
    for link in links_of(arm):
        parts += [_link(link), _joint(link, before)]
        before = link.name
    tip = f"{arm.side}_tip"
    return "".join([*parts, f'<link name="{tip}"/>', _fixed(f"{tip}_joint", before, tip, tip_pose(arm))])


def _link(link: Link) -> str:
    inertia = " ".join(f'i{axes}="{link.inertia if axes[0] == axes[1] else 0.0}"' for axes in AXES)
    return (
        f'<link name="{link.name}"><inertial><origin xyz="{numbers(link.centre)}"/>'
        f'<mass value="{link.mass}"/><inertia {inertia}/></inertial>'
        f"{_limb(link) if link.length else ''}</link>"
    )


def _limb(link: Link) -> str:
    return (
        f'<visual>{_origin(link.middle)}<geometry><cylinder radius="{link.radius}" length="{link.length}"/>'
        f'</geometry><material name="{link.name}"><color rgba="{numbers(link.colour)} 1"/></material>'
        "</visual>"
    )


def _joint(link: Link, before: str) -> str:
    return (
        f'<joint name="{link.joint}" type="revolute">{_origin(link.pose)}<parent link="{before}"/>'
        f'<child link="{link.name}"/><axis xyz="0 0 1"/><limit lower="{-RANGE}" upper="{RANGE}" '
        f'velocity="{SPEED}" effort="{link.torque}"/></joint>'
    )


def _fixed(name: str, before: str, link: str, pose: Floats) -> str:
    return (
        f'<joint name="{name}" type="fixed">{_origin(pose)}<parent link="{before}"/><child link="{link}"/>'
        "</joint>"
    )


def _origin(pose: Floats) -> str:
    return f'<origin xyz="{numbers(pose[:3, 3])}" rpy="{numbers(roll_pitch_yaw(pose))}"/>'
