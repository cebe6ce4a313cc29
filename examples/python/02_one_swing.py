# SPDX-License-Identifier: MIT
"""2. One swing: move both hands sideways once, and see how far the diabolo swings.

The hands go 10 cm to the left and stay there; the diabolo, which hung still, swings on. How far depends on
how long the hands took, so the example tries 200 durations in one call.
"""

import diabolo
import numpy as np

SIDEWAYS, HALF_SPAN, HEIGHT = 0.10, 0.25, 1.2  # [m]
TIME = np.linspace(0.0, 6.0, 601)  # [s]


def sway(duration: float) -> diabolo.TipMotion:
    """Both tips to the left within `duration` [s], smoothly (rest, constant jerk, rest)."""
    s = np.clip(TIME / duration, 0.0, 1.0)
    y = SIDEWAYS * s**2 * (3.0 - 2.0 * s)
    still = np.zeros_like(y)
    left = np.stack([still, y + HALF_SPAN, still + HEIGHT], axis=1)
    right = np.stack([still, y - HALF_SPAN, still + HEIGHT], axis=1)
    return diabolo.TipMotion(TIME, left, right, "spline")


parameters = diabolo.Parameters(string_length=1.45)
durations = np.linspace(0.2, 3.0, 200)
motions = [sway(duration) for duration in durations]

hanging = diabolo.hang_at_rest(parameters, motions[0].left[0], motions[0].right[0])
initial = np.concatenate([hanging.position, [0.0, 0.0, 0.0], [100.0]])  # position, velocity, spin

swings = diabolo.rollout(
    parameters, initial, motions, dt=1e-3, steps=6000, record_every=10, string_state="on_string"
)
print(f"{swings.states.shape[0]} rollouts of {swings.time[-1]:.0f} s each: states {swings.states.shape}")

# Once the hands rest, the swing has the width that it will keep: nothing takes energy from it.
at_rest = swings.time > durations[-1]
sideways = swings.states[:, at_rest, 1] - SIDEWAYS
amplitude = 0.5 * (sideways.max(axis=1) - sideways.min(axis=1))
fastest, calmest = amplitude[0], int(amplitude.argmin())
print(f"hands that take {durations[0]:.2f} s leave a swing of +-{100 * fastest:.1f} cm,")
print(f"the calmest ones take {durations[calmest]:.2f} s: +-{100 * amplitude[calmest]:.1f} cm")
crossings = np.flatnonzero((sideways[0][:-1] < 0.0) & (sideways[0][1:] >= 0.0))
period = np.diff(swings.time[at_rest][crossings]).mean()
print(f"a period takes {period:.2f} s; a linear pendulum is calm after 1.430 of them: {1.430 * period:.2f} s")

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    print("(pip install matplotlib to see a picture)")
else:
    figure, (track, width) = plt.subplots(1, 2, figsize=(9.0, 4.0), layout="constrained")
    for index, name in ((0, "fast hands"), (calmest, "calm hands")):
        (line,) = track.plot(swings.time, swings.states[index, :, 1], label=f"diabolo, {name}")
        hands = motions[index].at(swings.time)[0][:, 1] - HALF_SPAN
        track.plot(swings.time, hands, ":", color=line.get_color(), label="middle of the tips")
    track.set(title="Sideways", xlabel="time [s]", ylabel="y, to the left [m]")
    track.legend(fontsize="small", loc="upper right", ncols=2)
    track.set_ylim(-0.01, 0.26)
    width.plot(durations, amplitude)
    width.set(title="Swing that is left", xlabel="duration of the hands' motion [s]", ylabel="amplitude [m]")
    width.set_ylim(bottom=0.0)
    figure.savefig("02_one_swing.png", dpi=120)
    print("picture: 02_one_swing.png")
