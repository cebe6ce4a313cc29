# SPDX-License-Identifier: MIT
"""1. Drop and catch: let go of the diabolo above a loose string, and see the string catch it.

Both hands rest. The diabolo falls freely until the string is taut, loses its speed along the string, and
swings on the ellipse that the taut string leaves it.
"""

import math

import diabolo
import numpy as np

GRAVITY = 9.80665  # [m/s^2]
LEFT, RIGHT = (
    np.array([0.0, 0.35, 1.0]),
    np.array([0.0, -0.35, 1.0]),
)  # stick tips [m]: x forward, y left, z up
DT = 1e-3  # [s]

parameters = diabolo.Parameters(string_length=1.45)
predictor = diabolo.Predictor(parameters)
state = diabolo.State(position=[0.0, 0.10, 1.0])  # at the height of the tips, 10 cm left of the middle

track = [state.position]
for step in range(1, 2001):
    speed_before = np.linalg.norm(state.velocity)
    status = predictor.step(state, LEFT, RIGHT, LEFT, RIGHT, DT)
    track.append(state.position)
    if status.snapped_taut:
        caught_at = step * DT
        print(f"caught after {caught_at:.3f} s: {speed_before:.2f} m/s before, ", end="")
        print(f"{np.linalg.norm(state.velocity):.2f} m/s after")
positions = np.array(track)
time = DT * np.arange(len(positions))

# What the laws of motion say: free fall to the ellipse |p - left| + |p - right| = L.
spheroid = diabolo.Spheroid(LEFT, RIGHT, parameters.string_length)
depth = spheroid.semi_minor * math.sqrt(1.0 - (0.10 / spheroid.semi_major) ** 2)
print(f"free fall over {depth:.3f} m takes {math.sqrt(2.0 * depth / GRAVITY):.3f} s")

swing = positions[time > caught_at + DT]
excess = spheroid.path_length(swing) - parameters.string_length
print(f"then it swings from {swing[:, 1].min():+.3f} to {swing[:, 1].max():+.3f} m sideways;")
print(f"the string stays within {np.abs(excess).max():.1e} m of its length")

try:
    import matplotlib.pyplot as plt
except ModuleNotFoundError:
    print("(pip install matplotlib to see a picture)")
else:
    figure, (side, height) = plt.subplots(1, 2, figsize=(9.0, 4.0), layout="constrained")
    angle = np.linspace(math.pi, 2.0 * math.pi, 200)
    side.plot(
        -spheroid.semi_major * np.cos(angle),
        1.0 + spheroid.semi_minor * np.sin(angle),
        ":",
        color="gray",
        label="taut string",
    )
    side.plot(positions[:, 1], positions[:, 2], label="diabolo")
    side.plot(
        *np.array([LEFT, positions[-1], RIGHT])[:, 1:].T, "-", color="gray", lw=1.0, label="string at the end"
    )
    side.plot([LEFT[1], RIGHT[1]], [1.0, 1.0], "o", color="black", label="stick tips")
    side.set(
        title="Seen from behind the player", xlabel="y, to the left [m]", ylabel="z, up [m]", aspect="equal"
    )
    side.invert_xaxis()
    side.legend(loc="upper center", ncols=2, fontsize="small")
    side.set_ylim(0.25, 1.45)
    height.plot(time, positions[:, 2])
    height.axvline(caught_at, color="gray", ls="--", label="the string comes taut")
    height.set(title="Height", xlabel="time [s]", ylabel="z [m]")
    height.legend()
    figure.savefig("01_drop_and_catch.png", dpi=120)
    print("picture: 01_drop_and_catch.png")
