# SPDX-License-Identifier: MIT
"""Draws a bag that record.py wrote beside the plan that play.py played; needs no ROS 2 (docs/hosts.md).

python examples/ros2/draw.py take.mcap throw.csv ros2.png
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from diabolo import Recording, load_recording
from diabolo.checks import check_drawing
from diabolo.cli import Parser
from diabolo.cli.arguments import output_name
from diabolo.files import check_outputs, whole_file
from numpy.typing import NDArray


def time_of(recording: Recording) -> NDArray[np.float64]:
    """Since its first row [s]."""
    return recording.time - recording.time[0]


def apart(bag: Recording, plan: Recording) -> NDArray[np.float64]:
    """How far the bag's diabolo is from the plan's in each of its rows [m]; NaN where it was not heard."""
    planned = [np.interp(time_of(bag), time_of(plan), track) for track in plan.diabolo.T]
    distances: NDArray[np.float64] = np.linalg.norm(bag.diabolo - np.transpose(planned), axis=1)
    return distances


def draw(bag: Recording, plan: Recording, picture: Path) -> None:
    """The paths as the player sees them, and heights over time."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.2, 3.4), layout="constrained")
    paths, heights = figure.subplots(1, 2, sharey=True)
    for take, body, label, colour, width in (
        (plan, "diabolo", "planned", "#ffbf86", 5.0),
        (bag, "left", "left tip", "tab:red", 1.2),
        (bag, "right", "right tip", "tab:blue", 1.2),
        (bag, "diabolo", "the node's diabolo", "black", 1.0),
    ):
        track = getattr(take, body)
        paths.plot(track[:, 1], track[:, 2], color=colour, lw=width, label=label)
        heights.plot(time_of(take), track[:, 2], color=colour, lw=width)
    paths.set(xlabel="left [m]", ylabel="up [m]")
    paths.invert_xaxis()
    heights.set(xlabel="time [s]")
    figure.legend(
        *paths.get_legend_handles_labels(), frameon=False, fontsize=8, ncols=4, loc="outside upper center"
    )
    with whole_file(picture) as temporary:
        figure.savefig(temporary, dpi=80)


def main() -> None:
    parser = Parser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False
    )
    parser.add_argument("bag", metavar="TAKE.mcap", help="what record.py wrote")
    parser.add_argument("plan", metavar="PLAN.csv", help="what `diabolo plan` wrote")
    parser.add_argument("picture", metavar="OUT.png", type=output_name, help="what to draw")
    given = parser.parse_args()
    try:
        check_drawing(given.picture, "matplotlib")
        check_outputs([given.picture], [given.bag, given.plan])
        bag, plan = load_recording(given.bag), load_recording(given.plan)
        draw(bag, plan, Path(given.picture))
    except ValueError as error:
        parser.error(str(error))
    print(f"{given.picture}: {1e3 * np.nanmax(apart(bag, plan)):.1f} mm from the plan at most")


if __name__ == "__main__":
    main()
