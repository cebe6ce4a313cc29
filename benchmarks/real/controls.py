# SPDX-License-Identifier: MIT
"""Hides something that is known from the simulator and asks whether the diagnosis of recordings finds it.

.venv/bin/python benchmarks/real/controls.py RECORDING...
"""

from __future__ import annotations

import argparse
import sys

from diabolo import Diagnosis, Model, Parameters, diagnose, load_recording

SHORTER = 0.05  # of the string [m]


def model_with(own_string_length: bool = False, **parameters: float) -> Model:
    """The consistent model with other parameters."""
    return Model(parameters=Parameters(**parameters), own_string_length=own_string_length)


def shown(answer: Diagnosis) -> str:
    """What is claimed, with its first parameter."""
    return "; ".join(f"{effect['name']} {effect['parameters'][0]['value']:.4g}" for effect in answer.effects)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", nargs="+")
    files = parser.parse_args().recording
    print("| hidden | expected | found | claimed in all |\n|---|---|---|---|")
    found = 0
    takes = [load_recording(file) for file in files]
    length = takes[0].string_length - SHORTER
    controls = [
        ("nothing", "", Model.consistent()),
        ("gravity: 7 m/s² in the simulator", "gravity_magnitude", model_with(gravity=7.0)),
        ("the spin's coupling to the string", "spin_coupling", model_with(spin_coupling=0.0)),
        (
            f"{1000 * SHORTER:.0f} mm of the string",
            "string_length",
            model_with(own_string_length=True, string_length=length),
        ),
    ]
    for what, name, base in controls:
        answer = diagnose(takes, base)
        hit = name in [effect["name"] for effect in answer.effects]
        found += hit
        verdict = ("yes" if hit else "no") if name else "-"
        print(f"| {what} | {name or '-'} | {verdict} | {shown(answer)} |", flush=True)
    return 0 if found == len(controls) - 1 else 1


if __name__ == "__main__":
    sys.exit(main())
