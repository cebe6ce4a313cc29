# SPDX-License-Identifier: MIT
"""Plays the tips of a plan, a recording or a bag: publishes them at their times.

diabolo plan throw_and_catch --out throw.csv
python examples/ros2/play.py throw.csv --rate 500
"""

from __future__ import annotations

import sys
from pathlib import Path

import needs_ros  # noqa: F401
import numpy as np
from diabolo import TipMotion, load_recording
from diabolo.robot import load_tip_plan
from numpy.typing import NDArray
from rclpy.node import Node
from senders import JointSender, TipSender, in_time, wait_until_heard, wait_until_taken
from session import parser_of, run

MOST = 1_000_000  # samples
LATEST = 2**31 - 1e6  # of a stamp [s]


def motion_of(path: str, topics: str | None) -> TipMotion:
    """Of a table of tips without a JSON file beside it, or of a recording. Raises ValueError."""
    file = Path(path)
    if file.is_file() and file.suffix == ".csv" and not file.with_suffix(".json").exists():
        with file.open(encoding="utf-8-sig", errors="replace") as lines:
            is_plan = "left_x" in lines.readline(200)
        if is_plan and topics is not None:
            raise ValueError(f"{path}: topics are given, but it is a plan; expected them of a bag")
        if is_plan:
            return load_tip_plan(path)
    return TipMotion.of_recording(load_recording(path, topics=topics))


def times_of(motion: TipMotion, rate: float | None) -> NDArray[np.float64]:
    """Those of the file, or so many a second."""
    if rate is None:
        return motion.times
    count = (motion.end - motion.begin) * rate
    if not 0.0 < count <= MOST:
        raise ValueError(f"--rate {rate:g}: {count:g} samples; expected 1 to {MOST}")
    return motion.begin + np.arange(int(count + 1e-6) + 1) / rate


def work(arguments: list[str]) -> None:
    parser = parser_of(__doc__)
    parser.add_argument("file", metavar="FILE", help="a plan, or a recording or bag of docs/recordings.md")
    parser.add_argument("--rate", type=float, metavar="HZ", help="default: the times of the file")
    parser.add_argument("--joints", action="store_true", help="of two arms, on joint_states")
    parser.add_argument("--topics", metavar="LIST", help="left=NAME,right=NAME,diabolo=NAME of a bag")
    parser.add_argument("--listeners", type=int, default=1, metavar="N", help="to wait for; default: 1")
    parser.add_argument("--start", type=float, metavar="S", help="the first stamp; default: now")
    given = parser.parse_args(arguments)
    if given.start is not None and not 0.0 <= given.start <= LATEST:
        raise ValueError(f"--start {given.start:g}; expected 0 to {LATEST:.0f}")
    if given.listeners < 0:
        raise ValueError(f"--listeners {given.listeners}; expected 0 or more")
    motion = motion_of(given.file, given.topics)
    times = times_of(motion, given.rate)
    node = Node("player")
    sender = (JointSender if given.joints else TipSender)(node, motion, times)
    wait_until_heard(sender.outputs, given.listeners)
    begin = node.get_clock().now().nanoseconds if given.start is None else round(1e9 * given.start)
    elapsed = (times - times[0]).tolist()
    for i in in_time(elapsed):
        sender.send(i, begin + round(1e9 * elapsed[i]))
    wait_until_taken(sender.outputs)
    print(f"{given.file}: {len(times)} samples in {elapsed[-1]:.2f} s")


if __name__ == "__main__":
    sys.exit(run(work))
