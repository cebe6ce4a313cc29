# SPDX-License-Identifier: MIT
"""What the programs of this folder share: how they begin and end, the topics' quality, and models."""

from __future__ import annotations

import argparse
import gc
import math
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import rclpy
from diabolo import Model
from diabolo.cli import Parser
from diabolo.cli.arguments import read_model
from rclpy.exceptions import ParameterException
from rclpy.executors import Executor
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

SIGNALS = (signal.SIGINT, signal.SIGTERM)
QUALITY = QoSProfile(depth=5000)
"""Reliable; ten seconds at 500 Hz wait for who is slow."""


def run(work: Callable[[list[str]], None]) -> int:
    """Work with the arguments that are not ROS', between its beginning and end. The exit status: 0, after
    Ctrl-C and SIGTERM too, and 2 for bad input.

    Without ROS_AUTOMATIC_DISCOVERY_RANGE only this machine is looked at.
    """
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    for one in SIGNALS:
        signal.signal(one, signal.default_int_handler)
    try:
        _begin()
        work(remove_ros_args(sys.argv)[1:])
    except KeyboardInterrupt:
        pass
    except (ValueError, OSError, RuntimeError, ParameterException) as error:
        print(f"{Path(sys.argv[0]).stem}: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    finally:
        rclpy.try_shutdown()
    return 0


def _begin() -> None:
    try:
        rclpy.init(signal_handler_options=SignalHandlerOptions.NO)  # its own end ROS amidst a step
    except RuntimeError as error:
        raise ValueError(f"--ros-args: {error}; expected arguments of ROS") from error


def parser_of(text: str | None) -> argparse.ArgumentParser:
    """Of a program whose help is the text of its file."""
    layout = argparse.RawDescriptionHelpFormatter
    return Parser(description=text, formatter_class=layout, allow_abbrev=False)


def listen(node: Node, seconds: float = math.inf) -> None:
    """Hand a node what it hears, so long [s] or until Ctrl-C or SIGTERM."""
    gc.freeze()  # what is there stays: to look through it would take longer than a step
    stopped = threading.Event()
    for one in SIGNALS:
        signal.signal(one, lambda *_: stopped.set())
    end = time.monotonic() + seconds
    with executor_of(node) as executor:
        while not stopped.is_set() and (left := end - time.monotonic()) > 0.0:
            executor.spin_once(timeout_sec=min(left, 0.1))  # its spin() never sleeps


@contextmanager
def executor_of(node: Node) -> Iterator[Executor]:
    """It hands a node what it hears, as long as it is spun."""
    executor = EventsExecutor()
    executor.add_node(node)
    try:
        yield executor
    finally:
        executor.remove_node(node)
        executor.shutdown()


def model_of(name: str, string_length: float) -> Model:
    """A name or a file, with that string [m], or its own for 0. Raises ValueError."""
    model = read_model(name)
    if string_length:
        model.parameters.string_length = string_length
    return model
