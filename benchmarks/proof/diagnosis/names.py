# SPDX-License-Identifier: MIT
"""The names that a diagnosis may give, and what a proof must know of each."""

from __future__ import annotations

ON_STRING, LOOSE, FLYING = "ON_STRING", "LOOSE", "FLYING"
ANY_MODE = (ON_STRING, LOOSE, FLYING)

# Physics, with the modes in which each acts.
PHYSICS: dict[str, tuple[str, ...]] = {
    "string_friction": (ON_STRING,),
    "string_elasticity": (ON_STRING,),
    "stick_flex": (ON_STRING,),
    "string_wrap": (ON_STRING,),
    "string_mass": (ON_STRING, LOOSE),
    "landing_restitution": (ON_STRING, LOOSE),
    "air_drag_linear": ANY_MODE,
    "air_drag_quadratic": ANY_MODE,
    "wind": ANY_MODE,
    "magnus_lift": ANY_MODE,
    "spin_drag": ANY_MODE,
    "axle_drag": ANY_MODE,
    "spin_coupling": ANY_MODE,
    "gravity_magnitude": ANY_MODE,
}

# Of these, what is never drawn.
NEVER_DRAWN = ("landing_restitution", "spin_coupling", "gravity_magnitude")
# And what is at work all the same: catches bounce on both plants. To claim it is neither right nor wrong.
AT_WORK_ANYWAY = ("landing_restitution",)

MEASUREMENT = (
    "gravity_tilt",
    "length_scale",
    "time_offset",
    "marker_offset",
    "stick_tip_offset",
    "string_length",
    "frame_rate",
    "filter_lag",
    "body_swap",
    "robot_servo_lag",
)


def physics_among(names: list[str]) -> list[str]:
    return [name for name in names if name in PHYSICS]


def faults_among(names: list[str]) -> list[str]:
    return [name for name in names if name in MEASUREMENT]
