# SPDX-License-Identifier: MIT
"""How long it takes from a tip that is published to the pose with its stamp that is heard.

    python examples/ros2/diabolo_node.py &
    python examples/ros2/latency.py --seconds 60

It swings the tips and counts what is lost.
"""

from __future__ import annotations

import gc
import sys
import time

import needs_ros  # noqa: F401
import numpy as np
from diabolo import TipMotion
from diabolo.motions import swing_and_beat
from geometry_msgs.msg import PoseStamped
from numpy.typing import NDArray
from rclpy.executors import Executor
from rclpy.node import Node
from senders import JointSender, TipSender, in_time, wait_until_heard
from session import QUALITY, executor_of, listen, parser_of, run
from tips import stamp_of

Floats = NDArray[np.float64]
PATIENCE = 20.0  # after the last tip [s]


class Meter(Node):
    """Moves the tips and hears the poses.

    poses: of the diabolo, by their stamp [ns]; delays: theirs [s]; last: the stamp of the last pose, also of
    one whose tips another one sent; 0: none was heard.
    """

    def __init__(self) -> None:
        super().__init__("latency")
        self.create_subscription(PoseStamped, "diabolo/pose", self._hear, QUALITY)
        self.last = 0
        self.sent: dict[int, float] = {}
        self.poses: dict[int, PoseStamped] = {}
        self.delays: list[float] = []

    def _hear(self, message: PoseStamped) -> None:
        now, stamp = time.perf_counter(), stamp_of(message)
        self.last = stamp
        if stamp in self.sent:
            self.delays.append(now - self.sent[stamp])
            self.poses[stamp] = message

    def measure(self, sender: TipSender | JointSender, times: Floats, begin: int) -> None:
        """times: the sender's [s]; begin: the first stamp [ns]. Ends when all is heard, or given up.

        Within executor_of(self), once for a node's life: a second executor is not told of what came to the
        first and waits there, and lags behind by that many poses.
        """
        executor = self.executor
        self._find(sender, begin, executor)
        for i in in_time(times.tolist(), executor.spin_once):
            stamp = begin + round(1e9 * times[i])
            self.sent[stamp] = time.perf_counter()
            sender.send(i, stamp)
        end = time.monotonic() + PATIENCE
        while len(self.poses) < len(self.sent) and time.monotonic() < end:
            executor.spin_once(0.01)

    def _find(self, sender: TipSender | JointSender, begin: int, executor: Executor) -> None:
        """Until the first tips, sent a minute early, are answered: then both ways are open."""
        wait_until_heard(sender.outputs)
        early = begin - 60_000_000_000
        for attempt in range(1000):
            sender.send(0, early + attempt * 20_000_000)
            executor.spin_once(0.02)
            if early <= self.last < begin:  # and no pose of another one's tips
                return
        raise ValueError("no pose is heard; expected a running diabolo_node.py")

    @property
    def lost(self) -> int:
        return len(self.sent) - len(self.poses)


class Echo(Node):
    """Answers each right tip with a pose at once: what ROS itself takes."""

    def __init__(self) -> None:
        super().__init__("echo")
        self._output = self.create_publisher(PoseStamped, "diabolo/pose", QUALITY)
        self.create_subscription(PoseStamped, "left_tip", lambda _: None, QUALITY)
        self.create_subscription(PoseStamped, "right_tip", self._output.publish, QUALITY)


def swing(times: Floats) -> TipMotion:
    """Tips that swing and beat, at these times."""
    left, right, *_ = swing_and_beat(float(times[-1])).at(times)
    return TipMotion(times, left, right)


def times_of(seconds: float, rate: float) -> Floats:
    """Of so long a play. Raises ValueError."""
    if not (0.1 <= seconds <= 3600.0 and 1.0 <= rate <= 10_000.0):
        raise ValueError(f"--seconds {seconds:g} --rate {rate:g}; expected 0.1 to 3600 s and 1 to 10000 Hz")
    count = int(seconds * rate)
    if count < 2:
        raise ValueError(f"--seconds {seconds:g} --rate {rate:g}: {count} samples; expected two or more")
    return np.arange(count) / rate


def work(arguments: list[str]) -> None:
    parser = parser_of(__doc__)
    parser.add_argument("--seconds", type=float, default=60.0, metavar="S", help="default: 60")
    parser.add_argument("--rate", type=float, default=500.0, metavar="HZ", help="default: 500")
    parser.add_argument("--echo", action="store_true", help="be a node that answers with the tip instead")
    given = parser.parse_args(arguments)
    if given.echo:
        listen(Echo())
        return
    times = times_of(given.seconds, given.rate)
    meter = Meter()
    gc.freeze()
    sender = TipSender(meter, swing(times), times)
    with executor_of(meter):
        meter.measure(sender, times, meter.get_clock().now().nanoseconds)
    if not meter.delays:
        raise ValueError(
            f"none of {len(times)} tips was answered in {PATIENCE:g} s; expected a running diabolo_node.py"
        )
    middle, late, worst = 1e3 * np.quantile(meter.delays, (0.5, 0.99, 1.0))
    print(
        f"{len(times)} sent, {meter.lost} lost; tip to pose [ms]: median {middle:.2f}, 99 % {late:.2f}, "
        f"largest {worst:.2f}"
    )


if __name__ == "__main__":
    sys.exit(run(work))
