# SPDX-License-Identifier: MIT
"""Scenes of MuJoCo with our string in them, as MJCF."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from .._core import Model, StickArm
from ..checks import instance_of

SENSED = ("left_tension_N", "right_tension_N", "slip_mps", "spin_radps", "string_state")
"""What the sensor of a scene says; the state is 0 on the string, 1 loose, 2 in flight."""
INERTIA = (5.6e-4, 6.6e-4, 6.6e-4)
"""Of the paper's red diabolo, about and across the axle [kg m^2]."""
SERVO = 2e4
"""Stiffness of a joint of a cell, critically damped [N m/rad]: it lags by some hundredths of a second."""
ROTOR = 0.1
"""Inertia of a joint's motor behind its gear, estimated [kg m^2]."""


def scene(model: Model | None = None, timestep: float = 1e-3) -> str:
    """A diabolo on a string between two mocap sticks, `left` and `right`, above a floor.

    Before each step put `data.mocap_pos` where the tips are to be after it [m]. The diabolo is the free body
    `diabolo`, its axle along x; the sensor `string` says SENSED. `model` is as diagnosed or written by you,
    with its own string's length and axle; its gravity is the scene's.

    Raises:
        ValueError: the time step [s] is not above zero.
    """
    sticks = "".join(
        f'<body name="{name}" mocap="true"><site name="{name}" size="0.01" zaxis="1 0 0"/>'
        f'<geom type="capsule" fromto="0 0 0 -0.3 {side} 0.05" size="0.008" {_SEEN_ONLY}'
        ' rgba="0.75 0.6 0.4 1"/></body>'
        for name, side in (("left", 0.1), ("right", -0.1))
    )
    return _with_diabolo(sticks, "", Model() if model is None else model, timestep)


def cell(arms: Sequence[StickArm] | None = None, model: Model | None = None, timestep: float = 1e-3) -> str:
    """A diabolo on a string between the sticks of two UR5e, as StickArm has them (default: the paper's).

    The joints and their servos are `left_1` to `right_6`, left first, in the order of the arms: put joint
    angles into `data.qpos` to begin, and into `data.ctrl` [rad]. The sticks feel the string. Masses are those
    that Universal Robots publishes; inertias, servos (SERVO, ROTOR) and the shape of the links are estimates.
    The rest is as in `scene`.

    Raises:
        ValueError: there is not one left and one right arm, or the time step [s] is not above zero.
    """
    arms = [StickArm("left"), StickArm("right")] if arms is None else list(arms)
    if [arm.side for arm in arms] != ["left", "right"]:
        raise ValueError(f"arms: {[arm.side for arm in arms]}; expected one of the left and one of the right")
    servos = "".join(
        f'<position name="{arm.side}_{i}" joint="{arm.side}_{i}" kp="{SERVO}" dampratio="1"/>'
        for arm in arms
        for i in range(1, 7)
    )
    bodies = "".join(map(_arm, arms))
    return _with_diabolo(
        bodies, f"<actuator>{servos}</actuator>", Model() if model is None else model, timestep
    )


_SEEN_ONLY = 'contype="0" conaffinity="0" mass="0"'


def _arm(arm: StickArm) -> str:
    """An arm, link in link, with the stick in its flange."""
    reach = [*(link[:3, 3] for link in arm.links[1:]), arm.tip]
    along = arm.tip / np.linalg.norm(arm.tip)
    text = f'<site name="{arm.side}" pos="{_numbers(arm.tip)}" size="0.01" zaxis="{_numbers(along)}"/>'
    for i in reversed(range(6)):
        mass, centre = arm.link_masses[i][0], arm.link_masses[i][1:]
        colour, radius = ("0.75 0.6 0.4 1", 0.008) if i == 5 else ("0.6 0.65 0.7 1", 0.045)
        shape = f'<geom type="capsule" fromto="0 0 0 {_numbers(reach[i])}" size="{radius}" rgba="{colour}"'
        limb = f"{shape} {_SEEN_ONLY}/>"
        text = (
            f'<body {_place(arm.links[i])} gravcomp="1"><joint name="{arm.side}_{i + 1}" axis="0 0 1"'
            f' armature="{ROTOR}"/><inertial pos="{_numbers(centre)}" mass="{mass}"'
            f' diaginertia="{_numbers(np.full(3, 0.01 * mass))}"/>'
            f"{limb if np.linalg.norm(reach[i]) > 1e-6 else ''}{text}</body>"
        )
    return f"<body {_place(arm.base)}>{text}</body>"


def _place(pose: NDArray[np.float64]) -> str:
    """Position and orientation of a frame, as attributes."""
    x, y = pose[:3, 0], pose[:3, 1]
    return f'pos="{_numbers(pose[:3, 3])}" xyaxes="{_numbers(x)} {_numbers(y)}"'


def _numbers(vector: Iterable[float]) -> str:
    return " ".join(repr(float(number)) for number in vector)


def _with_diabolo(bodies: str, more: str, model: Model, timestep: float) -> str:
    """A world with the bodies that hold the sites `left` and `right`, and a diabolo between them."""
    instance_of("model", model, Model)
    if isinstance(timestep, bool) or not isinstance(timestep, (int, float)) or not 0.0 < timestep < np.inf:
        raise ValueError(f"timestep: {timestep!r}; expected a number of seconds above 0")
    cups = "".join(
        f'<geom type="ellipsoid" size="0.03 0.06 0.06" pos="{x} 0 0" condim="1" rgba="0.8 0.15 0.1 1"/>'
        for x in (-0.035, 0.035)
    )
    parameters = model.parameters
    return f"""<mujoco model="diabolo">
  <option timestep="{timestep}" integrator="implicitfast" gravity="0 0 {-parameters.gravity}"/>
  <extension><plugin plugin="diabolo.string"><instance name="string">
    <config key="left" value="left"/><config key="right" value="right"/>
    <config key="model" value={quoteattr(model.to_json())}/>
  </instance></plugin></extension>
  <visual><global offwidth="960" offheight="720"/></visual>
  <asset><texture name="sky" type="skybox" builtin="gradient" rgb1="1 1 1" rgb2="0.8 0.85 0.9" width="64"
    height="64"/></asset>
  <worldbody>
    <light pos="1 0 3" dir="-0.3 0 -1"/>
    <geom type="plane" size="2 2 0.1" condim="1" rgba="0.85 0.85 0.8 1"/>
    {bodies}
    <body name="diabolo"><freejoint name="diabolo"/>{cups}<plugin instance="string"/>
      <inertial pos="0 0 0" mass="{parameters.mass}" diaginertia="{" ".join(map(str, INERTIA))}"/>
    </body>
  </worldbody>
  {more}
  <sensor><plugin name="string" plugin="diabolo.string" instance="string"/></sensor>
</mujoco>"""
