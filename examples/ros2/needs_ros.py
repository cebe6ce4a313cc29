# SPDX-License-Identifier: MIT
"""Imported by each program before ROS 2: where that is missing, the program ends with a sentence."""

import sys
from importlib import import_module
from pathlib import Path

try:
    for name in ("rclpy", "geometry_msgs.msg", "sensor_msgs.msg", "std_msgs.msg"):
        import_module(name)
except ImportError as error:
    why = " ".join(str(error).split())
    print(
        f"{Path(sys.argv[0]).stem}: {why}; expected ROS 2, by pip install -r tools/ros2-requirements.txt",
        file=sys.stderr,
    )
    sys.exit(2)
