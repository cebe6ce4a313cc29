# SPDX-License-Identifier: MIT
"""What named physics leaves of recordings, learnt as a force."""

from __future__ import annotations

from collections.abc import Iterable

from . import _core
from ._core import Model, ResidualFit
from .checks import MOST_THREADS, AnyRecording, check_distinct, list_of, model_of, warn_of, whole_number


def fit_residual(
    recordings: AnyRecording | Iterable[AnyRecording], base: Model | str = "consistent", *, threads: int = 0
) -> ResidualFit:
    """Learn what a model leaves of recordings of one set-up, as an acceleration in the string's frame.

    recordings: or the names of their files. Each is left out in turn, or each third of a single one, to judge
        what the others say: the force stands only where positions half a second later are nearer by more than
        1 mm, their median and all of a 95 % interval of their mean. Else `model` is the base.
    base: the named physics: a Model, "consistent", "paper" or "published", without its own residual.
    threads: 0 takes all processors; the result does not depend on it.

        fit_residual(["swing.csv", "throw.csv"]).model.save("learnt.json")

    Ctrl-C ends it at once. Raises ValueError about bad input, such as samples that are given twice, and warns
    (RecordingWarning) of recordings that are odd.
    """
    given = list_of("recordings", recordings, least=1)
    threads = whole_number("threads", threads, 0, MOST_THREADS)
    chosen = model_of("base", base)
    check_distinct(given, parts=True)
    warn_of(given, stacklevel=3)
    return _core.fit_residual(given, chosen, threads)
