# SPDX-License-Identifier: MIT
"""3. Replay a recording: predict a recorded diabolo from the recorded stick tips.

The recording comes from the project's plant, a simulator with friction, an elastic string and a camera's
noise, none of which the predictor knows. Every half second it starts again from what was measured.
"""

from pathlib import Path

import diabolo
import numpy as np

RECORDINGS = Path(__file__).resolve().parents[2] / "data" / "recordings"
PIECE = 60  # rows, half a second

recording = diabolo.load_recording(RECORDINGS / "swing.csv")
print(f"{recording.name}: {len(recording)} samples at {recording.rate:.0f} Hz")

predicted = np.full_like(recording.diabolo, np.nan)
for row in range(PIECE, len(recording) - PIECE, PIECE):
    try:
        piece = diabolo.predict(recording.cut(0, row + PIECE - 1), "consistent", row=row, start="fair")
    except ValueError:
        continue  # the diabolo is not seen there, or was not for long enough before
    predicted[row : row + PIECE] = piece.states[row:, :3]
errors = np.linalg.norm(predicted - recording.diabolo, axis=1)
lowest = np.linalg.norm(diabolo.baseline(recording) - recording.diabolo, axis=1)
both = ~np.isnan(errors)
print(f"within half a second of a start the mean error is {100 * errors[both].mean():.1f} cm;")
print(f"that of a diabolo at the lowest point of the string would be {100 * lowest[both].mean():.1f} cm")

print("from a start each 0.1 s:  after   mean error   95 % interval of the mean [m]")
for row in diabolo.evaluate(recording, "consistent", starts_every=0.1).horizons:
    score = row.score
    if score.model is not None:
        print(
            f"{score.horizon:29.2f} s {score.model.mean:12.3f}   {score.model.mean_ci95 or 'too few starts'}"
        )

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    print("(pip install matplotlib to see a picture)")
else:
    time = recording.time - recording.time[0]
    figure, axes = plt.subplots(3, 1, figsize=(9.0, 7.0), sharex=True, layout="constrained")
    for panel, axis, name in ((axes[0], 1, "y, to the left [m]"), (axes[1], 2, "z, up [m]")):
        panel.plot(time, recording.diabolo[:, axis], color="black", label="measured")
        for row in range(PIECE, len(recording) - PIECE, PIECE):
            label = "predicted, half a second at a time" if row == PIECE else None
            panel.plot(
                time[row : row + PIECE], predicted[row : row + PIECE, axis], color="tab:blue", label=label
            )
        panel.set_ylabel(name)
    axes[0].legend(loc="upper left", ncols=2)
    axes[0].set_ylim(top=0.65)
    axes[2].plot(time, errors, color="tab:blue", label="predicted")
    axes[2].plot(time, lowest, "--", color="0.5", lw=1.0, label="lowest point of the string")
    axes[2].set(ylabel="error [m]", xlabel="time [s]")
    axes[2].legend(loc="upper left", ncols=2)
    axes[2].set_ylim(0.0, 0.65)
    figure.savefig("03_replay_a_recording.png", dpi=120)
    print("picture: 03_replay_a_recording.png")
