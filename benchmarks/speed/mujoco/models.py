# SPDX-License-Identifier: MIT
"""The ways in which compare.py gives MuJoCo the diabolo on its string."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

# What the job does not need of MuJoCo, switched off to save it time.
UNUSED = ("contact", "island", "sensor", "eulerdamp", "equality", "frictionloss", "spring", "damper")
UNUSED += ("actuation", "clampctrl", "midphase", "autoreset")
START = {"left": (0.0, 0.4, 1.3), "right": (0.0, -0.4, 1.3), "diabolo": (0.0, 0.0, 0.695)}  # [m], about


def slides(body: str) -> str:
    """Joints whose coordinates are the body's position in the world."""
    axes = ("1 0 0", "0 1 0", "0 0 1")
    pairs = zip(axes, START[body], strict=True)
    return "".join(f'<joint type="slide" axis="{axis}" ref="{start}"/>' for axis, start in pairs)


def place(body: str) -> str:
    return 'pos="{} {} {}"'.format(*START[body])


@dataclass(frozen=True)
class Model:
    """A way to give MuJoCo the job."""

    kind: str  # mocap, driven or point
    integrator: str = "Euler"
    stiffness: float = 2.0  # time constant of the limit over the timestep; MuJoCo's own minimum is 2
    impedance: str = "0.9 0.95"
    solver: str = "Newton"

    def text(self, steps: int) -> str:
        """MJCF for the given number of steps in the second."""
        mocap = self.kind == "mocap"
        tips = "".join(
            f'<body name="{name}" {place(name)} mocap="{str(mocap).lower()}">{"" if mocap else slides(name)}'
            f'<site name="{name}"/><inertial pos="0 0 0" mass="1000" diaginertia="1 1 1"/></body>'
            for name in ("left", "right")
        )
        diabolo_joint = slides("diabolo") if self.kind == "point" else "<freejoint/>"
        return f"""<mujoco>
  <option gravity="0 0 -9.80665" integrator="{self.integrator}" solver="{self.solver}" tolerance="1e-12">
    <flag {" ".join(f'{flag}="disable"' for flag in UNUSED)}
          refsafe="{"enable" if self.stiffness >= 2 else "disable"}"/>
  </option>
  <statistic meaninertia="0.3"/>
  <worldbody>{tips}
    <body name="diabolo" {place("diabolo")}>{diabolo_joint}<site name="diabolo"/>
      <inertial pos="0 0 0" mass="0.2845" diaginertia="5.6e-4 6.6e-4 6.6e-4"/>
    </body>
  </worldbody>
  <tendon>
    <spatial limited="true" range="0 1.45" solreflimit="{self.stiffness / steps!r} 1"
             solimplimit="{self.impedance} 0.001">
      <site site="left"/><site site="diabolo"/><site site="right"/>
    </spatial>
  </tendon>
</mujoco>"""

    def options(self) -> str:
        flag = "" if self.stiffness >= 2 else ", refsafe off"
        return (
            f"{self.integrator}, {self.solver}, solref {self.stiffness:g} dt{flag}, solimp {self.impedance}"
        )


def variants(kind: str, short: bool) -> list[Model]:
    """Integrators and softness to try. Those named implicit equal Euler here: nothing is damped."""
    if short:
        return [Model(kind, integrator) for integrator in ("Euler", "RK4")]
    choices = itertools.product(
        ("Euler", "RK4", "discrete"), (0.5, 1.0, 2.0, 4.0), ("0.9 0.95", "0.9999 0.9999")
    )
    return [Model(kind, integrator, stiffness, impedance) for integrator, stiffness, impedance in choices]
