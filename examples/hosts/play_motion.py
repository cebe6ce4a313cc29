# SPDX-License-Identifier: MIT
"""What a host of this folder does: compared with the predictor, or playing what `diabolo motion` wrote."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from beside_the_predictor import compare, draw
from diabolo import DiaboloProperties, Model, Parameters, Recording, RecordingError, State, TipMotion
from diabolo.checks import check_drawing
from diabolo.cli import Parser
from diabolo.cli.arguments import output_name
from diabolo.files import check_outputs
from diabolo.robot import load_tip_plan
from numpy.typing import NDArray

Simulate: TypeAlias = Callable[[Model, State, TipMotion, float, int], NDArray[np.float64]]
"""`simulate(model, start, tips, dt, steps)` gives the places after each step, (steps, 3) [m]."""
DT = 1e-3
"""About how long a step is; a whole number of them lies between two starts [s]."""


def main(simulate: Simulate, host: str) -> None:
    parser = Parser(description=__doc__, allow_abbrev=False)
    parser.add_argument("motion", nargs="?", type=Path, help="what `diabolo motion` wrote; default: compare")
    parser.add_argument("out", nargs="?", type=output_name, help="the recording to write, for --simulated")
    parser.add_argument("--picture", type=output_name, help="draw the comparison")
    arguments = parser.parse_args()
    if arguments.motion is None:
        return compared(simulate, host, arguments.picture, parser)
    if arguments.picture is not None:
        parser.error("--picture is of the comparison; expected no MOTION.csv")
    if arguments.out is None:
        parser.error("MOTION.csv without SIM.csv; expected both")
    out = Path(arguments.out)
    try:
        check_outputs([out, out.with_suffix(".json")], [arguments.motion])
        recorded(simulate, arguments.motion).save(out)
    except ValueError as error:
        parser.error(str(error))


def compared(simulate: Simulate, host: str, picture: str | None, parser: Parser) -> None:
    try:
        if picture:
            check_drawing(picture, "matplotlib")
            check_outputs([picture], [])
        found = compare(simulate)
        if picture:
            draw(found, host, Path(picture))
    except ValueError as error:
        parser.error(str(error))


def recorded(simulate: Simulate, motion: Path) -> Recording:
    """What is played of a motion; raises ValueError with the file that is none."""
    expected = "expected what `diabolo motion` writes"
    try:
        return played(simulate, motion)
    except OSError as error:
        raise ValueError(f"{error.filename}: {error.strerror}; {expected}") from error
    except RecordingError as error:
        raise ValueError(f"{error}; {expected}") from error
    except (ValueError, KeyError, TypeError, IndexError) as error:
        why = f"no field {error}" if isinstance(error, KeyError) else error
        raise ValueError(f"{motion.with_suffix('.json')}: {why}; {expected}") from error


def played(simulate: Simulate, motion: Path) -> Recording:
    """A string without friction or stretch in the host, from each start to the next."""
    told = json.loads(motion.with_suffix(".json").read_text(encoding="utf-8"))
    tips, properties, starts = load_tip_plan(motion), DiaboloProperties(**told["diabolo"]), told["starts"]
    body = Parameters(
        mass=properties.mass, axle_radius=properties.axle_radius, string_length=told["string_length"]
    )
    edges = [*(start["time"] for start in starts), tips.end]
    if not starts or edges[0] < tips.begin or not (np.diff(edges) > 0.0).all():
        raise ValueError(f"starts at {edges[:-1]} s; expected some, one after another, within the motion")
    pieces = [
        piece(simulate, Model(body), start, tips, end) for start, end in zip(starts, edges[1:], strict=True)
    ]
    time, places = (np.concatenate(part) for part in zip(*pieces, strict=True))
    left, right, *_ = tips.at(time)
    return Recording(
        time - time[0],
        left,
        right,
        places,
        1.0 / DT,
        name=motion.stem,
        properties=properties,
        string_length=body.string_length,
    )


def piece(
    simulate: Simulate, model: Model, start: dict[str, Any], tips: TipMotion, end: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times [s], (N,), and places [m], (N, 3), from a start to before `end`."""
    count = max(1, round((end - start["time"]) / DT))
    time = np.linspace(start["time"], end, count, endpoint=False)
    moved = TipMotion(time - time[0], *tips.at(time)[:2], "spline")
    state = State(start["position"], start["velocity"], start["spin"], "loose")
    path = simulate(model, state, moved, (end - start["time"]) / count, count - 1)
    return time, np.vstack([start["position"], path])
