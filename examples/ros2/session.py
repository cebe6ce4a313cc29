# SPDX-License-Identifier: MIT
"""What the programs of this folder share: how they begin and end, the topics' quality, and models."""

from __future__ import annotations

import gc
import math
import os
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import rclpy
from diabolo import Model
from diabolo.cli.arguments import read_model
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.utilities import remove_ros_args

QUALITY = QoSProfile(depth=1000)
"""Reliable; two seconds at 500 Hz wait for who is slow."""


def run(work: Callable[[list[str]], None]) -> int:
    """Work with the arguments that are not ROS', between its beginning and end. The exit status: 0, after
    Ctrl-C and SIGTERM too, and 2 for bad input.

    Without ROS_AUTOMATIC_DISCOVERY_RANGE only this machine is looked at.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    try:
        rclpy.init()
        work(remove_ros_args(sys.argv)[1:])
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except (ValueError, OSError, RuntimeError, ParameterException) as error:
        print(f"{Path(sys.argv[0]).stem}: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    finally:
        rclpy.try_shutdown()
    return 0


def listen(node: Node, seconds: float = math.inf) -> None:
    """Hand a node what it hears, so long [s] or until Ctrl-C or SIGTERM."""
    gc.freeze()  # what is there stays: to look through it would take longer than a step
    end = time.monotonic() + seconds
    executor = EventsExecutor()
    executor.add_node(node)
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        while rclpy.ok() and (left := end - time.monotonic()) > 0.0:
            executor.spin_once(timeout_sec=min(left, 1.0))  # its spin() never sleeps


def model_of(name: str, string_length: float) -> Model:
    """A name or a file, with that string [m], or its own for 0. Raises ValueError."""
    model = read_model(name)
    if string_length:
        model.parameters.string_length = string_length
    return model
