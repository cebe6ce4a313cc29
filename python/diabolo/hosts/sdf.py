# SPDX-License-Identifier: MIT
"""The cell of two UR5e with a diabolo, as a world of SDF."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.sax.saxutils import escape

from .._core import Model, StickArm
from ..arms import two_arms
from ..checks import instance_of, shown
from .description import (
    CUP,
    CUPS_AT,
    RANGE,
    RED,
    SPEED,
    Floats,
    Link,
    diabolo_inertia,
    indented,
    links_of,
    numbers,
    roll_pitch_yaw,
    tip_pose,
)

PLUGIN = 'filename="DiaboloString" name="diabolo::String"'
"""Attributes by which Gazebo finds our string."""
TIP = 1e-3, [1e-7] * 3
"""Mass [kg] and inertia [kg m^2] of a tip: links have to have some."""
AXES = ("xx", "yy", "zz")
NO_TEXT = "[\x00-\x1f\ud800-\udfff\ufffe\uffff]"
"""What no text of XML holds, or would not keep."""


def world(
    arms: Sequence[StickArm] | None = None, model: Model | None = None, model_file: str = "consistent"
) -> str:
    """Two UR5e with sticks (default: the paper's) on a floor, and the diabolo as a free body between them.

    The joints and links of the model `cell` are those of `urdf`. The arms feel no gravity, and no servos hold
    them. The diabolo is a hub, on which the string pulls, with cups that turn on it: engines that count a
    free body's velocity in its own frame lose their way where it spins. Its mass and inertia and the world's
    gravity are those of `model`. The string is the plugin `diabolo::String`, which reads `model_file`, the
    name of a model's file, as seen from the world's, or of a preset. Where the string's length and the axle
    are the model's own, they stand in the plugin and count over those of the file.

    Raises:
        ValueError: there is not one left and one right arm, `model` is no Model, or `model_file` no name.
    """
    model = Model() if model is None else instance_of("model", model, Model)
    if not isinstance(model_file, str) or not model_file.strip() or re.search(NO_TEXT, model_file):
        expected = "expected the name of a model's file or of a preset"
        raise ValueError(f"model_file: {shown(model_file)}; {expected}")
    inside = (
        '<physics name="1 ms" type="ignored"><max_step_size>0.001</max_step_size></physics>'
        f"<gravity>0 0 {-model.parameters.gravity}</gravity>"
        '<light name="sun" type="directional"><direction>-0.3 0 -1</direction></light>'
        f'{FLOOR}<model name="cell">{"".join(map(_arm, two_arms(arms)))}</model>{_diabolo(model, model_file)}'
    )
    return indented(f'<sdf version="1.9"><world name="diabolo">{inside}</world></sdf>')


_PLANE = "<geometry><plane><normal>0 0 1</normal><size>4 4</size></plane></geometry>"
FLOOR = (
    '<model name="floor"><static>true</static><link name="floor">'
    f'<collision name="ground">{_PLANE}</collision><visual name="seen">{_PLANE}</visual></link></model>'
)


def _arm(arm: StickArm) -> str:
    """An arm whose first joint holds on to the world."""
    base = f"{arm.side}_base_link"
    parts = [f'<frame name="{base}">{_pose(arm.base)}</frame>']
    before, child_of = base, "world"
    for link in links_of(arm):
        parts += [_link(link, before), _joint(link, child_of)]
        before = child_of = link.name
    tip = f"{arm.side}_tip"
    parts.append(
        f'<link name="{tip}">{_pose(tip_pose(arm), before)}<gravity>false</gravity>{_inertial(*TIP)}</link>'
        f'<joint name="{tip}_joint" type="fixed"><parent>{before}</parent><child>{tip}</child></joint>'
    )
    return "".join(parts)


def _link(link: Link, before: str) -> str:
    return (
        f'<link name="{link.name}">{_pose(link.pose, before)}<gravity>false</gravity>'
        f"{_inertial(link.mass, [link.inertia] * 3, link.centre)}{_limb(link) if link.length else ''}</link>"
    )


def _limb(link: Link) -> str:
    return (
        f'<visual name="limb">{_pose(link.middle)}<geometry><capsule><radius>{link.radius}</radius>'
        f"<length>{link.length}</length></capsule></geometry>{_material(link.colour)}</visual>"
    )


def _joint(link: Link, parent: str) -> str:
    return (
        f'<joint name="{link.joint}" type="revolute"><parent>{parent}</parent><child>{link.name}</child>'
        f"<axis><xyz>0 0 1</xyz><limit><lower>{-RANGE}</lower><upper>{RANGE}</upper>"
        f"<velocity>{SPEED}</velocity><effort>{link.torque}</effort></limit></axis></joint>"
    )


def _diabolo(model: Model, model_file: str) -> str:
    half, inertia = 0.5 * model.parameters.mass, diabolo_inertia(model)
    turning = inertia * (1.0, 0.5, 0.5)  # hub and cups share what is across the axle
    cup = f"<geometry><ellipsoid><radii>{numbers(CUP)}</radii></ellipsoid></geometry>"
    cups = "".join(
        f'<{kind} name="{kind}_{k}"><pose>{x} 0 0 0 0 0</pose>{cup}{more}</{kind}>'
        for k, x in enumerate(CUPS_AT)
        for kind, more in (("collision", ""), ("visual", _material(RED)))
    )
    return (
        f'<model name="diabolo"><pose>0 0 {CUP[2]} 0 0 0</pose>'
        f'<link name="hub">{_inertial(half, 0.5 * inertia)}</link>'
        f'<link name="cups">{_inertial(half, turning)}{cups}</link>'
        '<joint name="axle" type="revolute"><parent>hub</parent><child>cups</child>'
        f"<axis><xyz>1 0 0</xyz></axis></joint><plugin {PLUGIN}>"
        "<link>hub</link><spinning_link>cups</spinning_link>"
        "<left>cell::left_tip</left><right>cell::right_tip</right>"
        f"<model>{escape(model_file)}</model>{_own(model)}</plugin></model>"
    )


def _own(model: Model) -> str:
    """What the string goes by whatever is recorded; its mass is that of the links."""
    own = {"string_length": model.own_string_length, "axle_radius": model.own_axle_radius}
    return "".join(f"<{name}>{getattr(model.parameters, name)}</{name}>" for name in own if own[name])


def _inertial(
    mass: float, inertia: Sequence[float] | Floats, centre: Sequence[float] | Floats = (0, 0, 0)
) -> str:
    moments = "".join(f"<i{axes}>{moment}</i{axes}>" for axes, moment in zip(AXES, inertia, strict=True))
    return (
        f"<inertial><pose>{numbers(centre)} 0 0 0</pose><mass>{mass}</mass><inertia>{moments}</inertia>"
        "</inertial>"
    )


def _material(colour: Sequence[float]) -> str:
    return (
        f"<material><ambient>{numbers(colour)} 1</ambient><diffuse>{numbers(colour)} 1</diffuse></material>"
    )


def _pose(pose: Floats, relative_to: str = "") -> str:
    where = f' relative_to="{relative_to}"' if relative_to else ""
    return f"<pose{where}>{numbers(pose[:3, 3])} {numbers(roll_pitch_yaw(pose))}</pose>"
