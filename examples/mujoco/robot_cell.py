# SPDX-License-Identifier: MIT
"""Two UR5e play a diabolo in MuJoCo: the cell of diabolo.hosts, with our string between their sticks.

The tips swing and beat. Joints come from the tips by diabolo.robot, and servos follow them; the sticks feel
the string. It prints how far the tips are from where they should be, and draws the last instant.

    pip install '.[mujoco,plot]'
    python examples/mujoco/robot_cell.py --model out/model.json --picture cell.png

diabolo_in_mujoco.py says what drawing needs.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from diabolo import Model, hang_at_rest, load_recording, model_for
from diabolo.checks import check_drawing
from diabolo.cli import Parser
from diabolo.cli.arguments import output_name, read_model
from diabolo.evaluation import DEFAULT_MODELS
from diabolo.files import check_outputs
from diabolo.hosts import mujoco as host
from diabolo.robot import StickArm, joints_of
from diabolo_in_mujoco import render, take_camera

import mujoco  # isort: skip (diabolo_in_mujoco says how it draws, and what to do without)

DT, DURATION, LAG = 1e-3, 4.0, 0.02  # step, play, and what the servos take about [s]
SPIN = 60.0  # to begin with [rad/s]
SHORTEST, LONGEST = 0.75, 2.2  # string: longer than the tips are apart, and clear of the floor [m]


def tips(times: np.ndarray) -> dict[str, np.ndarray]:
    """Where the tips are to be [m, world], from rest on."""
    slow = np.minimum(times, 1.0) ** 2
    beat, sway = (0.06 * slow * np.sin(2.0 * np.pi * rate * times) for rate in (1.5, 0.75))
    return {
        side: np.stack([0.6 + sway, np.full_like(times, 0.35 * way), 1.25 + way * beat], axis=1)
        for side, way in (("left", 1.0), ("right", -1.0))
    }


def play(model: Model) -> tuple[mujoco.MjModel, mujoco.MjData, np.ndarray, float]:
    """The last instant, the path of the diabolo [m], and how far the tips were off the late plan [m]."""
    length = model.parameters.string_length
    if not SHORTEST <= length <= LONGEST:
        raise ValueError(
            f"string_length: {length:g} m; expected {SHORTEST:g} to {LONGEST:g} m between these tips"
        )
    arms = [StickArm("left"), StickArm("right")]
    wanted = tips(np.arange(0.0, DURATION, DT))
    commands = np.hstack([joints_of(arm, wanted[arm.side]) for arm in arms])
    host.load_plugin()
    physics = mujoco.MjModel.from_xml_string(host.cell(arms, model, DT))
    data = mujoco.MjData(physics)
    data.qpos[:12] = commands[0]
    left, right = wanted["left"][0], wanted["right"][0]
    diabolo = data.joint("diabolo")
    diabolo.qpos[:3] = hang_at_rest(model, left, right, SPIN).position
    diabolo.qvel[3] = -SPIN
    path, reached = [], []
    for data.ctrl[:] in commands:
        mujoco.mj_step(physics, data)
        path.append(diabolo.qpos[:3].copy())
        reached.append([data.site(side).xpos.copy() for side in wanted])
    late = round(LAG / DT)
    plan = np.stack([*wanted.values()], axis=1)[:-late]
    off = float(np.linalg.norm(np.array(reached)[late:] - plan, axis=2).max())
    return physics, data, np.array(path), off


def main() -> int:
    parser = Parser(description=__doc__.splitlines()[0], allow_abbrev=False)
    parser.add_argument(
        "--model",
        metavar="NAME",
        default="consistent",
        help="published, paper, consistent (default) or a model file",
    )
    parser.add_argument(
        "--recording",
        metavar="TAKE",
        help="a take of the set-up: its string length, mass and axle radius, which a diagnosed model "
        "leaves open",
    )
    parser.add_argument("--picture", metavar="FILE", type=output_name, default="robot_cell.png")
    arguments = parser.parse_args()
    picture = Path(arguments.picture)
    try:
        check_drawing(picture, "PIL.Image")
        read = [] if arguments.model in DEFAULT_MODELS else [arguments.model]
        takes = [] if arguments.recording is None else [arguments.recording]
        check_outputs([picture], [*read, *takes])
        model = read_model(arguments.model)
        for take in takes:
            model = model_for(model, load_recording(take))
        physics, data, path, off = play(model)
    except (ValueError, OSError, RuntimeError) as error:
        print(f"robot_cell.py: {error}", file=sys.stderr)
        return 2
    print(f"tips within {1e3 * off:.1f} mm of the plan, {1e3 * LAG:.0f} ms late")
    print(f"the diabolo rose and fell by {1e3 * np.ptp(path[:, 2]):.0f} mm")
    try:
        render(physics, data, path[-400:], picture, take_camera((0.2, 0.0, 0.75), 2.5, 150))
    except Exception as error:  # whatever a graphics stack may raise
        print(f"robot_cell.py: cannot render here ({error})", file=sys.stderr)
        return 2
    print(f"Picture: {picture}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
