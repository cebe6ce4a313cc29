# SPDX-License-Identifier: MIT
"""The diabolo in MuJoCo: their rigid body, integrator and contacts, our string.

What the author of a simulator must do to include the library, here `StringOnBody`:

1. Give the diabolo a free rigid body with its mass and inertia, and nothing of the simulator's own for the
   string.
2. In each step, read the body's position, velocity and spin about the axle into a `State`, and let a
   `Predictor` step it with the tips where they are and where they will be. Parameters are checked once, when
   the predictor is made; the state is yours.
3. Apply over the step the force that takes the body where the predictor went, and the torque about the axle
   that gives it the predicted spin.

About 3: MuJoCo (with the integrators Euler, implicit and implicitfast), like most engines, moves a body by
the velocity at the end of the step, x' = x + v' dt. To land on the predicted position, v' must be the mean
velocity of the predicted step. The rest of the predicted change of velocity, about half a kick, is owed and
counts when the state is read again. So a body that feels gravity and the string alone goes where the plain
predictor goes, at any step, to the tolerance of the predictor's iteration. What else acts on it (contacts,
other bodies, drag) is in the velocity that is read back, and the string answers one step later. While the
string is slack the force is zero. An engine that moves by a constant force exactly (x' = x + v dt +
a dt^2 / 2) needs only `State.string_acceleration` times the mass.

The string pulls at the centre, so that the attitude stays with MuJoCo: the library knows the spin, no tilt.

This example swings and beats, sets the diabolo down on the floor, where the string goes slack, and lifts it
again. It prints how far the body is from the plain predictor before it touches the floor, and draws a
picture.

    pip install '.[mujoco,plot]'
    python examples/mujoco/diabolo_in_mujoco.py --picture diabolo.png

Without a screen or a GPU, MuJoCo draws through EGL and Mesa (Debian: libegl1 libgl1-mesa-dri) or through
OSMesa (Debian: libosmesa6; MUJOCO_GL=osmesa). Where neither works the picture is a plot.
"""

from __future__ import annotations

import argparse
import ctypes.util
import itertools
import os
import sys
from pathlib import Path

import numpy as np
from diabolo import Parameters, Predictor, State, TipMotion, rollout

if ctypes.util.find_library("EGL"):
    os.environ.setdefault("MUJOCO_GL", "egl")  # read when MuJoCo is imported
import mujoco

INERTIA = (5.6e-4, 6.6e-4, 6.6e-4)  # of the paper's red diabolo, about and across the axle [kg m^2]
START_SPIN = 60.0  # [rad/s]
PLAY_UNTIL = 2.0  # the floor is out of reach until then [s]
DURATION = 5.0  # [s]


def model_text(parameters: Parameters, dt: float) -> str:
    tips = "".join(
        f'<body name="{name}" mocap="true"><geom type="capsule" fromto="0 0 0 -0.3 {side} 0.05" size="0.008"'
        ' contype="0" conaffinity="0" rgba="0.75 0.6 0.4 1"/></body>'
        for name, side in (("left", 0.1), ("right", -0.1))
    )
    cups = "".join(
        f'<geom type="ellipsoid" size="0.03 0.06 0.06" pos="{x} 0 0" condim="1" rgba="0.8 0.15 0.1 1"/>'
        for x in (-0.035, 0.035)
    )
    return f"""<mujoco>
  <option timestep="{dt}" integrator="implicitfast" gravity="0 0 {-parameters.gravity}"/>
  <visual><global offwidth="960" offheight="720"/></visual>
  <asset><texture name="sky" type="skybox" builtin="gradient" rgb1="1 1 1" rgb2="0.8 0.85 0.9" width="64"
    height="64"/></asset>
  <worldbody>
    <light pos="1 0 3" dir="-0.3 0 -1"/>
    <geom type="plane" size="2 2 0.1" condim="1" rgba="0.85 0.85 0.8 1"/>
    {tips}
    <body name="diabolo"><freejoint/>{cups}
      <inertial pos="0 0 0" mass="{parameters.mass}" diaginertia="{INERTIA[0]} {INERTIA[1]} {INERTIA[2]}"/>
    </body>
  </worldbody>
</mujoco>"""


def play() -> TipMotion:
    """Tips that swing and beat, go down until the diabolo lies on the floor, and come up again."""
    t = np.linspace(0.0, DURATION, 501)
    sway = 0.05 * (1.0 - np.cos(2 * np.pi * 0.75 * t))
    beat = 0.05 * (1.0 - np.cos(2 * np.pi * 1.5 * t))
    smooth = np.interp(t, [PLAY_UNTIL, 3.0, 3.5, 4.5], [0.0, 1.0, 1.0, 0.0])
    height = 1.3 - 0.4 * (1.0 - np.cos(np.pi * smooth))
    left = np.stack([sway, np.full_like(t, 0.4), height + beat], axis=1)
    right = np.stack([-sway, np.full_like(t, -0.4), height - 0.5 * beat], axis=1)
    return TipMotion(t, left, right, "spline")


def start_state(parameters: Parameters, tips: TipMotion) -> State:
    """Under the middle of the level tips, swinging."""
    left, right, *_ = tips.at(tips.begin)
    drop = 0.5 * np.sqrt(parameters.string_length**2 - np.sum((left - right) ** 2))
    middle = 0.5 * (left + right)
    return State(middle - [0.0, 0.0, drop], [0.3, 0.2, 0.0], START_SPIN, "on_string")


class StringOnBody:
    """Our string between two tips, on a free body of a MuJoCo model whose axle is its x axis."""

    def __init__(self, model: mujoco.MjModel, body: str, predictor: Predictor, start: State) -> None:
        self.predictor, self.state = predictor, start
        self.body = model.body(body).id
        self.mass, self.inertia = model.body_mass[self.body], model.body_inertia[self.body, 0]
        self.gravity, self.dt = model.opt.gravity, model.opt.timestep
        joint = model.body_jntadr[self.body]
        self.position = slice(model.jnt_qposadr[joint], model.jnt_qposadr[joint] + 3)
        self.velocity = slice(model.jnt_dofadr[joint], model.jnt_dofadr[joint] + 3)
        self.attitude = slice(self.position.stop, self.position.stop + 4)
        self.axle_rate = self.velocity.stop  # about the body's x axis; the spin is about -x
        self.owed = np.zeros(3)

    def reset(self, data: mujoco.MjData) -> None:
        """Puts the body into the state."""
        data.qpos[self.position], data.qvel[self.velocity] = self.state.position, self.state.velocity
        data.qvel[self.axle_rate] = -self.state.spin
        self.owed[:] = 0.0

    def apply(self, data: mujoco.MjData, now: tuple, after: tuple) -> None:
        """Sets the string's force and torque for the next mj_step. `now` and `after`: left and right tip [m],
        left and right velocity [m/s] at the beginning and at the end of the step."""
        x, v = data.qpos[self.position].copy(), data.qvel[self.velocity].copy()
        spin = -data.qvel[self.axle_rate]
        self.state.position, self.state.velocity, self.state.spin = x, v + self.owed, spin
        velocities = (now[2], now[3], after[2], after[3])
        self.predictor.step(self.state, now[0], now[1], after[0], after[1], self.dt, velocities)

        mean_velocity = (self.state.position - x) / self.dt
        self.owed = self.state.velocity - mean_velocity
        axle = np.empty(3)
        mujoco.mju_rotVecQuat(axle, np.array([1.0, 0.0, 0.0]), data.qpos[self.attitude])
        force = self.mass * ((mean_velocity - v) / self.dt - self.gravity)
        torque = -axle * (self.inertia * (self.state.spin - spin) / self.dt)
        data.xfrc_applied[self.body] = np.concatenate([force, torque])


def simulate(dt: float) -> tuple[mujoco.MjModel, mujoco.MjData, dict[str, np.ndarray]]:
    """Plays the whole motion; the model, its last data, and what happened in each step."""
    parameters, tips = Parameters(), play()
    model = mujoco.MjModel.from_xml_string(model_text(parameters, dt))
    data = mujoco.MjData(model)
    string = StringOnBody(model, "diabolo", Predictor(parameters), start_state(parameters, tips))
    string.reset(data)
    samples = list(zip(*tips.at(np.arange(round(DURATION / dt) + 1) * dt), strict=True))
    record = {"position": [], "force": [], "contact": [], "spin": []}
    for now, after in itertools.pairwise(samples):
        data.mocap_pos[:] = now[:2]
        string.apply(data, now, after)
        mujoco.mj_step(model, data)
        record["position"].append(data.qpos[string.position].copy())
        record["force"].append(np.linalg.norm(data.xfrc_applied[string.body, :3]))
        record["contact"].append(data.ncon > 0)
        record["spin"].append(-data.qvel[string.axle_rate])
    data.mocap_pos[:] = samples[-1][:2]
    mujoco.mj_forward(model, data)
    return model, data, {name: np.array(values) for name, values in record.items()}


def predicted(dt: float) -> np.ndarray:
    """What the plain predictor says until PLAY_UNTIL: position, velocity, spin after each step."""
    tips = play()
    parameters = Parameters()
    initial = start_state(parameters, tips).to_array()
    steps = round(PLAY_UNTIL / dt)
    return rollout(parameters, initial, tips, dt=dt, steps=steps, string_state="on_string").states


def render(model: mujoco.MjModel, data: mujoco.MjData, path: np.ndarray, picture: Path) -> None:
    """The last instant with the path of the centre. The string is drawn; MuJoCo does not know it."""
    camera = mujoco.MjvCamera()
    camera.lookat, camera.distance, camera.azimuth, camera.elevation = (0, 0, 0.75), 2.4, 150, -12
    with mujoco.Renderer(model, 720, 960) as renderer:
        renderer.update_scene(data, camera)
        scene = renderer.scene

        def capsule(begin: np.ndarray, end: np.ndarray, radius: float, color: tuple) -> None:
            geom = scene.geoms[scene.ngeom]
            nothing = np.zeros(3), np.zeros(3), np.zeros(9), np.array(color, np.float32)
            mujoco.mjv_initGeom(geom, mujoco.mjtGeom.mjGEOM_CAPSULE, *nothing)
            mujoco.mjv_connector(geom, mujoco.mjtGeom.mjGEOM_CAPSULE, radius, begin, end)
            scene.ngeom += 1

        for tip in data.mocap_pos:
            capsule(tip, data.body("diabolo").xpos, 0.003, (1, 1, 1, 1))
        thinned = path[:: max(1, len(path) // 300)]
        for begin, end in itertools.pairwise(thinned):
            capsule(begin, end, 0.002, (0.1, 0.3, 0.8, 1))
        pixels = renderer.render()
    import matplotlib.image

    matplotlib.image.imsave(picture, pixels)


def plot(path: np.ndarray, picture: Path) -> None:
    """The path of the centre as the player sees it, where nothing can be rendered."""
    from matplotlib.figure import Figure

    figure = Figure()
    axes = figure.subplots()
    axes.plot(path[:, 1], path[:, 2])
    axes.set(
        xlabel="left [m]", ylabel="up [m]", aspect="equal", title="Diabolo in MuJoCo, path of the centre"
    )
    axes.invert_xaxis()
    figure.savefig(picture)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--picture", type=Path, default=Path("diabolo_in_mujoco.png"))
    picture = parser.parse_args().picture

    fine = predicted(1e-4)
    print(f"{'dt [ms]':>8} {'to predictor, same dt [m]':>26} {'to predictor, 0.1 ms [m]':>25}")
    for dt in (4e-3, 2e-3, 1e-3):
        model, data, record = simulate(dt)
        plain = predicted(dt)
        body = record["position"][: len(plain)]
        same = np.linalg.norm(body - plain[:, :3], axis=1).max()
        stride = round(dt / 1e-4)
        to_fine = np.linalg.norm(body - fine[stride - 1 :: stride, :3], axis=1).max()
        print(f"{1e3 * dt:8.1f} {same:26.1e} {to_fine:25.1e}")
    on_floor = record["contact"] & (record["force"] < 1e-9)
    print(f"On the floor with a slack string for {dt * on_floor.sum():.2f} s; ", end="")
    parameters = Parameters()
    weight = parameters.mass * parameters.gravity
    print(f"string's force {record['force'][-1]:.2f} N at the end, weight {weight:.2f} N.")
    try:
        render(model, data, record["position"], picture)
    except Exception as error:  # whatever a graphics stack may raise
        print(f"Cannot render here ({error}); the picture is a plot.", file=sys.stderr)
        plot(record["position"], picture)
    print(f"Picture: {picture}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
