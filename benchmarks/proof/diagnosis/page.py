# SPDX-License-Identifier: MIT
"""The page of a proof: all its figures, failures included."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .. import files
from . import tables
from .earlier import Entry
from .tables import markdown, percent

COMMAND = "python -m benchmarks.proof.diagnosis"
FOLDER = "benchmarks/proof/diagnosis/batches"

INTRODUCTION = """\
# The diagnosis on concealed data

How often the diagnosis is right, on recordings whose truth it could not see. For reviewers;
[results](diagnosis_results.md#on-concealed-data) says the same in words. An independent simulator, the
*plant* ([data/plant](../data/plant)), made the recordings. *Sealed* means that the hash of each truth stood
in a commit before any recording was diagnosed.

`{command}` made this page.

Batch {name}: {cases} recordings of the project's plant. They were drawn and sealed at commit
`{commit}` before any of them was diagnosed. The commit gives the seed, so
that no batch can be chosen. Hashes of keys and recordings, the keys and the answers are in
[{name}.jsonl.xz](../{folder}/{name}.jsonl.xz), a line each.
`{score}` scores them again.

{arms}

| word | meaning |
|---|---|
| null | a case in which nothing is at work but small faults, each below the floor of a claim |
| stranger | a law that no name stands for |
| oracle | the diagnosis that is told what is at work |
| SNR | z-score of an effect in the oracle's fit |
| z | z-score of a fault in the diagnosis's own fit |
| mode | where an effect acts: on the taut string, with a loose string, in flight |
| gap closed | share of the error between base and oracle, held out, that the diagnosis removes |
| taken for another | a stranger of SNR 10 beside whose other claims no more than noise is left |
| misnamed | physics is claimed that is not there |
| confidence | the probability that the tool itself gives for a claimed name |
| class | a claimed name, with the names that it is tied with |
| missed | off the bound by more than the interval; of silence, off the bound |
| missed, within its interval | the value is off the bound, the interval reaches it |

Rates have Clopper-Pearson intervals. [Here](../benchmarks/proof/diagnosis/README.md) the arms are described.
"""

EARLIER = """\
## Earlier batches

Each was drawn, scored, and learned from: the tool and some of the scores changed after it. Commits, seeds and
the hashes of their seals are in [earlier.jsonl.xz](../{folder}/earlier.jsonl.xz). In brackets: cases.

"""


def _row_of(score: dict[str, Any]) -> list[str]:
    """With the page's words in place of the files'."""
    return tables.row_of({**score, "name": score["name"].replace("the bank", "the candidates")})


def _rate(row: dict[str, Any]) -> list[str]:
    total = row["total"]
    if not total:
        return ["-", "0"]
    span = f"{percent(row['hits'] / total)} [{percent(row['low'])}, {percent(row['high'])}]"
    return [span, f"{row['hits']} of {total}"]


def _confusion(table: dict[str, dict[str, int]]) -> str:
    columns = sorted(
        {claimed for row in table.values() for claimed in row}, key=lambda c: (c == "nothing", c)
    )
    rows = [[truth, *(str(row.get(column, "")) for column in columns)] for truth, row in table.items()]
    return markdown(["at work", *columns], rows)


def _power(rows: list[dict[str, Any]]) -> str:
    shown = [
        [f"{low:g} to {high:g}" if high is not None else f"above {low:g}", *_rate(row)]
        for row in rows
        for low, high in [row["snr"]]
    ]
    return markdown(["SNR", "in the answer or its tie", "cases"], shown)


def _reliability(rows: list[dict[str, Any]]) -> str:
    shown = [
        [
            f"{low:g} to {high:g}",
            "-" if row["mean"] is None else percent(row["mean"]),
            *_rate(row),
        ]
        for row in rows
        for low, high in [row["confidence"]]
    ]
    return markdown(["confidence", "mean", "right", "claims"], shown)


def _names(rows: list[dict[str, Any]]) -> str:
    shown = [
        [
            row["name"],
            str(row["cases"]),
            str(row["found"]),
            f"{row['clear_found']} of {row['clear']}",
            str(row["false"]),
            f"{row['covered']} of {row['intervals']}",
        ]
        for row in rows
    ]
    header = [
        "name",
        "at work",
        "in the answer",
        "of those with SNR >= 10",
        "claimed falsely",
        "intervals that cover",
    ]
    return markdown(header, shown)


def _compared(result: dict[str, Any], others: dict[str, dict[str, Any]]) -> str:
    everyone = {"diagnose": result, **others}
    rows = [
        [_row_of(score)[0], *(_row_of(one["scores"][place])[1] for one in everyone.values())]
        for place, score in enumerate(result["scores"])
    ]
    return markdown(["score", *everyone], rows)


def _earlier(result: dict[str, Any], batches: dict[str, Entry]) -> str:
    """The scores that have a bound, of each batch."""
    scores = {name: {score["name"]: score for score in batch["scores"]} for name, batch in batches.items()}
    rows = [
        [_row_of(score)[0], *(_row_of(one[name])[1] if name in one else "-" for one in scores.values())]
        for score in result["scores"]
        for name in [score["name"]]
        if tables.bound_of(score)
    ]
    return markdown(["score", *(f"{name} ({batches[name]['cases']})" for name in scores)], rows)


def text_of(
    name: str,
    sealed: dict[str, Any],
    result: dict[str, Any],
    others: dict[str, dict[str, Any]],
    batches: dict[str, Entry],
    picture: str | None,
) -> str:
    """The page."""
    arms = markdown(["arm", "cases"], [[arm, str(count)] for arm, count in sealed["arms"].items()])
    parts = [
        INTRODUCTION.format(
            command=f"{COMMAND} page {name}",
            score=f"{COMMAND} score {name}",
            folder=FOLDER,
            name=name,
            cases=result["cases"],
            commit=sealed["commit"],
            arms=arms,
        ),
        "## Scores\n\n" + markdown(tables.HEADER, [_row_of(score) for score in result["scores"]]),
    ]
    for structure, scores in result["by_plant"].items():
        parts.append(
            f"### Plant: {structure}\n\n" + markdown(tables.HEADER, [_row_of(score) for score in scores])
        )
    if others:
        parts.append("## Simpler tools on the same recordings\n\n" + _compared(result, others))
    parts.append("## By name\n\n" + _names(result["by_name"]))
    if kinds := tables.kind_rows(result):
        parts.append("## Strangers by kind\n\n" + markdown(kinds[0], kinds[1:]))
    parts.append(
        "## One effect at work, and the first that was claimed\n\n" + _confusion(result["confusion"])
    )
    parts.append("## Power\n\n" + (f"![power]({picture})\n\n" if picture else "") + _power(result["power"]))
    parts.append("## Confidence\n\n" + _reliability(result["reliability"]))
    failures = tables.failure_rows(result)
    shown = markdown(tables.FAILURE_HEADER, failures) if failures else "None."
    parts.append(f"## Every answer that is wrong in something ({len(failures)})\n\n{shown}")
    if batches:
        parts.append(EARLIER.format(folder=FOLDER) + _earlier(result, batches))
    return "\n\n".join(parts) + "\n"


def draw_power(path: Path, rows: list[dict[str, Any]]) -> bool:
    """The power curve as a picture; False where matplotlib is not installed."""
    try:
        from matplotlib.figure import Figure
        from PIL import Image  # which matplotlib needs
    except ImportError:
        return False
    shown = [row for row in rows if row["total"]]
    figure = Figure(figsize=(6.0, 3.5), layout="constrained")
    axes = figure.subplots()
    places = [(row["snr"][0] + (row["snr"][1] or 1.5 * row["snr"][0])) / 2.0 for row in shown]
    rates = [row["hits"] / row["total"] for row in shown]
    below = [rate - row["low"] for rate, row in zip(rates, shown, strict=True)]
    above = [row["high"] - rate for rate, row in zip(rates, shown, strict=True)]
    axes.errorbar(places, rates, yerr=[below, above], fmt="o-", capsize=3)
    axes.axvline(10.0, color="grey", linewidth=0.8)
    axes.set(xscale="log", ylim=(-0.02, 1.02), xlabel="SNR of the effect", ylabel="in the answer or its tie")
    temporary = path.with_name(f".{path.name}")
    figure.savefig(temporary, dpi=80, format="png")
    with Image.open(temporary) as image:
        few_colours = image.convert("RGB").quantize(32, dither=Image.Dither.NONE)
    few_colours.save(temporary, format="PNG", optimize=True)
    temporary.replace(path)
    return True


def write(
    out: Path,
    name: str,
    sealed: dict[str, Any],
    result: dict[str, Any],
    others: dict[str, dict[str, Any]],
    batches: dict[str, Entry],
) -> list[Path]:
    """Writes the page, and the picture beside it; returns what was written."""
    picture = out.with_name("proof_power.png")
    drawn = draw_power(picture, result["power"])
    files.write_text(out, text_of(name, sealed, result, others, batches, picture.name if drawn else None))
    return [out, picture] if drawn else [out]
