# SPDX-License-Identifier: MIT
"""The page of results, from the figures that run_all.py collects."""

from __future__ import annotations

import statistics
from typing import Any

from .figures import PROGRAMS, per_step, speed, table
from .measure import spread
from .opening import opening

MODELS = {
    "consistent": "`consistent()`",
    "elastic": "`consistent()`, elastic",
    "published": "`published()`",
    "paper": "`paper()`",
}
SCALARS = ("double", "float", "Dual<double,4>", "Dual<double,16>", "Pack<double,4>")
KERNELS = ("portable", "baseline", "avx2", "avx512")


def median_and_worst(times: list[float]) -> str:
    return f"{statistics.median(times):.1f} ({max(times):.1f})"


def count(counts: dict[str, float], name: str, steps: float) -> str:
    return f"{counts[name] / steps:,.0f}" if name in counts else "-"


def step_table(results: dict[str, Any], play: str, kind: str = "step") -> str:
    rows = []
    for model, title in MODELS.items():
        for scalar in SCALARS:
            name = f"{kind}/{model}/{scalar}/{play}"
            entry = results["step"][name]
            rows.append(
                [
                    title,
                    f"`{scalar}`",
                    median_and_worst(per_step(entry)),
                    f"{speed(entry):.2f}",
                    count(results["step_counts"], name, entry["steps"]),
                    f"{100 * entry['on_string']:.0f} %",
                    f"{100 * entry['flying']:.0f} %",
                    f"{entry['allocations']:.0f}",
                ]
            )
    columns = ["model", "number", "ns per step: median (worst)", "M steps/s", "instructions", "on the string"]
    return table([*columns, "flying", "memory taken"], rows, text_columns=2)


def batch_table(results: dict[str, Any]) -> str:
    rows = []
    order = sorted(results["batch"], key=lambda name: (KERNELS.index(name.split("/")[1]), name))
    for name in order:
        entry = results["batch"][name]
        _, kernel, threads, tips = name.split("/")[:4]
        if not name.endswith("/alike"):
            rows.append(
                [
                    kernel,
                    threads.split()[0],
                    tips,
                    f"{speed(entry):.1f}",
                    f"{1e3 / max(per_step(entry)):.1f}",
                    f"{speed(entry, 'wall'):.1f}",
                    count(results["batch_counts"], name, entry["steps"]),
                ]
            )
    columns = ["kernel", "threads", "tip motions", "M steps/s per core (processor's time)", "worst"]
    return table([*columns, "M steps/s in all (wall clock)", "instructions per step"], rows, text_columns=3)


def linear(results: dict[str, Any]) -> tuple[str, float]:
    """Table of the time of n, 2 n and 4 n steps, and how far the last is from 4 times the first.

    Of the fastest repetitions: a processor's clock that changes between them would bend the medians.
    """
    rows, worst = [], 0.0
    counts = results["step_counts"]
    best = next(name.split("/")[1] for name in results["batch"] if name.endswith("/alike"))
    chains = {
        "rollout, `double`": [
            f"rollout/consistent/double/{p}" for p in ("beat", "beat for 2 s", "beat for 4 s")
        ],
        f"batch, {best}": [f"batch/{best}/1 thread/shared tips/{n} steps/alike" for n in (1000, 2000, 4000)],
    }
    for title, names in chains.items():
        times = [min({**results["step"], **results["batch"]}[name]["cpu"]) for name in names]
        more = f"{counts[names[2]] / counts[names[0]]:.4f}" if names[2] in counts else "-"
        ratios = [f"{t / times[0]:.3f}" for t in times[1:]]
        rows.append([title, *(f"{1e-3 * t:.1f}" for t in times), *ratios, more])
        worst = max(worst, abs(times[2] / times[0] / 4.0 - 1.0))
    columns = [
        "",
        "1000 steps [us]",
        "2000 steps [us]",
        "4000 steps [us]",
        "2000 over 1000",
        "4000 over 1000",
        "the same in instructions",
    ]
    return table(columns, rows), worst


def robot_table(results: dict[str, Any]) -> str:
    if "robot" not in results:
        return "Not measured here: Orocos KDL was not found."
    unit = statistics.median(per_step(results["robot"]["kdl_forward"]))
    rows = [
        [
            name.replace("_", " "),
            f"{statistics.median(per_step(entry)):,.0f}",
            f"{max(per_step(entry)):,.0f}",
            f"{statistics.median(per_step(entry)) / unit:,.2f}",
            count(results.get("robot_counts", {}), name, entry["steps"]),
            f"{entry['p99_us']:.1f}" if "p99_us" in entry else "",
        ]
        for name, entry in sorted(results["robot"].items())
    ]
    columns = ["", "median [ns]", "worst [ns]", "over KDL's forward", "instructions"]
    return table([*columns, "p99 of single calls [us]"], rows)


def loader_table(results: dict[str, Any]) -> str:
    rows = [
        [
            name.replace("_", " "),
            *(f"{1e-6 * f(entry['cpu']):.0f}" for f in (statistics.median, max)),
            count(results.get("loader_counts", {}), name, 1e6),
        ]
        for name, entry in sorted(results["loader"].items())
    ]
    return table(["", "median [ms]", "worst [ms]", "million instructions"], rows)


def mujoco_ratio(results: dict[str, Any]) -> float | None:
    """Least ratio to the fastest way to give MuJoCo the job, over the motions."""
    ratios = [row["ratio"] for row in (results["mujoco"] or {"rows": []})["rows"] if row["ratio"]]
    return min(ratios, default=None)


def mujoco_table(results: dict[str, Any]) -> str:
    def number(value: float | None, scale: float, form: str = ".3g") -> str:
        return "-" if value is None else format(scale * value, form)

    if results["mujoco"] is None:
        return "MuJoCo was not installed in this run; `make mujoco` installs it."
    rows = [
        [
            row["motion"],
            row["simulator"],
            number(row["timestep"], 1e3),
            number(row["error"], 1e3),
            number(row["time"], 1e6),
            number(row["instructions"], 1, ",.0f"),
            number(row["ratio"], 1),
        ]
        for row in results["mujoco"]["rows"]
    ]
    columns = ["motion", "simulator", "timestep [ms]", "error [mm]", "time per s of motion [us]"]
    text = table([*columns, "instructions per s of motion", "time over ours"], rows, text_columns=2)
    return f"{text}\n\nMuJoCo {results['mujoco']['versions']['mujoco']}."


def targets(results: dict[str, Any]) -> str:
    beat = results["step"]["step/consistent/double/beat"]
    step = statistics.median(per_step(beat))
    avx2 = results["batch"].get("batch/avx2/1 thread/shared tips/1000 steps")
    loader = statistics.median(results["loader"]["read_motive_20_MB"]["cpu"]) * 1e-9
    slowest = max(results["compile"]["seconds"].items(), key=lambda item: item[1])
    length = statistics.median(results["header_lines"].values())
    ratio = mujoco_ratio(results)
    bent = linear(results)[1]
    wanted = [
        ("step, `consistent()`, `double`", "<= 45 ns", f"{step:.1f} ns", step <= 45.0),
        ("its share on the string", ">= 90 %", f"{100 * beat['on_string']:.1f} %", beat["on_string"] >= 0.9),
        ("its requests for memory", "0", f"{beat['allocations']:.0f}", beat["allocations"] == 0),
        (
            "batch, AVX2, per core",
            ">= 60 M steps/s",
            "no AVX2 here" if avx2 is None else f"{speed(avx2):.1f} M steps/s",
            None if avx2 is None else speed(avx2) >= 60.0,
        ),
        ("4 times the steps, off 4 times the time", "<= 10 %", f"{100 * bent:.1f} %", bent <= 0.1),
        (
            "MuJoCo's time over ours, both within 1 mm",
            ">= 30",
            "not run" if ratio is None else f"{ratio:.0f}",
            None if ratio is None else ratio >= 30.0,
        ),
        ("a recording of 20 MB read", "< 0.3 s", f"{loader:.3f} s", loader < 0.3),
        (
            "slowest header of the core, alone",
            "< 2 s",
            f"{slowest[1]:.2f} s (`{slowest[0]}`)",
            slowest[1] < 2.0,
        ),
        ("median length of a header", "about 100 lines", f"{length:.0f} lines", None),
    ]
    verdict = {True: "yes", False: "**no**", None: "-"}
    return table(
        ["figure", "target", "reached", "met"],
        [[what, target, reached, verdict[met]] for what, target, reached, met in wanted],
        text_columns=4,
    )


def machine_part(results: dict[str, Any]) -> str:
    machine, load = results["machine"], results["load"]
    spreads = [spread(e["cpu"]) for part in ("step", "batch", "loader") for e in results[part].values()]
    noise = (
        f"worst of {results['repetitions']} repetitions over their median: "
        f"{100 * statistics.median(spreads):.0f} % for half of the figures, "
        f"{100 * max(spreads):.0f} % for the worst of them"
    )
    return f"""## The machine

| machine | |
|---|---|
| processor | {machine["processor"]}, {machine["cores"]} cores |
| system | {machine["system"]} |
| compiler | {machine["compiler"]}; CMake's Release: `-O3 -DNDEBUG`, baseline instruction set |
| load average | {min(load):.1f} to {max(load):.1f} during the run, which took {results["seconds"]:.0f} s |
| noise | {noise} |

Times are processor time, medians of {results["repetitions"]} repetitions in random order, the worst beside.
Instructions are those of one run of the job, as callgrind counts them; they do not depend on other work on
the machine, which makes times longer. With a load average much above one, the machine was shared.
"""


def model_part(results: dict[str, Any]) -> str:
    return f"""## Targets

{targets(results)}

## One step

A step of 1 ms; tips from a natural spline through poses at 120 Hz, computed before. Every run begins from
the same state: a motion left to itself decays into denormals. A step of a pack is four steps, and the figures
are per lane. `elastic` is a string of 1000 N/m. Memory taken: calls of `operator new` in the timed loop.
`{PROGRAMS}/bench_step --benchmark_filter=step/`; instructions: `valgrind --tool=callgrind
--toggle-collect=counted_run --dump-after=counted_run {PROGRAMS}/bench_step --count step/`.

The sticks beat, the diabolo hangs on the string:

{step_table(results, "beat")}

It hops: slack, and taut with a snap:

{step_table(results, "hop")}

It flies:

{step_table(results, "flight")}

## A rollout

The beat by `rollout()`, which evaluates the spline at every step:
`{PROGRAMS}/bench_step --benchmark_filter=rollout/`.

{step_table(results, "beat", "rollout")}

## A batch

`rollout_batch` of 256 beats of 1000 steps, `consistent()` in double, with every kernel that this processor
runs: `{PROGRAMS}/bench_batch`. Valgrind knows no AVX-512, so that nothing is counted there; nor is it of two
threads, which share the same work.

{batch_table(results)}
"""


def other_part(results: dict[str, Any]) -> str:
    headers = sorted(results["compile"]["seconds"].items(), key=lambda item: -item[1])
    return f"""## Cost in the number of steps

The fastest of {results["repetitions"]} repetitions, since a processor that changes its clock between them
bends medians. In the batch all rollouts begin alike here, so that the work of a step does not change.
`{PROGRAMS}/bench_step --benchmark_filter=rollout/consistent/double/beat`, `{PROGRAMS}/bench_batch`.

{linear(results)[0]}

## Recordings

A Motive export of 20 MB with 44 columns: `{PROGRAMS}/bench_loader`.

{loader_table(results)}

## Robot

The UR5e's kinematics beside Orocos KDL's, at random joints; looking up and solving a point of the stick, for
a nominal and a calibrated arm: `{PROGRAMS}/bench_robot`. p99 is that of the wall clock.

{robot_table(results)}

## Compile time

Each header of the core (those at the top, and `math`, `string`, `paper`, `effects` and `batch` below)
alone, without optimisation, processor time, median of three:
`python -m benchmarks.speed.compile_time --core`.
The slowest five:

{table(["header", "[s]"], [[f"`{name}`", f"{seconds:.2f}"] for name, seconds in headers[:5]])}

## Against MuJoCo

Both do the same job at the same accuracy, 1 mm within 1 s:
`python -m benchmarks.speed.mujoco.compare`. Its head says what is compared and what is unfair.

{mujoco_table(results)}

The job: a point mass on an inextensible string between two moving tips, simulated for 1 s.

- `beat`: the string stays taut. `hop`: it goes slack and snaps taut.
- `mocap`: in MuJoCo a free body between two mocap bodies, as one would write it.
- `driven`: the tips are heavy bodies that get position, velocity and acceleration before each step.
- `point`: as `driven`, with the diabolo on three slides instead of a free joint.
- "-" as timestep: there is none at which this and every smaller one stay within 1 mm. The row shows the most
  accurate timestep.
"""


def page(results: dict[str, Any]) -> str:
    return f"""# Benchmarks

How fast the library is, beside other programs. A step is 1 ms of motion. Times are medians of the
processor's time, all cores together.

{opening(results)}

`make bench` writes this page. [What else there is](../benchmarks/README.md), and how long it runs.

{machine_part(results)}
{model_part(results)}
{other_part(results)}"""
