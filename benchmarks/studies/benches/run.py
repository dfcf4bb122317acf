#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Diagnoses of simulated benches, each with what holds.

    python3 benchmarks/studies/benches/run.py PROGRAM FOLDER [KIND...]

Writes the records of each bench to FOLDER, runs `PROGRAM diagnose` on the first 60 % of each, with
the rest as comparison, and writes FOLDER/benches.csv and benches.md. Two draws of each kind.
Needs NumPy.
"""

import collections
import csv
import datetime
import json
import pathlib
import resource
import subprocess
import sys
import zlib

import numpy as np

import afterwards  # noqa: F401  registers its benches
import approximated  # noqa: F401
import coupled  # noqa: F401
import fresh  # noqa: F401
import later  # noqa: F401
import machines  # noqa: F401
import passing  # noqa: F401
import plants  # noqa: F401
import untouched  # noqa: F401
from benches import BEYOND, KINDS

DRAWS = 2


def write_part(path, bench, begin, end):
    columns = [bench.time[begin:end] - bench.time[begin]]
    columns += [x[begin:end] for x in (*bench.channels.values(), *bench.inputs.values())]
    unit = bench.model.split()[1]
    header = [f"t [{unit}]", *bench.channels, *bench.inputs]
    lines = [",".join(f"{value:.7g}" for value in row) for row in zip(*columns)]
    path.write_text("\n".join([",".join(header), *lines]) + "\n")


def write_bench(folder, name, draw):
    seed = np.random.SeedSequence([zlib.crc32(name.encode()), draw])
    bench = KINDS[name].make(np.random.default_rng(seed))
    folder.mkdir(parents=True, exist_ok=True)
    count = len(bench.time)
    cut = int(0.6 * count)
    write_part(folder / "a.csv", bench, 0, cut)
    write_part(folder / "b.csv", bench, cut, count)
    (folder / "m.ode").write_text(bench.model)


def diagnose(program, folder):
    """The answer, or what stood on standard error; and user seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    answer = folder / "answer.json"
    answer.unlink(missing_ok=True)
    command = [program, "diagnose", "--model", "m.ode", "a.csv", "--holdout", "b.csv"]
    command += ["--threads", "1", "--json", "answer.json"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=900)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    (folder / "answer.txt").write_text(done.stdout + done.stderr)
    return (
        json.loads(answer.read_text()) if done.returncode == 0 else done.stderr.strip()
    ), seconds


def judge(kind, answer):
    """right, no name, false name, or false explained."""
    names = [f"{effect['equation']}:{effect['name']}" for effect in answer["effects"]]
    complete = answer["verdict"] in ("coefficients-only", "consistent")
    false = [name for name in names if name not in kind.lacks + kind.also]
    if false:
        return "false explained" if answer["verdict"] == "explained" else "false name"
    if not kind.lacks:
        return "right"
    if kind.lacks == BEYOND:
        return "false explained" if complete else "right"
    if any(name in kind.lacks for name in names):
        return "right"
    return "false explained" if complete else "no name"


def gap(answer):
    found = answer.get("gap") or {}
    return [found.get(name) for name in ("before", "after", "noise_floor")]


def row_of(name, draw, program, folder):
    kind = KINDS[name]
    write_bench(folder, name, draw)
    answer, seconds = diagnose(program, folder)
    row = {"kind": name, "group": kind.group, "draw": draw, "seconds": f"{seconds:.2f}"}
    row["holds"] = "nothing is missing" if not kind.lacks else " or ".join(kind.lacks)
    if kind.lacks == BEYOND:
        row["holds"] = "something without a name"
    if isinstance(answer, str):
        return row | {"judged": "no name", "verdict": "error", "names": answer}
    names = "; ".join(f"{e['equation']}:{e['name']} {e['term']}" for e in answer["effects"])
    gaps = ["" if value is None else f"{100 * value:.3g}" for value in gap(answer)]
    row |= {"judged": judge(kind, answer), "verdict": answer["verdict"], "names": names}
    return row | dict(zip(("gap before %", "after %", "noise %"), gaps))


COLUMNS = (
    "kind",
    "group",
    "draw",
    "holds",
    "judged",
    "verdict",
    "names",
    "gap before %",
    "after %",
    "noise %",
    "seconds",
)


def summary(rows):
    lines = [
        "| kinds | records | right | no name | false name | false explained "
        "| median s | longest s |"
    ]
    lines.append("| --- " * 8 + "|")
    for group in dict.fromkeys(kind.group for kind in KINDS.values()):
        chosen = [row for row in rows if row["group"] == group]
        if not chosen:
            continue
        counts = collections.Counter(row["judged"] for row in chosen)
        seconds = [float(row["seconds"]) for row in chosen]
        cells = [
            group,
            len(chosen),
            *(counts[name] for name in ("right", "no name", "false name", "false explained")),
        ]
        cells += [f"{np.median(seconds):.2f}", f"{max(seconds):.2f}"]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return lines


def write_tables(rows, folder):
    with open(folder / "benches.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, restval="")
        writer.writeheader()
        writer.writerows(rows)
    lines = [
        "# Benches",
        "",
        *summary(rows),
        "",
        "| " + " | ".join(COLUMNS) + " |",
        "| --- " * len(COLUMNS) + "|",
    ]
    for row in rows:
        lines.append(
            "| " + " | ".join(str(row.get(name, "")).replace("|", "/") for name in COLUMNS) + " |"
        )
    day = datetime.date.today().isoformat()
    lines += [
        "",
        f"Seconds of one thread, {day}. "
        "Command: `python3 benchmarks/studies/benches/run.py PROGRAM FOLDER`",
    ]
    (folder / "benches.md").write_text("\n".join(lines) + "\n")


def main():
    program, folder = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    names = sys.argv[3:] or list(KINDS)
    rows = []
    for name in names:
        for draw in range(1, DRAWS + 1):
            rows.append(row_of(name, draw, program, folder / f"{name}_{draw}"))
            print(
                *(
                    rows[-1].get(c, "")
                    for c in ("kind", "draw", "judged", "verdict", "names", "seconds")
                ),
                sep=" | ",
                flush=True,
            )
    write_tables(rows, folder)


if __name__ == "__main__":
    main()
