# SPDX-License-Identifier: MIT
"""Scenes of MuJoCo with our string in them, as MJCF."""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from .._core import Model, StickArm
from ..arms import two_arms
from ..checks import instance_of, number
from ..player import hang_at_rest
from ..robot import joints_of
from .description import ARM, CUP, CUPS_AT, INERTIA, RED, diabolo_inertia, links_of, numbers, tip_pose

__all__ = ["INERTIA", "SENSED", "cell", "scene"]
SENSED = ("left_tension_N", "right_tension_N", "slip_mps", "spin_radps", "string_state", "overstretched")
"""What the sensor of a scene says; the state is 0 on the string, 1 loose, 2 in flight."""
SERVO = 2e4
"""Stiffness of a joint of a cell, critically damped [N m/rad]: it lags by some hundredths of a second."""
ROTOR = 0.1
"""Inertia of a joint's motor behind its gear, estimated [kg m^2]."""
SHORTEST, LONGEST = 1e-9, 1.0
"""Time step of a scene [s]."""
HANGING = (0.4, 0.7)
"""Of a scene: tips beside the middle, and the diabolo above the floor [m]."""
READY = (0.6, 0.35, 0.55)
"""Tips of a cell that is ready: before, beside and above the middle between the arms' bases [m]."""


def scene(model: Model | None = None, timestep: float = 1e-3) -> str:
    """A diabolo on a string between two mocap sticks, `left` and `right`, above a floor.

    It begins at rest (HANGING). Before each step put `data.mocap_pos` where the tips are to be after it [m].
    The diabolo is the free body `diabolo`, its axle along x; the sensor `string` says SENSED. `model` is as
    diagnosed or written by you, with its own string's length and axle; its gravity is the scene's.

    Raises:
        ValueError: the time step is not from 1e-9 to 1 s.
    """
    model = Model() if model is None else instance_of("model", model, Model)
    tips, place = _hanging(model)
    sticks = "".join(
        f'<body name="{name}" mocap="true" pos="{numbers(tip)}">'
        f'<site name="{name}" size="0.01" zaxis="1 0 0"/>'
        f'<geom type="capsule" fromto="0 0 0 -0.3 {side} 0.05" size="0.008" {_SEEN_ONLY}'
        ' rgba="0.75 0.6 0.4 1"/></body>'
        for name, side, tip in zip(("left", "right"), (0.1, -0.1), tips, strict=True)
    )
    return _with_diabolo(sticks, "", model, timestep, place)


def _hanging(model: Model) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Both tips of a scene, and the diabolo at rest below them."""
    aside, height = HANGING
    aside *= min(1.0, model.parameters.string_length)
    tips = np.array([[0.0, aside, 0.0], [0.0, -aside, 0.0]])
    place = hang_at_rest(model, *tips).position
    raised = np.array([0.0, 0.0, height - place[2]])
    return tips + raised, place + raised


def cell(arms: Sequence[StickArm] | None = None, model: Model | None = None, timestep: float = 1e-3) -> str:
    """A diabolo on a string between the sticks of two UR5e, as StickArm has them (default: the paper's).

    The joints and their servos are `left_shoulder_pan_joint` to `right_wrist_3_joint`, left first, in the
    order of the arms: put joint angles into `data.qpos` to begin, and into `data.ctrl` [rad]. The key `ready`
    has some, with the diabolo at rest below the tips (READY), unless an arm does not reach there or the
    diabolo would be in the floor. The sticks feel the string. Masses are those that Universal Robots
    publishes; inertias, servos (SERVO, ROTOR) and the shape of the links are estimates. The rest is as in
    `scene`.

    Raises:
        ValueError: there is not one left and one right arm, or the time step is not from 1e-9 to 1 s.
    """
    arms, model = two_arms(arms), Model() if model is None else instance_of("model", model, Model)
    servos = "".join(
        f'<position name="{link.joint}" joint="{link.joint}" kp="{SERVO}" dampratio="1"/>'
        for arm in arms
        for link in links_of(arm)
    )
    more = f"<actuator>{servos}</actuator>{_ready(arms, model)}"
    return _with_diabolo("".join(map(_arm, arms)), more, model, timestep)


def _ready(arms: Sequence[StickArm], model: Model) -> str:
    """The key of that name, or nothing."""
    forward, aside, up = READY
    aside *= min(1.0, model.parameters.string_length)
    middle = 0.5 * (arms[0].base[:3, 3] + arms[1].base[:3, 3])
    left, right = (middle + np.array([forward, way * aside, up]) for way in (1.0, -1.0))
    try:
        angles = [joints_of(arm, tip[None])[0] for arm, tip in zip(arms, (left, right), strict=True)]
        place = hang_at_rest(model, left, right).position
    except ValueError:  # out of reach
        return ""
    if place[2] < max(CUP):
        return ""
    joints = numbers(np.hstack(angles))
    qpos = f"{joints} {numbers(place)} 1 0 0 0"
    return f'<keyframe><key name="ready" qpos="{qpos}" ctrl="{joints}"/></keyframe>'


_SEEN_ONLY = 'contype="0" conaffinity="0" mass="0"'


def _arm(arm: StickArm) -> str:
    """An arm, link in link, with the stick in its flange."""
    tip = tip_pose(arm)
    text = f'<site name="{arm.side}" pos="{numbers(tip[:3, 3])}" size="0.01" zaxis="{numbers(tip[:3, 0])}"/>'
    for link in reversed(links_of(arm)):
        limb = (
            f'<geom type="capsule" fromto="0 0 0 {numbers(link.end)}" size="{link.radius}" '
            f'rgba="{numbers(link.colour)} 1" {_SEEN_ONLY}/>'
        )
        text = (
            f'<body name="{link.name}" {_place(link.pose)} gravcomp="1"><joint name="{link.joint}" '
            f'axis="0 0 1" armature="{ROTOR}"/><inertial pos="{numbers(link.centre)}" mass="{link.mass}" '
            f'diaginertia="{numbers([link.inertia] * 3)}"/>{limb if link.length else ""}{text}</body>'
        )
    return f"<body {_place(arm.base)}>{_column(arm)}{text}</body>"


def _column(arm: StickArm) -> str:
    """From the floor to the first joint, where the arm stands above the floor."""
    colour, radius = ARM
    height, shoulder = arm.base[2, 3], arm.links[0][2, 3]
    if height <= radius:
        return ""
    return (
        f'<geom type="cylinder" fromto="0 0 {-height} 0 0 {shoulder}" size="{1.5 * radius}" '
        f'rgba="{numbers(colour)} 1" {_SEEN_ONLY}/>'
    )


def _place(pose: NDArray[np.float64]) -> str:
    """Position and orientation of a frame, as attributes."""
    x, y = pose[:3, 0], pose[:3, 1]
    return f'pos="{numbers(pose[:3, 3])}" xyaxes="{numbers(x)} {numbers(y)}"'


def _with_diabolo(
    bodies: str,
    more: str,
    model: Model,
    timestep: float,
    place: Sequence[float] | NDArray[np.float64] = (0, 0, 0),
) -> str:
    """A world with the bodies that hold the sites `left` and `right`, and a diabolo at a place."""
    timestep = number("timestep", timestep)
    if not SHORTEST <= timestep <= LONGEST:
        raise ValueError(f"timestep: {timestep:g} s; expected {SHORTEST:g} to {LONGEST:g}")
    cups = "".join(
        f'<geom type="ellipsoid" size="{numbers(CUP)}" pos="{x} 0 0" condim="1" rgba="{numbers(RED)} 1"/>'
        for x in CUPS_AT
    )
    parameters = model.parameters
    return f"""<mujoco model="diabolo">
  <option timestep="{timestep}" integrator="implicitfast" gravity="0 0 {-parameters.gravity}"/>
  <extension><plugin plugin="diabolo.string"><instance name="string">
    <config key="left" value="left"/><config key="right" value="right"/>
    <config key="model" value={quoteattr(model.to_json())}/>
  </instance></plugin></extension>
  <visual><global offwidth="960" offheight="720"/>
    <headlight ambient="0.4 0.4 0.4" diffuse="0.3 0.3 0.3" specular="0 0 0"/></visual>
  <asset><texture name="sky" type="skybox" builtin="gradient" rgb1="1 1 1" rgb2="0.8 0.85 0.9" width="64"
    height="64"/></asset>
  <worldbody>
    <light pos="1 0 3" dir="-0.3 0 -1" type="directional" diffuse="0.5 0.5 0.5"/>
    <geom type="plane" size="2 2 0.1" condim="1" rgba="0.85 0.85 0.8 1"/>
    {bodies}
    <body name="diabolo" pos="{numbers(place)}"><freejoint name="diabolo"/>{cups}<plugin instance="string"/>
      <inertial pos="0 0 0" mass="{parameters.mass}" diaginertia="{numbers(diabolo_inertia(model))}"/>
    </body>
  </worldbody>
  {more}
  <sensor><plugin name="string" plugin="diabolo.string" instance="string"/></sensor>
</mujoco>"""
