# SPDX-License-Identifier: MIT
"""Debian's chromium without a window, driven through a pipe by the DevTools protocol."""

from __future__ import annotations

import base64
import json
import os
import select
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

BROWSER = shutil.which("chromium")
PATIENCE = 60.0  # [s]


class Page:
    """The page that chromium shows; `console` holds what its scripts and its network complained of."""

    def __init__(self, to_browser: int, from_browser: int) -> None:
        self.to_browser, self.from_browser = to_browser, from_browser
        self.asked, self.rest = 0, b""
        self.console: list[str] = []
        self.session: str | None = None
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.ask(f"{domain}.enable")

    def ask(self, method: str, **parameters: Any) -> dict[str, Any]:
        """The result of a command."""
        self.asked += 1
        message: dict[str, Any] = {"id": self.asked, "method": method, "params": parameters}
        if self.session is not None:
            message["sessionId"] = self.session
        os.write(self.to_browser, json.dumps(message).encode() + b"\0")
        for heard in self._messages():
            if heard.get("id") == self.asked:
                assert "error" not in heard, heard
                return dict(heard["result"])
            if heard.get("method") in (
                "Runtime.exceptionThrown",
                "Runtime.consoleAPICalled",
                "Log.entryAdded",
            ):
                self.console.append(json.dumps(heard["params"]))
        raise AssertionError(f"chromium has gone, before it answered {method}")

    def _messages(self) -> Iterator[dict[str, Any]]:
        while True:
            while b"\0" in self.rest:
                message, _, self.rest = self.rest.partition(b"\0")
                yield json.loads(message)
            ready, _, _ = select.select([self.from_browser], [], [], PATIENCE)
            assert ready, f"chromium says nothing for {PATIENCE:g} s"
            more = os.read(self.from_browser, 2**20)
            if not more:
                return
            self.rest += more

    def value(self, script: str) -> Any:
        """Of an expression in the page."""
        return self.ask("Runtime.evaluate", expression=script, returnByValue=True)["result"].get("value")

    def wait_for(self, script: str, seconds: float = 30.0) -> Any:
        """Its value, once that is true."""
        until = time.monotonic() + seconds
        while not (value := self.value(script)):
            assert time.monotonic() < until, f"{script} is not true after {seconds:g} s"
            time.sleep(0.05)
        return value

    def mouse(self, kind: str, x: float, y: float, button: str = "left") -> None:
        """kind: mousePressed, mouseMoved or mouseReleased, at CSS pixels."""
        self.ask(
            "Input.dispatchMouseEvent",
            type=kind,
            x=x,
            y=y,
            button=button,
            buttons=0 if kind == "mouseReleased" else {"left": 1, "right": 2}[button],
            clickCount=1,
        )

    def picture(self, path: Path) -> None:
        path.write_bytes(base64.b64decode(self.ask("Page.captureScreenshot", format="png")["data"]))


@contextmanager
def chromium(profile: Path, width: int = 1100, height: int = 700) -> Iterator[Page]:
    to_them, to_browser = os.pipe()
    from_browser, from_them = os.pipe()
    command = [
        str(BROWSER),
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--remote-debugging-pipe",
        f"--user-data-dir={profile}",
        f"--window-size={width},{height}",
    ]

    def take_pipes() -> None:  # chromium reads from 3 and writes to 4
        ours = os.dup(to_them), os.dup(from_them)
        os.dup2(ours[0], 3)
        os.dup2(ours[1], 4)

    process = subprocess.Popen(
        command,
        preexec_fn=take_pipes,
        close_fds=False,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    for end in (to_them, from_them):
        os.close(end)
    try:
        yield Page(to_browser, from_browser)
    finally:
        for end in (to_browser, from_browser):
            os.close(end)
        process.terminate()
        process.wait(timeout=20)
