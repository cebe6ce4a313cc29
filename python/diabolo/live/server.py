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

import sys
import threading
from collections.abc import Iterator
from contextlib import closing, suppress
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from queue import Empty, SimpleQueue
from typing import Any, ClassVar

from ..checks import shown
from .broadcast import Broadcast
from .wish import Wish, wish_of

HOST = "127.0.0.1"
MOST_CONNECTIONS = 32
LONGEST_BODY = 400
"""Of a wish [bytes]."""
PATIENCE = 30.0
"""With a connection that neither reads nor writes [s]."""


class LiveServer(ThreadingHTTPServer):
    """Serves in threads of its own while it is entered. Raises ValueError where the port cannot be had."""

    daemon_threads = True

    def __init__(self, port: int, page: str) -> None:
        self.page = page.encode()
        self.frames = Broadcast()
        self._wishes: SimpleQueue[Wish] = SimpleQueue()
        self._free = threading.BoundedSemaphore(MOST_CONNECTIONS)
        try:
            super().__init__((HOST, port), Handler)
        except OSError as error:
            raise ValueError(f"port {port}: {error.strerror}; expected one that is free") from error
        self.address = f"http://{HOST}:{self.server_port}/"
        ports = ["", ":80"] if self.server_port == 80 else [f":{self.server_port}"]
        self.names = {name + port for name in (HOST, "localhost") for port in ports}

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
            self.wfile.write(b"retry: 500\n\n")
            with closing(self.server.frames.events()) as events:
                for event in events:
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
            self.send_error(413, f"Content-Length {shown(length)}; expected at most {LONGEST_BODY} bytes")
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
