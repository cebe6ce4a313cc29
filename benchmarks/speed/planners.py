# SPDX-License-Identifier: MIT
"""The search along derivatives, the paper's random walk and scipy's differential evolution on drawn problems.

Evolution is left out where there is no scipy.

Each problem is an action with drawn goals, from its seed; limits and model are the defaults, or a model with
what a diagnosis finds. Cost is the paper's residual of what each found, at the reported step of 1 ms; time is
the processor's, on one core.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

import diabolo
import numpy as np
from diabolo import Model, Parameters, StickSpline, TipLimits, _core

from .. import command

NAMES = ("throw", "side_throw", "swing", "hop", "circular_acceleration")


def diagnosed() -> Model:
    """A model with every effect that a diagnosis of the authors' recordings or of the plant adds."""
    return Model(
        Parameters(spin_coupling=0.0),
        string_friction=diabolo.StringFriction(coefficient=0.25, spin_gain=4.0),
        string_elasticity=diabolo.StringElasticity.of_stiffness(1400.0, 10.0),
        stick_flex=diabolo.StickFlex(compliance=1.0 / 350.0, damping=3.0, tip_mass=0.011),
        finite_axle=diabolo.FiniteAxle(radius=0.0072),
        air=diabolo.Air(quadratic_drag=0.03),
        magnus_lift=diabolo.MagnusLift(coefficient=1e-3),
        spin_loss=diabolo.SpinLoss(air=1e-4),
    )


class Problem:
    def __init__(self, index: int, rng: np.random.Generator, model: Model) -> None:
        self.name = NAMES[index % len(NAMES)]
        self.model = model
        length = self.model.parameters.string_length
        left, right = _core.home_pose(self.name, length)
        self.start = _core.hanging_state(left, right, length, 100.0)
        throws = self.name in ("throw", "side_throw")
        height = float(rng.uniform(0.3, 1.0) if throws else rng.uniform(0.1, 0.3))
        sideways = float(rng.uniform(0.1, 0.4))
        self.action = _core.action(
            self.name, left, right, self.start, length, height=height, sideways=sideways
        )
        self.limits = TipLimits()

    def plan(self, solver: Any, evaluations: int = 10**6) -> tuple[float, float, float]:
        """Cost, processor time [s] and duration of the motion [s]."""
        began = time.process_time()
        plan = diabolo.plan(
            self.start,
            self.action.seed,
            self.action.goals,
            self.model,
            limits=self.limits,
            freedom=self.action.freedom,
            solver=solver,
            seconds=60.0,
            evaluations=evaluations,
        )
        return plan.cost, time.process_time() - began, plan.path.end - plan.path.begin

    def walk(self, seconds: float) -> float:
        """Cost of a walk of as many motions as fit into so much of the processor's time."""
        _, each, _ = self.plan("walk", 400)
        return self.plan("walk", max(1, round(400 * seconds / each)))[0]

    def evolve(self, seconds: float) -> float:
        """Scipy's differential evolution over the same control points and times."""
        from scipy.optimize import differential_evolution

        seed, freedom = self.action.seed, self.action.freedom
        times, left, right = np.array(seed.times), np.array(seed.left), np.array(seed.right)
        last = len(times) if freedom.last_point else len(times) - 1
        free = np.ix_(range(1, last), (1, 2))
        count = left[free].size

        def motion(x: np.ndarray[Any, Any]) -> StickSpline:
            moved_left, moved_right = left.copy(), right.copy()
            moved_left[free] += x[:count].reshape(left[free].shape)
            moved_right[free] += x[count : 2 * count].reshape(left[free].shape)
            durations = np.diff(times) * (1.0 + x[2 * count :])
            return StickSpline(np.concatenate([[0.0], np.cumsum(durations)]), moved_left, moved_right)

        def cost(x: np.ndarray[Any, Any]) -> float:
            value = _core.plan_cost([self.model], self.start, motion(x), self.action.goals, self.limits, 4e-3)
            return value if np.isfinite(value) else 1e3

        bounds = [(-0.1, 0.1)] * (2 * count) + [(-0.15, 0.15)] * (len(times) - 1)
        end = time.process_time() + seconds
        found = differential_evolution(
            cost,
            bounds,
            rng=np.random.default_rng(1),
            popsize=4,
            maxiter=10_000,
            polish=False,
            tol=0.0,
            x0=np.zeros(len(bounds)),
            callback=lambda *_, **__: time.process_time() >= end,
        )
        return float(
            _core.plan_cost([self.model], self.start, motion(found.x), self.action.goals, self.limits, 1e-3)
        )


def make_parser() -> argparse.ArgumentParser:
    parser = command.make_parser(
        "benchmarks.speed.planners", __doc__, "  python -m benchmarks.speed.planners --problems 4 --effects"
    )
    parser.add_argument("--problems", type=int, default=20)
    parser.add_argument(
        "--longer", type=float, default=50.0, help="times that the walk gets in its second run"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--effects", action="store_true", help="on a model with all that a diagnosis finds")
    return parser


def act(given: argparse.Namespace) -> int:
    try:
        import scipy
    except ModuleNotFoundError:
        scipy = None  # type: ignore[assignment]
    rng = np.random.default_rng(given.seed)
    print(
        "problem                 time [ms]  per s of motion  gradient  walk, same time  walk, 50 x   evolved"
    )
    rows = []
    model = diagnosed() if given.effects else Model(Parameters())
    for index in range(given.problems):
        problem = Problem(index, rng, model)
        best, took, duration = problem.plan("gradient")
        same, longer = problem.walk(took), problem.walk(given.longer * took)
        evolved = np.nan if scipy is None else problem.evolve(given.longer * took)
        rows.append((1e3 * took, 1e3 * took / duration, best, same, longer, evolved))
        costs = " ".join(f"{cost:13.5f}" for cost in rows[-1][2:])
        print(f"{index:3d}  {problem.name:22s} {rows[-1][0]:6.0f} {rows[-1][1]:13.0f} {costs}", flush=True)
    values = np.array(rows)
    speed, best, same, longer = values[:, 1], values[:, 2], values[:, 3], values[:, 4]
    print(
        f"median {np.median(speed):.0f} ms per second of motion, {np.sum(speed <= 50.0)} of {len(rows)} "
        f"within 50 ms; cost at least 10 times below the walk's in the same time in "
        f"{np.sum(same >= 10.0 * best)}, median ratio {np.median(same / best):.0f}; not above the walk's in "
        f"{given.longer:g} times the time in {np.sum(best <= longer)}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(command.run(make_parser(), act))
