# SPDX-License-Identifier: MIT
"""Imported first: a command that Ctrl-C ends while it loads shows no traceback."""

import os
import signal
import sys
import threading

# `python -m diabolo` has the first name while the package is imported.
_IS_COMMAND = os.path.basename((sys.argv or [""])[0]) in ("-m", "diabolo")

if (
    _IS_COMMAND
    and threading.current_thread() is threading.main_thread()
    and signal.getsignal(signal.SIGINT) is signal.default_int_handler
):
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # until the command's main() takes over
