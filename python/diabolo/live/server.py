# SPDX-License-Identifier: MIT
"""A server for one player on this machine: a page, a stream of frames to it, and wishes from it.

| request | what |
|---|---|
| `GET /` | the page |
| `GET /frames` | server-sent events, each a frame of `Play.frame()`; `ended` is the last one |
| `POST /play` | a wish in JSON: `{"left": [y, z], "right": [y, z], "speed": 1, "begin": null}` |

It hears the loopback interface only, and answers only to its own name, so that no other page can speak to it.
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from queue import Empty, SimpleQueue
from typing import Any, ClassVar

from ..checks import shown
from .hands import REACH
from .play import Wish

HOST = "127.0.0.1"
MOST_CONNECTIONS = 32
LONGEST_BODY = 400
"""Of a wish [bytes]."""
PATIENCE = 30.0
"""With a connection that neither reads nor writes [s]."""
FASTEST = 2.0
"""That time may go, per second of the clock."""


class LiveServer(ThreadingHTTPServer):
    """Serves in threads of its own while it is entered. Raises ValueError where the port cannot be had."""

    daemon_threads = True

    def __init__(self, port: int, page: str) -> None:
        self.page = page.encode()
        self.watchers = 0
        self._wishes: SimpleQueue[Wish] = SimpleQueue()
        self._free = threading.BoundedSemaphore(MOST_CONNECTIONS)
        self._news = threading.Condition()
        self._number, self._event, self._ended = 0, b"", False
        try:
            super().__init__((HOST, port), Handler)
        except OSError as error:
            raise ValueError(f"port {port}: {error.strerror}; expected one that is free") from error
        self.address = f"http://{HOST}:{self.server_port}/"
        self.names = {f"{name}:{self.server_port}" for name in (HOST, "localhost")}

    def __enter__(self) -> LiveServer:
        threading.Thread(target=self.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self.shutdown()
        self.server_close()

    def wishes(self) -> Iterator[Wish]:
        """Those that came since the last call."""
        with suppress(Empty):
            while True:
                yield self._wishes.get_nowait()

    def wish(self, body: bytes) -> None:
        """Raises ValueError where it is none."""
        self._wishes.put(wish_of(body))

    def publish(self, frame: str) -> None:
        """To every page that watches; one that is slow misses some."""
        self._tell(f"data: {frame}\n\n".encode())

    def end(self, sentence: str, wait: float = 1.0) -> None:
        """Tells the pages why it ends, and waits for them to hear it [s]."""
        self._tell(f"event: ended\ndata: {json.dumps(sentence)}\n\n".encode(), ended=True)
        with self._news:
            self._news.wait_for(lambda: self.watchers == 0, wait)

    def _tell(self, event: bytes, ended: bool = False) -> None:
        with self._news:
            self._number, self._event, self._ended = self._number + 1, event, ended
            self._news.notify_all()

    def events(self) -> Iterator[bytes]:
        """What a page that watches is told."""
        number, ended = 0, False
        while not ended:
            with self._news:
                self._news.wait_for(lambda seen=number: self._number > seen)
                number, event, ended = self._number, self._event, self._ended
            yield event

    @contextmanager
    def watching(self) -> Iterator[None]:
        with self._news:
            self.watchers += 1
        try:
            yield
        finally:
            with self._news:
                self.watchers -= 1
                self._news.notify_all()

    def process_request(self, request: Any, client_address: Any) -> None:
        if self._free.acquire(blocking=False):
            super().process_request(request, client_address)
        else:
            self.shutdown_request(request)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        if not isinstance(sys.exc_info()[1], OSError):  # whoever asked has gone
            super().handle_error(request, client_address)


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    timeout = PATIENCE
    disable_nagle_algorithm = True
    server: LiveServer
    paths: ClassVar = {"GET": ("/", "/frames"), "POST": ("/play",)}

    def parse_request(self) -> bool:
        """Whether it is one of ours; all others are answered here."""
        if not super().parse_request():
            return False
        path, host = self.path.partition("?")[0], self.headers.get("Host", "")
        if host not in self.server.names:
            self.send_error(421, f"Host {shown(host)}; expected {self.server.address}")
        elif path not in sum(self.paths.values(), ()):
            self.send_error(404, f"{shown(path)}; expected /, /frames or /play")
        elif path not in self.paths.get(self.command, ()):
            self.send_error(405, f"{shown(self.command)} {path}; expected GET, or POST for /play")
        else:
            return True
        return False

    def do_GET(self) -> None:
        if self.path.startswith("/frames"):
            self._head(200, "text/event-stream", {"Connection": "close"})
            with self.server.watching():
                self.wfile.write(b"retry: 500\n\n")
                for event in self.server.events():
                    self.wfile.write(event)
        else:
            self._head(200, "text/html; charset=utf-8", {"Content-Length": str(len(self.server.page))})
            self.wfile.write(self.server.page)

    def do_POST(self) -> None:
        kind, length = self.headers.get_content_type(), self.headers.get("Content-Length", "")
        if kind != "application/json":  # which another site's page may not send
            self.send_error(415, f"Content-Type {shown(kind)}; expected application/json")
        elif not (length.isascii() and length.isdecimal()):
            self.send_error(411, f"Content-Length {shown(length)}; expected a number of bytes")
        elif len(length) > 9 or int(length) > LONGEST_BODY:
            self.send_error(413, f"{length[:9]} bytes; expected at most {LONGEST_BODY}")
        else:
            try:
                self.server.wish(self.rfile.read(int(length)))
            except ValueError as error:
                return self.send_error(400, str(error))
            self._head(204, None, {})

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """One sentence; the connection closes, since a body may be left unread."""
        text = f"{message or self.responses[HTTPStatus(code)][0]}\n".encode()
        plain = "text/plain; charset=utf-8"
        self._head(code, plain, {"Connection": "close", "Content-Length": str(len(text))})
        self.wfile.write(text)

    def _head(self, status: int, kind: str | None, headers: dict[str, str]) -> None:
        self.send_response(status)
        for name, value in {**({"Content-Type": kind} if kind else {}), **headers}.items():
            self.send_header(name, value)
        self.send_header("Cache-Control", "no-store")
        self.end_headers()

    def log_message(self, *_: Any) -> None:
        """Nothing: a page asks sixty times a second."""


def wish_of(body: bytes) -> Wish:
    """Raises ValueError with a sentence where a body is none."""
    try:
        given = json.loads(body)
    except ValueError:
        raise ValueError("the body is no JSON; expected a wish") from None
    if not isinstance(given, dict) or not given.keys() <= set(Wish._fields):
        raise ValueError(f"{shown(given)}; expected an object with {', '.join(Wish._fields)}")
    wish = Wish(**given)
    if wish.begin not in (None, "again", "spin"):
        raise ValueError(f"begin: {shown(wish.begin)}; expected null, 'again' or 'spin'")
    return wish._replace(
        left=_tip("left", wish.left),
        right=_tip("right", wish.right),
        speed=_within("speed", wish.speed, 0.0, FASTEST),
    )


def _tip(name: str, given: Any) -> tuple[float, float]:
    if not isinstance(given, list | tuple) or len(given) != 2:
        raise ValueError(f"{name}: {shown(given)}; expected two numbers, to the left and up [m]")
    y, z = (_within(name, value, *reach) for value, reach in zip(given, REACH, strict=True))
    return y, z


def _within(name: str, given: Any, low: float, high: float) -> float:
    if isinstance(given, bool) or not isinstance(given, int | float) or not low <= given <= high:
        raise ValueError(f"{name}: {shown(given)}; expected a number from {low:g} to {high:g}")
    return float(given)
