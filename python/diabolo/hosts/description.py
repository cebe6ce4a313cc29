# SPDX-License-Identifier: MIT
"""What the cell of two UR5e is made of: said once, for MJCF, URDF and SDF."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from .._core import Model, StickArm
from ..arms import JOINTS, along, stick_frame

Floats = NDArray[np.float64]

INERTIA = (5.6e-4, 6.6e-4, 6.6e-4)
"""Of the paper's red diabolo, about and across the axle [kg m^2]."""
CUP, CUPS_AT = (0.03, 0.06, 0.06), (-0.035, 0.035)
"""Half axes of a cup, an ellipsoid, and where both are on the axle, which is x [m]."""
LINKS = ("shoulder_link", "upper_arm_link", "forearm_link", "wrist_1_link", "wrist_2_link", "wrist_3_link")
"""Behind the joints of diabolo.robot.JOINTS, as UR's own description names them."""
TORQUES = (150.0, 150.0, 150.0, 28.0, 28.0, 28.0)
"""Largest of the joints, from the maker's data sheet [N m]."""
SPEED, RANGE = np.pi, 2.0 * np.pi
"""Of each joint, from the maker's data sheet [rad/s], [rad] to both sides."""
ARM, STICK = ((0.6, 0.65, 0.7), 0.045), ((0.75, 0.6, 0.4), 0.008)
"""Colour and radius [m] of what is seen."""
RED = (0.8, 0.15, 0.1)


@dataclass(frozen=True, eq=False)
class Link:
    """A rigid part of an arm, of the frame that its joint turns about z.

    pose: of that frame in the one before, shape (4, 4), with the joint at zero. mass [kg], its centre [m],
    shape (3,), and its inertia about any axis through that, estimated [kg m^2]. end: to where the part
    reaches from the frame's origin [m], shape (3,). torque: largest of the joint [N m].
    """

    name: str
    joint: str
    pose: Floats
    mass: float
    centre: Floats
    inertia: float
    end: Floats
    radius: float
    colour: tuple[float, float, float]
    torque: float

    @property
    def length(self) -> float:
        """Of what is seen [m]: zero where the next frame begins at the origin."""
        length = float(np.linalg.norm(self.end))
        return length if length > 1e-6 else 0.0

    @property
    def middle(self) -> Floats:
        """Pose of what is seen, a cylinder along its own z, shape (4, 4); only where it has a length."""
        return pose_of(along(self.end)[:, (1, 2, 0)], 0.5 * self.end)


def links_of(arm: StickArm) -> list[Link]:
    """The six links of an arm, from the base on. The stick goes with the last one."""
    ends = [*(pose[:3, 3] for pose in arm.links[1:]), arm.tip]
    links = []
    for k, (mass, *centre) in enumerate(arm.link_masses):
        colour, radius = STICK if k == len(LINKS) - 1 else ARM
        links.append(
            Link(
                name=f"{arm.side}_{LINKS[k]}",
                joint=f"{arm.side}_{JOINTS[k]}",
                pose=arm.links[k],
                mass=mass,
                centre=np.array(centre),
                inertia=0.01 * mass,
                end=ends[k],
                radius=radius,
                colour=colour,
                torque=TORQUES[k],
            )
        )
    return links


def tip_pose(arm: StickArm) -> Floats:
    """Of the stick's tip in the last link, shape (4, 4): x points out along the stick."""
    return pose_of(stick_frame(arm), arm.tip)


def diabolo_inertia(model: Model) -> Floats:
    """About and across the axle [kg m^2], shape (3,). Where a model knows how strongly the string turns the
    axle, gain = m r / I, it is that; else INERTIA."""
    gain = model.string_friction.spin_gain or model.gyroscopic_tilt.gain
    parameters = model.parameters
    axial = parameters.mass * parameters.axle_radius / gain if gain > 0.0 else INERTIA[0]
    return np.array(INERTIA) * (axial / INERTIA[0])


def pose_of(rotation: Floats, position: Floats) -> Floats:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, position
    return pose


def roll_pitch_yaw(pose: Floats) -> Floats:
    """Angles about the fixed axes x, y, z in turn [rad], as URDF and SDF have them, shape (3,)."""
    r = pose[:3, :3]
    level = np.hypot(r[0, 0], r[1, 0])
    pitch = np.arctan2(-r[2, 0], level)
    if level < 1e-9:  # roll and yaw are about one axis
        return np.array([0.0, pitch, np.arctan2(-r[0, 1], r[1, 1])])
    return np.array([np.arctan2(r[2, 1], r[2, 2]), pitch, np.arctan2(r[1, 0], r[0, 0])])


def numbers(vector: Iterable[float]) -> str:
    """As XML has them, to the last bit."""
    return " ".join(repr(float(number) + 0.0) for number in vector)


def indented(text: str) -> str:
    """XML for people to read."""
    root = ElementTree.fromstring(text)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"
