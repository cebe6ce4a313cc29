# SPDX-License-Identifier: MIT
"""9. Estimate by a slow camera: every fourth frame of a recording, told 50 ms late, against all the others.

The estimator knows the tips, friction and a bounce. It says where the diabolo is now, and how sure that is.
    python 09_estimate_by_a_slow_camera.py [RECORDING]
"""

import sys
from pathlib import Path

import diabolo
import numpy as np
from diabolo.estimate import Estimator, ProcessNoise, Spread

RECORDINGS = Path(__file__).resolve().parents[2] / "data" / "recordings"
EVERY, LATE, NOISE = 4, 0.05, 2e-3  # rows, [s], [m]
DT = 1 / 500  # [s]

recording = diabolo.load_recording(sys.argv[1] if len(sys.argv) > 1 else RECORDINGS / "swing.csv")
model = diabolo.model_for(
    diabolo.Model(
        diabolo.Parameters(spin_coupling=0.0, catch_slack=0.9),
        string_friction=diabolo.StringFriction(coefficient=0.3, spin_gain=3.8),
        landing_restitution=diabolo.LandingRestitution(coefficient=0.2),
    ),
    recording,
)
tips = diabolo.TipMotion.of_recording(recording)
seen = np.flatnonzero(~np.isnan(recording.diabolo[:, 0]))
first = next(row for row in seen if row >= 12 and not np.isnan(recording.diabolo[row - 12 : row, 0]).any())
start = diabolo.start_state(recording, first, "fair")
start.string_state = "on_string"

clock = recording.time - recording.time[0]
begin = clock[first]
steps = int((clock[-1] - begin) / DT)
left, right, *velocities = tips.at(begin)
spread = Spread(0.01, 0.2, 20.0, 0.1)
noise = ProcessNoise(acceleration=0.3, string_length=0.01)  # the sticks bend, which the model does not know
estimator = Estimator(model, start, (left, right), time=begin, spread=spread, noise=noise)
frames = [(clock[row], recording.diabolo[row]) for row in seen if row > first and row % EVERY == 0]
time, place, deviation = [], [], []
for i in range(1, steps + 1):
    left, right, *velocities = tips.at(begin + i * DT)
    estimator.step(left, right, dt=DT, velocities=velocities)
    while frames and frames[0][0] + LATE <= estimator.now.time:
        estimator.camera(*frames.pop(0), noise=NOISE)
    now = estimator.now
    time.append(now.time)
    place.append(now.state.position)
    deviation.append(now.deviations[:3])

unseen = [row for row in seen if row > first and row % EVERY and clock[row] <= time[-1]]
at = np.clip(np.searchsorted(time, clock[unseen]), 0, len(time) - 1)
error = np.array(place)[at] - recording.diabolo[unseen]
inside = np.abs(error) < 1.645 * np.array(deviation)[at]
print(f"{recording.name}: {len(unseen)} frames that the camera did not tell of")
print(f"the estimate is off by {1e3 * np.median(np.linalg.norm(error, axis=1)):.1f} mm in the median")
print(f"its 90 % intervals hold {100 * inside.mean():.0f} % of the coordinates")

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    print("(pip install matplotlib to see a picture)")
else:
    figure, axes = plt.subplots(2, 1, figsize=(9.0, 5.0), sharex=True, layout="constrained")
    for panel, axis, name in zip(axes, (1, 2), ("y, to the left [m]", "z, up [m]"), strict=True):
        middle, half = np.array(place)[:, axis], 1.645 * np.array(deviation)[:, axis]
        panel.fill_between(time, middle - half, middle + half, color="tab:blue", alpha=0.3, label="90 %")
        panel.plot(time, middle, color="tab:blue", label="estimated")
        panel.plot(clock, recording.diabolo[:, axis], color="black", lw=0.8, label="measured")
        panel.set_ylabel(name)
    axes[0].legend(loc="upper left", ncols=3)
    axes[1].set_xlabel("time [s]")
    figure.savefig("09_estimate_by_a_slow_camera.png", dpi=120)
    print("picture: 09_estimate_by_a_slow_camera.png")
