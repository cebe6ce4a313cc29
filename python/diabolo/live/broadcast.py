# SPDX-License-Identifier: MIT
"""One tells, many listen; who is slow misses some."""

from __future__ import annotations

import json
import threading
from collections.abc import Generator


class Broadcast:
    """Server-sent events, from the thread that plays to those that serve a page each."""

    def __init__(self) -> None:
        self.listeners = 0
        self._news = threading.Condition()
        self._number, self._event, self._ended = 0, b"", False

    def publish(self, frame: str) -> None:
        self._tell(f"data: {frame}\n\n".encode())

    def end(self, sentence: str, wait: float = 1.0) -> None:
        """Tell why it ends, and wait until all have heard it, so many seconds at most."""
        self._tell(f"event: ended\ndata: {json.dumps(sentence)}\n\n".encode(), ended=True)
        with self._news:
            self._news.wait_for(lambda: self.listeners == 0, wait)

    def events(self) -> Generator[bytes, None, None]:
        """What a listener is told, to the end."""
        with self._news:
            self.listeners += 1
        try:
            number, ended = 0, False
            while not ended:
                with self._news:
                    while self._number == number:
                        self._news.wait()
                    number, event, ended = self._number, self._event, self._ended
                yield event
        finally:
            with self._news:
                self.listeners -= 1
                self._news.notify_all()

    def _tell(self, event: bytes, ended: bool = False) -> None:
        with self._news:
            self._number, self._event, self._ended = self._number + 1, event, ended
            self._news.notify_all()
