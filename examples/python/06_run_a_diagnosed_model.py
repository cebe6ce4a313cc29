# SPDX-License-Identifier: MIT
"""6. Run a diagnosed model: ask what the simulator leaves out of two recordings, add it, and predict a third.

The recordings come from the project's plant, whose string rubs on the axle and hangs between bending sticks.
"""

from pathlib import Path

import diabolo

RECORDINGS = Path(__file__).resolve().parents[2] / "data" / "recordings"

asked = [diabolo.load_recording(RECORDINGS / f"{name}.csv") for name in ("swing", "hop")]
diagnosis = diabolo.diagnose(asked)
print(diagnosis.sentence)
for effect in diagnosis.effects:
    for parameter in effect.parameters:
        print(f"  {effect.name}, {parameter.name}: {parameter.value:.3g} {parameter.ci90}")

other = diabolo.load_recording(RECORDINGS / "linear_acceleration.csv")
print(f"{other.name}, which was not looked at: mean error [m]")
curves = {}
for model in (diabolo.Model.consistent(), diagnosis.model):
    rows = diabolo.evaluate(other, model, starts_every=0.1).horizons
    curves[model.name] = {row.score.horizon: row.score.model.mean for row in rows if row.score.model}
    print(
        f"  {model.name}: " + ", ".join(f"{mean:.3f} after {h:g} s" for h, mean in curves[model.name].items())
    )

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    print("(pip install matplotlib to see a picture)")
else:
    figure, axes = plt.subplots(figsize=(7.0, 4.0), layout="constrained")
    for name, curve in curves.items():
        axes.plot(curve.keys(), [1000.0 * mean for mean in curve.values()], "o-", label=name)
    axes.set(xlabel="time predicted ahead [s]", ylabel="mean error [mm]", ylim=(0.0, None))
    axes.legend()
    figure.savefig("06_run_a_diagnosed_model.png", dpi=120)
    print("picture: 06_run_a_diagnosed_model.png")
