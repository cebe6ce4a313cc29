# SPDX-License-Identifier: MIT
"""A baseline: sparse regression of the acceleration that the simulator leaves over (SINDy).

Brunton, Proctor, Kutz (PNAS 2016), by sequentially thresholded least squares: the recorded track is
differentiated twice, gravity and, on the taut string, the string's own direction are taken away, and what
remains is explained by as few of a list of terms as will do. What remains in the list is claimed.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from diabolo import Recording, load_recording
from diabolo.rotations import first_axes
from numpy.typing import NDArray

Array = NDArray[np.float64]

GRAVITY = 9.80665
REACH = 5  # frames on both sides of a parabola
SMALLEST = 0.05  # of a term's acceleration, root mean square [m/s^2]
TAUT, SLACK = 0.005, 0.015  # path shorter than usual by less, or by more: it pulls, or it does not [m]

# Term, name of what it would be, parameter, unit, factor from coefficient to parameter.
TERMS: list[tuple[str, str, str, str, float]] = [
    ("against_v", "air_drag_linear", "rate", "1/s", -1.0),
    ("against_v_squared", "air_drag_quadratic", "coefficient", "1/m", -1.0),
    ("axis_x_v", "magnus_lift", "coefficient", "1/rad", 1.0),
    ("tangent", "string_friction", "coefficient", "1", 1.0),
    ("constant_x", "gravity_tilt", "angle_deg", "deg", 1.0),
    ("constant_y", "gravity_tilt", "angle_deg", "deg", 1.0),
]


def derivatives(track: Array, rate: float) -> tuple[Array, Array]:
    """Velocity and acceleration by parabolas through each frame and its neighbours; NaN beside gaps."""
    offsets = np.arange(-REACH, REACH + 1) / rate
    design = np.stack([np.ones_like(offsets), offsets, 0.5 * offsets**2], axis=1)
    weights = np.linalg.pinv(design)
    windows = np.lib.stride_tricks.sliding_window_view(track, 2 * REACH + 1, axis=0)
    result = np.full((3, *track.shape), np.nan)
    result[:, REACH : len(track) - REACH] = np.einsum("kw,tdw->ktd", weights, windows)
    return result[1], result[2]


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-9))


def _lasting(flags: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Where a state lasts for all the frames of a parabola."""
    windows = np.lib.stride_tricks.sliding_window_view(flags, 2 * REACH + 1)
    result = np.zeros(len(flags), dtype=bool)
    result[REACH : len(flags) - REACH] = windows.all(axis=1)
    return result


def library(recording: Recording) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Left-over acceleration (rows x 3) and the terms (rows x 3 x terms), both free of the string's pull, and
    which of the samples these rows are."""
    seen = recording.left_valid & recording.right_valid & recording.diabolo_valid
    track = np.where(seen[:, np.newaxis], recording.diabolo, np.nan)
    velocity, acceleration = derivatives(track, recording.rate)
    left, right = recording.left - track, recording.right - track
    path = np.linalg.norm(left, axis=1) + np.linalg.norm(right, axis=1)
    missing = (np.nanmedian(path) if seen.any() else np.nan) - path
    taut, loose = missing < TAUT, missing > SLACK
    normal = _unit(_unit(left) + _unit(right))
    along = _unit(left - right)
    tangent = along - np.sum(along * normal, axis=1, keepdims=True) * normal
    left_over = acceleration + np.array([0.0, 0.0, GRAVITY])
    pull = np.sum(left_over * normal, axis=1, keepdims=True)
    spin = np.asarray(recording.spin())[:, np.newaxis]
    speed = np.linalg.norm(velocity, axis=1, keepdims=True)
    axis = first_axes(np.asarray(recording.diabolo_orientation))
    slip = np.sign(spin) * np.where(taut[:, np.newaxis], pull, 0.0) * tangent
    constant = np.ones_like(velocity)
    terms = np.stack(
        [
            velocity,
            speed * velocity,
            -spin * np.cross(axis, velocity),
            slip,
            constant * [1.0, 0.0, 0.0],
            constant * [0.0, 1.0, 0.0],
        ],
        axis=2,
    )
    shadow = np.where(taut[:, np.newaxis], normal, 0.0)  # the direction that the string has for itself
    left_over = left_over - np.sum(left_over * shadow, axis=1, keepdims=True) * shadow
    terms = terms - np.einsum("td,tdk->tk", shadow, terms)[:, np.newaxis] * shadow[:, :, np.newaxis]
    known = np.isfinite(left_over).all(axis=1) & np.isfinite(terms).all(axis=(1, 2))
    known &= _lasting(taut) | _lasting(loose)  # catches are no law
    return left_over[known], terms[known], known


def thresholded(target: Array, terms: Array) -> Array:
    """Coefficients by sequentially thresholded least squares; zero for what does not matter."""
    coefficients = np.zeros(terms.shape[1])
    sizes = np.sqrt(np.mean(terms**2, axis=0) * 3.0)
    active = sizes > 0.0
    while active.any():
        coefficients[:] = 0.0
        coefficients[active] = np.linalg.lstsq(terms[:, active], target, rcond=None)[0]
        small = active & (np.abs(coefficients) * sizes < SMALLEST)
        if not small.any():
            break
        active &= ~small
    return np.where(active, coefficients, 0.0)


def diagnose(path: Path) -> dict[str, Any]:
    """An answer of the schema of the diagnosis, as far as this method has one."""
    target, terms, _ = library(load_recording(path))
    count = len(TERMS)
    sizes = np.sqrt(np.mean(terms**2, axis=(0, 1)) * 3.0) if len(target) else np.zeros(count)
    found = thresholded(target.ravel(), terms.reshape(-1, count)) if len(target) > 50 else np.zeros(count)
    effects: list[dict[str, Any]] = []
    for index in np.argsort(-np.abs(found) * sizes):
        _, name, parameter, unit, factor = TERMS[index]
        if found[index] == 0.0 or any(effect["name"] == name for effect in effects):
            continue
        value = {"name": parameter, "value": float(factor * found[index]), "unit": unit, "ci90": None}
        kind = "measurement" if name == "gravity_tilt" else "physics"
        effects.append(
            {
                "name": name,
                "kind": kind,
                "material": True,
                "tied_with": [],
                "parameters": [value],
                "where": {},
            }
        )
    named = any(effect["kind"] == "physics" for effect in effects)
    headline = "NAMED" if named else "MEASUREMENT_FAULT" if effects else "NOTHING_MISSING"
    return {"headline": headline, "effects": effects}
