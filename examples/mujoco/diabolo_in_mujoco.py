# SPDX-License-Identifier: MIT
"""The diabolo in MuJoCo: their rigid body, integrator and contacts, our string.

The engine plugin `diabolo.string` pulls a free body of MuJoCo's as our string does (docs/hosts.md). This
example swings and beats, sets the diabolo down on the floor, where the string goes slack, and lifts it again.
It prints how far the body is from the plain predictor before it touches the floor, and draws a picture.

    pip install '.[mujoco,plot]'
    python examples/mujoco/diabolo_in_mujoco.py --picture diabolo.png

Without a screen or a GPU, MuJoCo draws through EGL and Mesa (Debian: libegl1 libgl1-mesa-dri) or through
OSMesa (Debian: libosmesa6; MUJOCO_GL=osmesa). Where neither works the picture is a plot.
"""

from __future__ import annotations

import ctypes.util
import itertools
import os
import sys
from pathlib import Path

import numpy as np
from diabolo import Model, Parameters, State, TipMotion, rollout
from diabolo.checks import check_drawing
from diabolo.cli import Parser
from diabolo.cli.arguments import output_name
from diabolo.files import check_outputs, whole_file
from diabolo.hosts import mujoco as host
from diabolo.motions import swing_and_beat

if ctypes.util.find_library("EGL"):
    os.environ.setdefault("MUJOCO_GL", "egl")  # read when MuJoCo is imported
try:
    import mujoco
except ModuleNotFoundError as error:
    print(
        f"{Path(sys.argv[0]).name}: {error}; expected it from: pip install 'diabolo[mujoco]'", file=sys.stderr
    )
    sys.exit(2)

START_SPIN = 60.0  # [rad/s]
PLAY_UNTIL = 2.0  # the floor is out of reach until then [s]
DURATION = 5.0  # [s]


def play() -> TipMotion:
    """Tips that rest, swing and beat, go down until the diabolo lies on the floor, and come up again."""
    level = swing_and_beat(DURATION, rest=0.02)
    smooth = np.interp(level.times, [PLAY_UNTIL, 3.0, 3.5, 4.5], [0.0, 1.0, 1.0, 0.0])
    down = np.outer(1.0 - np.cos(np.pi * smooth), [0.0, 0.0, 0.4])
    return TipMotion(level.times, level.left - down, level.right - down, "spline")


def start_state(parameters: Parameters, tips: TipMotion) -> State:
    """Under the middle of the level tips, swinging."""
    left, right, *_ = tips.at(tips.begin)
    drop = 0.5 * np.sqrt(parameters.string_length**2 - np.sum((left - right) ** 2))
    middle = 0.5 * (left + right)
    return State(middle - [0.0, 0.0, drop], [0.3, 0.2, 0.0], START_SPIN, "on_string")


def simulate(dt: float) -> tuple[mujoco.MjModel, mujoco.MjData, dict[str, np.ndarray]]:
    """Plays the whole motion; the model, its last data, and what happened in each step."""
    parameters, tips = Parameters(), play()
    host.load_plugin()
    model = mujoco.MjModel.from_xml_string(host.scene(Model(parameters), timestep=dt))
    data = mujoco.MjData(model)
    start = start_state(parameters, tips)
    free = data.joint(model.body("diabolo").jntadr[0])
    free.qpos[:3], free.qvel[:3] = start.position, start.velocity
    free.qvel[3] = -start.spin  # about the body's x axis; the spin is about -x
    left, right, *_ = tips.at(np.arange(round(DURATION / dt) + 1) * dt)
    data.mocap_pos[:] = left[0], right[0]
    mujoco.mj_forward(model, data)
    record = {"position": [], "tension": [], "contact": [], "spin": []}
    for data.mocap_pos[0], data.mocap_pos[1] in zip(left[1:], right[1:], strict=True):  # after the step
        mujoco.mj_step(model, data)
        seen = dict(zip(host.SENSED, data.sensor("string").data, strict=True))
        record["position"].append(free.qpos[:3].copy())
        record["tension"].append(0.5 * (seen["left_tension_N"] + seen["right_tension_N"]))
        record["contact"].append(data.ncon > 0)
        record["spin"].append(-free.qvel[3])
    return model, data, {name: np.array(values) for name, values in record.items()}


def predicted(dt: float) -> np.ndarray:
    """What the plain predictor says until PLAY_UNTIL: position, velocity, spin after each step."""
    tips = play()
    parameters = Parameters()
    initial = start_state(parameters, tips).to_array()
    steps = round(PLAY_UNTIL / dt)
    return rollout(parameters, initial, tips, dt=dt, steps=steps, string_state="on_string").states


def take_camera(lookat: tuple[float, float, float], distance: float, azimuth: float) -> mujoco.MjvCamera:
    """A camera so far [m] from a point [m], in that direction [degrees], and a little above it."""
    camera = mujoco.MjvCamera()
    camera.lookat, camera.distance, camera.azimuth, camera.elevation = lookat, distance, azimuth, -12
    return camera


def render(
    model: mujoco.MjModel, data: mujoco.MjData, path: np.ndarray, picture: Path, camera: mujoco.MjvCamera
) -> None:
    """The last instant with the path of the centre."""
    with mujoco.Renderer(model, 720, 960) as renderer:
        renderer.update_scene(data, camera)
        scene = renderer.scene

        def capsule(begin: np.ndarray, end: np.ndarray, radius: float, color: tuple) -> None:
            geom = scene.geoms[scene.ngeom]
            nothing = np.zeros(3), np.zeros(3), np.zeros(9), np.array(color, np.float32)
            mujoco.mjv_initGeom(geom, mujoco.mjtGeom.mjGEOM_CAPSULE, *nothing)
            mujoco.mjv_connector(geom, mujoco.mjtGeom.mjGEOM_CAPSULE, radius, begin, end)
            scene.ngeom += 1

        thinned = path[:: max(1, len(path) // 300)]
        for begin, end in itertools.pairwise(thinned):
            capsule(begin, end, 0.002, (0.1, 0.3, 0.8, 1))
        pixels = renderer.render()
    from PIL import Image

    image = Image.fromarray(pixels).quantize(96, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    with whole_file(picture) as temporary:
        image.save(temporary, "PNG", optimize=True)


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
    with whole_file(picture) as temporary:
        figure.savefig(temporary, format="png")


def compared() -> tuple[mujoco.MjModel, mujoco.MjData, np.ndarray]:
    """Plays by three steps and prints how far they are from the predictor; of the last one the model, its
    last data, and the path of the centre."""
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
    on_floor = record["contact"] & (record["tension"] == 0.0)
    print(f"On the floor with a slack string for {dt * on_floor.sum():.2f} s; ", end="")
    print(f"the string's tension is {record['tension'][-1]:.2f} N at the end.")
    return model, data, record["position"]


def main() -> int:
    parser = Parser(description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument("--picture", metavar="FILE", type=output_name, default="diabolo_in_mujoco.png")
    picture = Path(parser.parse_args().picture)
    try:
        check_drawing(picture, "matplotlib", "PIL.Image")
        check_outputs([picture], [])
        model, data, path = compared()
    except (ValueError, RuntimeError) as error:
        print(f"diabolo_in_mujoco.py: {error}", file=sys.stderr)
        return 2
    try:
        render(model, data, path, picture, take_camera((0, 0, 0.75), 2.4, 150))
    except Exception as error:  # whatever a graphics stack may raise
        print(f"Cannot render here ({error}); the picture is a plot.", file=sys.stderr)
        plot(path, picture)
    print(f"Picture: {picture}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
