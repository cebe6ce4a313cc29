# SPDX-License-Identifier: MIT
"""The viewer's page, which shows what the server streams and tells it where the pointer is."""

from __future__ import annotations

import json

from ..view import TEMPLATE, page_of
from .play import Play

SCRIPTS = [TEMPLATE.with_name(name) for name in ("pointer.js", "live.js")]


def live_html(play: Play) -> str:
    """The page of a play, as it is now."""
    first = json.loads(play.frame())
    data = {
        "title": f"Play: {play.model.name}",
        "note": "",
        "live": True,
        "predictions": [],
        "goals": [],
        "string_length": play.model.parameters.string_length,
        "size": [play.properties.diameter, play.properties.length],
    } | {name: [first[name]] for name in ("time", "left", "right", "diabolo", "orientation")}
    scripts = "".join(f"<script>\n{path.read_text(encoding='utf-8')}</script>\n" for path in SCRIPTS)
    return page_of(data).replace("</body>", scripts + "</body>", 1)
