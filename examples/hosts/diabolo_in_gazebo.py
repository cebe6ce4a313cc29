# SPDX-License-Identifier: MIT
"""The diabolo in Gazebo's physics: its engine dartsim, our string (docs/hosts.md).

    make gazebo && pip install '.[plot]'
    python examples/hosts/diabolo_in_gazebo.py --picture gazebo.png

Tips swing and beat for two seconds. It prints, and draws, how far Gazebo's body is from the plain predictor.
(The program that it runs, `build/gazebo/diabolo_gazebo`, plays what `diabolo motion` writes.)
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from diabolo import DiaboloProperties, Model, State, TipMotion, load_recording
from diabolo.cli import Parser
from diabolo.cli.arguments import output_name
from numpy.typing import NDArray
from play_motion import compared

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "gazebo" / "diabolo_gazebo"
WORLD = ROOT / "examples" / "gazebo" / "diabolo.world.sdf"
LONGEST = 600  # of the program [s]


def simulate(model: Model, start: State, tips: TipMotion, dt: float, steps: int) -> NDArray[np.float64]:
    """Where Gazebo's body is after each step, (steps, 3). Raises ValueError where the program cannot play."""
    if not PROGRAM.is_file():
        raise ValueError(f"{PROGRAM}: the program is not there; `make gazebo` builds it")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        model.save(folder / "model.json")
        world = WORLD.read_text(encoding="utf-8")
        for was, now in (("consistent", "model.json"), ("0.001", repr(dt))):
            if world.count(f">{was}<") != 1:
                raise ValueError(f"{WORLD}: >{was}< is there {world.count(f'>{was}<')} times; expected once")
            world = world.replace(f">{was}<", f">{now}<")
        (folder / "world.sdf").write_text(world, encoding="utf-8")
        # The spline of the tips bends at its end, so the motion goes on for up to 50 steps beyond what is
        # compared.
        beyond = min(50, int((tips.end - tips.begin) / dt + 1e-6) - steps)
        write_motion(folder / "motion.csv", model, start, tips, dt * np.arange(steps + beyond + 1))
        files = [folder / name for name in ("world.sdf", "motion.csv", "sim.csv")]
        try:
            done = subprocess.run([PROGRAM, *files], capture_output=True, text=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            raise ValueError(f"{PROGRAM}: not done after {LONGEST} s") from None
        if done.returncode != 0:
            raise ValueError(done.stderr.strip() or f"{PROGRAM}: ended with status {done.returncode}")
        return load_recording(folder / "sim.csv").diabolo[1 : steps + 1]


def write_motion(file: Path, model: Model, start: State, tips: TipMotion, times: NDArray[np.float64]) -> None:
    """As `diabolo motion` does, with one start. times: of the rows [s]."""
    rows = np.column_stack([times, *tips.at(times)[:2]])
    header = ",".join(["time", *(f"{side}_{axis}" for side in ("left", "right") for axis in "xyz")])
    np.savetxt(file, rows, "%.17g", ",", header=header, comments="")
    body = DiaboloProperties.red()  # the world's
    begin = {"time": 0.0, "position": [*start.position], "velocity": [*start.velocity], "spin": start.spin}
    told = {
        "schema": "diabolo.recording/1",
        "diabolo": {name: getattr(body, name) for name in ("mass", "diameter", "length", "axle_radius")},
        "string_length": model.parameters.string_length,
        "rate": 1.0 / times[1],
        "units": "SI",
        "frame": "x forward, y left, z up",
        "starts": [begin],
    }
    file.with_suffix(".json").write_text(json.dumps(told), encoding="utf-8")


if __name__ == "__main__":
    options = Parser(description=__doc__, allow_abbrev=False)
    options.add_argument("--picture", type=output_name, help="draw the comparison")
    compared(simulate, "Gazebo", options.parse_args().picture, options)
