# SPDX-License-Identifier: MIT
"""What an agent may be trained on, for a plant: the model that a diagnosis found, models that its recordings
cannot distinguish from that one, and models drawn from a wide range.

OUT gets folders of model files: `point` with one, `posterior` and `wide` with 64 each, and `sealed` with the
first sixteen of the posterior, which the package has for the difficulty of that name. The plant plays
30 s, filmed, and is diagnosed. `wide` knows the string's length, the diabolo's inertia and what damps the
string and the sticks.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import diabolo
import numpy as np
from diabolo import Model

from .. import command
from ..proof import plant as program
from ..proof.player.plant import Plant

EXAMPLE = """\
  make plant && python -m benchmarks.learning.models OUT
  diabolo train ThrowAndCatch --model OUT/posterior/*.json --steps 9000000 --out posterior
  python -m benchmarks.learning.on_plant --around 0.2 --agent posterior/agent.json"""
COUNT, SEALED = 64, 16


def main(arguments: Sequence[str] | None = None) -> int:
    parser = command.make_parser("benchmarks.learning.models", __doc__, EXAMPLE)
    parser.add_argument("out", metavar="OUT", type=Path, help="folder to write; a new one")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the wide range; default: 1")
    program.add_option(parser)
    return command.run(parser, run, arguments)


def run(given: argparse.Namespace) -> int:
    program.check(given.plant)
    if given.out.exists():
        raise ValueError(f"{given.out}: is there; expected a new folder")
    plant = Plant(given.plant)
    takes = plant.practice()
    found = diabolo.diagnose(takes, draws=COUNT)
    if found.headline == "INSUFFICIENT_DATA":
        raise ValueError(found.sentence)
    print(found.sentence)
    rng = np.random.default_rng(given.seed)
    models = {
        "point": [diabolo.model_for(found.model, takes[0])],
        "posterior": [diabolo.model_for(one, takes[0]) for one in found.models],
        "wide": [wide(plant.length, rng) for _ in range(COUNT)],
    }
    for name, ones in models.items():
        (given.out / name).mkdir(parents=True)
        for number, model in enumerate(ones):
            (given.out / name / f"{number:02d}.json").write_text(model.to_json(), encoding="utf-8")
        print(f"{given.out / name}: {len(ones)}")
    (given.out / "sealed").mkdir()
    for path in sorted((given.out / "posterior").iterdir())[:SEALED]:
        text = sealed(json.loads(path.read_text(encoding="utf-8")), f"sealed {path.stem}")
        (given.out / "sealed" / path.name).write_text(text, encoding="utf-8")
    return 0


def sealed(model: dict[str, Any], name: str) -> str:
    """A model file without what it takes from recordings, in six digits."""
    kept = {key: value for key, value in model.items() if key != "from_recording"} | {"name": name}
    return json.dumps(rounded(kept)) + "\n"


def rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    return float(f"{value:.6g}") if isinstance(value, float) else value


def wide(length: float, rng: np.random.Generator) -> Model:
    """Each number anywhere that a diabolo, a string and sticks may have it."""
    return Model(
        diabolo.Parameters(string_length=length, spin_coupling=0.0),
        name="wide",
        string_friction=diabolo.StringFriction(coefficient=rng.uniform(0.05, 0.5), spin_gain=3.4),
        string_elasticity=diabolo.StringElasticity(compliance=rng.uniform(0.0, 0.003), damping=10.0),
        stick_flex=diabolo.StickFlex(compliance=rng.uniform(0.0, 0.006), damping=3.0),
        air=diabolo.Air(quadratic_drag=rng.uniform(0.0, 0.08)),
        magnus_lift=diabolo.MagnusLift(coefficient=rng.uniform(0.0, 0.002)),
    )


if __name__ == "__main__":
    sys.exit(main())
