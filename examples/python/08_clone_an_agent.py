# SPDX-License-Identifier: MIT
"""8. Clone an agent: record what the agent of the package sees and does, learn to do the same, and play both.

This is behaviour cloning without a learning library: a layer at random, and a layer by least squares.
"""

from pathlib import Path

import numpy as np
from diabolo.envs import Agent, Transition, play, shipped_agent

FEATURES = 512
RIDGE = 1e-3

teacher = shipped_agent("SpinUp")
plays: list[Transition] = []
play(teacher, 50, seed=0, keep=plays.append)
seen = np.concatenate([one.observations for one in plays])
done = np.concatenate([one.actions for one in plays])
print(f"recorded: {len(seen)} moments of 50 episodes")

random = np.random.default_rng(8)
mean, spread = seen.mean(axis=0), seen.std(axis=0) + 1e-3
weights = 0.3 * random.normal(size=(FEATURES, seen.shape[1])) / np.sqrt(seen.shape[1]) / spread
bias = random.uniform(-1.0, 1.0, FEATURES) - weights @ mean
features = np.column_stack([np.tanh(seen @ weights.T + bias), np.ones(len(seen))])
normal = features.T @ features + RIDGE * np.eye(FEATURES + 1)
output = np.linalg.solve(normal, features.T @ done).T

layers = [(weights, bias), (output[:, :-1], output[:, -1])]
clone = Agent(teacher.tasks, teacher.period, teacher.steps, layers)
Path("08_clone_an_agent.json").write_text(clone.to_json(), encoding="utf-8")
print("agent: 08_clone_an_agent.json")

gained = {}
for name, agent in (("teacher", teacher), ("clone", Agent.load("08_clone_an_agent.json"))):
    outcomes = play(agent, 200, seed=1000)  # episodes that were not recorded
    gained[name] = outcomes["spin"] - outcomes["first_spin"]
    drops = np.count_nonzero(outcomes["dropped"])
    middle, least = np.median(gained[name]), gained[name].min()
    print(f"{name}: gains {middle:.1f} rad/s (median of 200 episodes, least {least:.0f}), drops {drops}")

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    print("(pip install matplotlib to see a picture)")
else:
    figure, axes = plt.subplots(figsize=(5.0, 4.0), layout="constrained")
    axes.plot(gained["teacher"], gained["clone"], ".")
    axes.set(xlabel="spin that the teacher gains [rad/s]", ylabel="spin that its clone gains [rad/s]")
    figure.savefig("08_clone_an_agent.png", dpi=120)
    print("picture: 08_clone_an_agent.png")
