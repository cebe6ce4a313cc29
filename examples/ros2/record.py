# SPDX-License-Identifier: MIT
"""Writes the tips and the diabolo that are heard as a bag of ROS 2, until Ctrl-C.

    python examples/ros2/record.py take.mcap
    diabolo diagnose take.mcap

A diabolo that a camera sees is heard by `--ros-args -r diabolo/pose:=/its/topic`.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path

import needs_ros  # noqa: F401
import numpy as np
from diabolo import Model, Recording, played_properties, save_recording
from diabolo.cli.arguments import output_name
from diabolo.files import check_outputs
from diabolo.formats import check_writer
from geometry_msgs.msg import PoseStamped
from numpy.typing import NDArray
from rclpy.node import Node
from session import QUALITY, listen, model_of, parser_of, run
from tips import MessageError, Refusals, stamp_of, tip_of

TOPICS = {"left": "left_tip", "right": "right_tip", "diabolo": "diabolo/pose"}
Floats = NDArray[np.float64]
LONGEST = 3600.0  # [s]


class Recorder(Node):
    """heard: place and orientation of each body, seven numbers by their stamp [ns]. The first message tells
    frame and time of the take: what does not fit them is not used."""

    def __init__(self) -> None:
        super().__init__("recorder")
        self.heard: dict[str, dict[int, list[float]]] = {role: {} for role in TOPICS}
        self.refusals = Refusals(self.get_logger().warning)
        self._first: PoseStamped | None = None
        for role, topic in TOPICS.items():
            self.create_subscription(PoseStamped, topic, partial(self._hear, role), QUALITY)

    def _hear(self, role: str, message: PoseStamped) -> None:
        first = self._first = self._first or message
        topic, stamp = TOPICS[role], stamp_of(message)
        with self.refusals.catching():
            tip_of(topic, message, first.header.frame_id)
            if abs(seconds := 1e-9 * (stamp - stamp_of(first))) > LONGEST:
                raise MessageError(
                    f"{topic}, stamp", f"{seconds:+g} s after the first one; expected within {LONGEST:g} s"
                )
            p, q = message.pose.position, message.pose.orientation
            self.heard[role][stamp] = [p.x, p.y, p.z, q.x, q.y, q.z, q.w]

    def recording(self, title: str, model: Model) -> Recording:
        """A row for each stamp, NaN where a body was not heard. Raises ValueError where one never was."""
        for role, rows in self.heard.items():
            if len(rows) < 2:
                raise ValueError(f"{TOPICS[role]}: {len(rows)} messages were heard; expected two or more")
        stamps = np.array(sorted(set().union(*self.heard.values())))
        tracks = {role: _track(rows, stamps) for role, rows in self.heard.items()}
        body = model.parameters
        return Recording(
            1e-9 * (stamps - stamps[0]),
            *(track[:, :3] for track in tracks.values()),
            1e9 / float(np.median(np.diff(stamps))),
            **{f"{role}_orientation": _turns(track[:, 3:]) for role, track in tracks.items()},
            name=title,
            properties=played_properties(body),
            string_length=body.string_length,
        )


def _track(rows: Mapping[int, list[float]], stamps: Floats) -> Floats:
    missing = [math.nan] * 7
    return np.array([rows.get(stamp, missing) for stamp in stamps.tolist()])


def _turns(quaternions: Floats) -> Floats | None:
    """Zeros are no orientation."""
    turns = np.where(quaternions.any(axis=1)[:, None], quaternions, math.nan)
    return turns if np.isfinite(turns).any() else None


def work(arguments: list[str]) -> None:
    parser = parser_of(__doc__)
    parser.add_argument("out", metavar="OUT.mcap", type=output_name, help="what to write")
    parser.add_argument("--seconds", type=float, default=LONGEST, metavar="S", help="default: 3600")
    parser.add_argument("--model", default="consistent", metavar="NAME", help="default: consistent")
    parser.add_argument("--string-length", type=float, default=0.0, metavar="L", help="[m]; 0: the model's")
    given = parser.parse_args(arguments)
    out = Path(given.out)
    check_outputs([out], [])
    if out.suffix != ".mcap":  # a table has no rows of its own for bodies with other stamps
        raise ValueError(f"{out}: expected a name that ends in .mcap")
    check_writer(out)
    if not 0.0 < given.seconds <= LONGEST:
        raise ValueError(f"--seconds {given.seconds:g}; expected up to {LONGEST:g}")
    model = model_of(given.model, given.string_length)
    recorder = Recorder()
    listen(recorder, given.seconds)
    recorder.refusals.report()
    recording = recorder.recording(out.stem, model)
    save_recording(recording, out)
    print(f"{out}: {len(recording)} samples at {recording.rate:.1f} Hz")


if __name__ == "__main__":
    sys.exit(run(work))
