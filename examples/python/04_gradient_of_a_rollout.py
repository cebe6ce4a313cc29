# SPDX-License-Identifier: MIT
"""4. Gradient of a rollout: ask which way the start would have to change for a prediction to come true.

The prediction of half a second from step 3 misses the recorded diabolo. Derivatives of its end with respect
to the start's velocity and to the string's length tell what each could do about it, and Gauss and Newton's
method finds the smallest change that does.
"""

from pathlib import Path

import diabolo
import numpy as np

RECORDINGS = Path(__file__).resolve().parents[2] / "data" / "recordings"
START, END = 300, 360  # rows of the recording, half a second apart
DT = 1e-3  # [s]

recording = diabolo.load_recording(RECORDINGS / "swing.csv")
tips = diabolo.TipMotion.of_recording(recording)  # its time begins at row 0
start = diabolo.start_state(recording, START)
begin = (recording.time[START] - recording.time[0]).item()
target = recording.diabolo[END]


half_second = {
    "dt": DT,
    "steps": round((recording.time[END] - recording.time[START]) / DT),
    "begin": begin,
    "string_state": start.string_state,
}


def model_and_start(velocity: np.ndarray, string_length: float) -> tuple[diabolo.Parameters, np.ndarray]:
    parameters = diabolo.Parameters(string_length=string_length, mass=recording.properties.mass)
    return parameters, np.concatenate([start.position, velocity, [start.spin]])


def differentiate(velocity: np.ndarray, string_length: float) -> diabolo.RolloutGradient:
    """Half a second from the start, and its derivatives."""
    inputs = model_and_start(velocity, string_length)
    return diabolo.rollout_gradient(*inputs, tips, ["velocity", "string_length"], **half_second)


velocity, string_length = start.velocity, recording.string_length
misses, tracks = [], []
for iteration in range(5):
    end = differentiate(velocity, string_length)
    miss = target - end.state[:3]
    misses.append(float(np.linalg.norm(miss)))
    tracks.append(diabolo.rollout(*model_and_start(velocity, string_length), tips, **half_second).states)
    print(f"iteration {iteration}: the end is off by {1000.0 * misses[-1]:8.3f} mm")
    by_velocity, by_length = end.derivatives["velocity"][:3], end.derivatives["string_length"][:3]
    if iteration == 0:
        print("  the end's sideways position per sideways velocity at the start:", end=" ")
        print(f"{by_velocity[1, 1]:.3f} m per m/s")
        print(f"  the end's height per string length: {by_length[2]:.3f} m per m")
    # Four unknowns for three numbers: lstsq gives the smallest change that does, 1 m/s counting like 1 m.
    change, *_ = np.linalg.lstsq(np.column_stack([by_velocity, by_length]), miss, rcond=None)
    velocity, string_length = velocity + change[:3], string_length + change[3]

print(f"velocity of the start changed by {np.round(velocity - start.velocity, 3)} m/s,")
print(f"string length by {1000.0 * (string_length - recording.string_length):.1f} mm")

# The same derivative by a difference of two rollouts.
step = np.array([0.0, 1e-6, 0.0])
pair = [differentiate(start.velocity + sign * step, recording.string_length).state for sign in (1.0, -1.0)]
difference = (pair[0] - pair[1])[:3] / 2e-6
derivative = differentiate(start.velocity, recording.string_length).derivatives["velocity"][:3, 1]
print(f"derivative {np.round(derivative, 6)}, difference {np.round(difference, 6)}")

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    print("(pip install matplotlib to see a picture)")
else:
    figure, (where, how_far) = plt.subplots(1, 2, figsize=(9.0, 4.0), layout="constrained")
    where.plot(*recording.diabolo[START : END + 1, 1:].T, color="black", label="measured")
    where.plot(*target[1:], "o", color="black", label="where it ends")
    for number, (name, color) in enumerate((("as measured", "tab:orange"), ("after one step", "tab:blue"))):
        where.plot(*tracks[number][:, 1:3].T, color=color, label=f"predicted, start {name}")
    where.set(title="Seen from behind the player", xlabel="y, to the left [m]", ylabel="z, up [m]")
    where.invert_xaxis()
    where.legend(fontsize="small")
    how_far.semilogy(range(len(misses)), misses, "o-")
    how_far.set(title="How far the end is off", xlabel="iteration", ylabel="distance [m]")
    how_far.set_xticks(range(len(misses)))
    how_far.grid(alpha=0.3)
    figure.savefig("04_gradient_of_a_rollout.png", dpi=120)
    print("picture: 04_gradient_of_a_rollout.png")
