# SPDX-License-Identifier: MIT
"""Hides what is known from the simulator and has it found; offers forms that no law has, and none may win."""

from __future__ import annotations

import argparse
import sys

from diabolo import Diagnosis, Model, Parameters, diagnose, load_recording

from ... import command

PLACEBOS = ("placebo_drag", "placebo_push")
SHORTER = 0.05  # of the string [m]


def model_with(own_string_length: bool = False, **parameters: float) -> Model:
    """The consistent model with other parameters."""
    return Model(parameters=Parameters(**parameters), own_string_length=own_string_length)


def shown(answer: Diagnosis) -> str:
    """What is claimed, with its first parameter."""
    return "; ".join(f"{effect.name} {effect.parameters[0].value:.4g}" for effect in answer.effects)


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser(
        "benchmarks.proof.real.controls",
        __doc__,
        "  python -m benchmarks.proof.real.controls data/recordings/{swing,hop}.csv",
    )
    parser.add_argument("recording", nargs="+", help="of one set-up; exit status 1 where one control fails")
    return parser


def act(given: argparse.Namespace) -> int:
    print("| hidden | expected | found | claimed in all |\n|---|---|---|---|")
    found = 0
    takes = [load_recording(file) for file in given.recording]
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
        hit = name in [effect.name for effect in answer.effects]
        found += hit
        verdict = ("yes" if hit else "no") if name else "-"
        print(f"| {what} | {name or '-'} | {verdict} | {shown(answer)} |", flush=True)
    won = 0
    for group in ([takes] if len(takes) > 1 else []) + [[take] for take in takes]:
        names = [row.name for row in diagnose(group).result.ladder]
        if not names:
            continue
        answer = diagnose(group, bank=[*names, "body_swap", *PLACEBOS])
        claimed = [name for name in PLACEBOS if name in [effect.name for effect in answer.effects]]
        won += len(claimed)
        told = " and ".join(take.name for take in group) if len(group) < 3 else f"all {len(group)}"
        print(
            f"| nothing, placebos in {told} | none | {', '.join(claimed) or 'none'} | {shown(answer)} |",
            flush=True,
        )
    return 0 if found == len(controls) - 1 and won == 0 else 1


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
