# SPDX-License-Identifier: MIT
"""What MuJoCo's own string lacks: a simulator that knows nothing of this library, beside recordings.

MuJoCo's string is a spatial tendon with a limit of its length, from tip to tip through the diabolo's centre,
as one would write it: two mocap bodies for the tips, a free body for the diabolo. `simulate` plays it from a
start while the tips move; `diabolo.compare_simulator` does the rest. The report's first table says, law by
law, what reality has and MuJoCo has not, and what MuJoCo has and should not have.

    pip install '.[mujoco,plot]'
    python examples/mujoco/what_mujoco_lacks.py data/recordings/swing.csv --out mujoco.html
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import diabolo
import numpy as np
from diabolo.cli import Parser
from diabolo.cli.arguments import output_name
from diabolo.files import check_outputs, write_texts
from diabolo.report import report_html
from diabolo.view import replay_of
from numpy.typing import NDArray

try:
    import mujoco
except ModuleNotFoundError as error:
    print(f"what_mujoco_lacks.py: {error}; expected it from: pip install 'diabolo[mujoco]'", file=sys.stderr)
    sys.exit(2)

DT = 1e-3  # [s]
INERTIA = (5.6e-4, 6.6e-4, 6.6e-4)  # of the paper's red diabolo, about and across the axle [kg m^2]


def model_text(mass: float, string_length: float) -> str:
    tips = "".join(
        f'<body name="{name}" mocap="true"><site name="{name}"/></body>' for name in ("left", "right")
    )
    inertia = " ".join(map(str, INERTIA))
    return f"""<mujoco>
  <option timestep="{DT}" gravity="0 0 -9.80665"/>
  <worldbody>{tips}
    <body name="diabolo"><freejoint/><site name="diabolo"/>
      <inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia}"/>
    </body>
  </worldbody>
  <tendon><spatial limited="true" range="0 {string_length}">
    <site site="left"/><site site="diabolo"/><site site="right"/>
  </spatial></tendon>
</mujoco>"""


class Tendon:
    """A simulator as `diabolo.compare_simulator` asks for it."""

    def __init__(self, mass: float, string_length: float) -> None:
        self.model = mujoco.MjModel.from_xml_string(model_text(mass, string_length))

    def __call__(
        self, start: NDArray[np.float64], tips: diabolo.TipMotion, times: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        data = mujoco.MjData(self.model)
        data.qpos[:3] = start[:3]
        data.qvel[:] = [*start[3:6], -start[6], 0.0, 0.0]  # positive spin turns about -x
        steps = np.arange(int(np.ceil(times[-1] / DT)) + 1) * DT
        left, right, _, _ = tips.at(steps)
        states = np.empty((len(steps), 7))
        for i in range(len(steps)):
            states[i] = [*data.qpos[:3], *data.qvel[:3], -data.qvel[3]]
            data.mocap_pos[:] = left[i], right[i]
            mujoco.mj_step(self.model, data)
        return np.column_stack([np.interp(times, steps, column) for column in states.T])


def compared(paths: Sequence[str], report: Path | None) -> None:
    """Prints what MuJoCo lacks beside these recordings, and writes the report."""
    check_outputs([report], paths)
    takes = [diabolo.load_recording(path) for path in paths]
    tendon = Tendon(takes[0].properties.mass, takes[0].string_length)
    comparison = diabolo.compare_simulator(takes, tendon)
    print(comparison.sentence)
    fit = comparison.result.fit
    for ahead, alone, better in zip(fit.horizons_s, fit.base_error_m, fit.augmented_error_m, strict=True):
        if alone is not None and better is not None:
            print(f"  {ahead:4g} s ahead: {1e3 * alone:6.1f} mm -> {1e3 * better:6.1f} mm")
    if report:
        base = diabolo.Model.named("consistent")
        replays = [replay_of(take, base, comparison.real.model) for take in takes]
        write_texts({report: report_html(comparison.real.to_dict(), comparison.to_dict(), replays)})


def main() -> int:
    parser = Parser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False
    )
    parser.add_argument("recordings", nargs="+", help="of one diabolo and string")
    parser.add_argument("--out", type=output_name, help="the report, an HTML file")
    arguments = parser.parse_args()
    try:
        compared(arguments.recordings, Path(arguments.out) if arguments.out else None)
    except (ValueError, OSError) as error:
        print(f"what_mujoco_lacks.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
