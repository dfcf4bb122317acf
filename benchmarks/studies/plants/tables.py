# SPDX-License-Identifier: MIT
"""Tables of the parts as files, and the page of all."""

import csv
import datetime
import os
import pathlib
import platform
import statistics

COLUMNS = {
    "plants": (
        "case",
        "kept",
        "shape",
        "drive",
        "dead time s",
        "judged",
        "verdict",
        "free run %",
        "expert %",
        "over expert",
        "seconds",
        "answer",
    ),
    "swings": (
        "case",
        "kept",
        "kind",
        "steps",
        "amplitude",
        "stiffness",
        "damping",
        "judged",
        "verdict",
        "seconds",
        "answer",
    ),
    "fits": (
        "case",
        "kept",
        "kind",
        "judged",
        "largest error in sigma",
        "seconds",
        "truth",
        "answer",
        "verdict",
    ),
    "experts": ("case", "model", "free run %", "with the truth %", "numbers", "truth"),
    "peers": ("case", "method", "judged", "free run %", "seconds", "answer"),
    "recordings": (
        "case",
        "options",
        "verdict",
        "free run %",
        "expert %",
        "over expert",
        "seconds",
        "answer",
    ),
    "recorded_experts": (
        "case",
        "structure",
        "fit %",
        "free run %",
        "channels alone %",
        "numbers",
    ),
}
TITLES = {
    "plants": "Plants: `identify`",
    "swings": "Swings: `identify --embed th=2`",
    "fits": "Models of known structure: `fit`",
    "experts": "Experts",
    "peers": "Other programs on the plants",
    "recordings": "Recordings of machines: `identify`",
    "recorded_experts": "Experts of the recordings",
}
EXPERTS_OF = {"plants": "experts", "recordings": "recorded_experts"}


def write_table(folder, part, rows):
    with open(folder / f"{part}.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS[part], restval="")
        writer.writeheader()
        writer.writerows({key: "" if v is None else v for key, v in row.items()} for row in rows)


def read_table(folder, part):
    path = folder / f"{part}.csv"
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def compare_with_experts(folder):
    """Writes what experts reach beside the plants and the recordings."""
    for part, of in EXPERTS_OF.items():
        experts = {row["case"]: row["free run %"] for row in read_table(folder, of)}
        rows = read_table(folder, part)
        for row in rows:
            row["expert %"] = experts.get(row["case"], "")
            ratio = number(row["free run %"]) / (number(row["expert %"]) or float("inf"))
            row["over expert"] = f"{ratio:.3g}" if 0 < ratio < float("inf") else ""
        if rows:
            write_table(folder, part, rows)


def lines_of(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    return lines + [
        "| " + " | ".join(str(cell).replace("|", "/") for cell in row) + " |" for row in rows
    ]


def median(values):
    return f"{statistics.median(values):.3g}" if values else ""


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return float("inf")


def summary(tables):
    """Right answers of each part, those in use and those kept."""
    header = ["part", "cases", "right", "fits to the noise, not right", "median s", "longest s"]
    rows = []
    for part in ("plants", "swings", "fits"):
        for name, mark in ((f"{part} in use", ""), (f"{part} kept", "kept")):
            chosen = [row for row in tables[part] if row["kept"] == mark]
            if not chosen:
                continue
            right = [row for row in chosen if row["judged"] == "right"]
            false = [r for r in chosen if r["verdict"] == "fits to noise" and r not in right]
            seconds = [float(row["seconds"]) for row in chosen]
            false = "" if part == "fits" else len(false)
            cells = [name, len(chosen), len(right), false]
            rows.append([*cells, median(seconds), f"{max(seconds):.3g}"])
    return lines_of(header, rows)


def compared(tables):
    """Structure, free run and seconds of the plants by method."""
    rows = []
    lacuna = [row | {"method": "lacuna identify"} for row in tables["plants"]]
    experts = {row["case"]: number(row["free run %"]) for row in tables["experts"]}
    every = lacuna + tables["peers"]
    for method in dict.fromkeys(row["method"] for row in every):
        chosen = [row for row in every if row["method"] == method]
        ratios = [number(row["free run %"]) / experts[row["case"]] for row in chosen if experts]
        seconds = [number(row["seconds"]) for row in chosen]
        cells = [method, len(chosen), sum(row["judged"] == "right" for row in chosen)]
        cells += [median([number(row["free run %"]) for row in chosen]), median(ratios)]
        cells += [sum(ratio < 2 for ratio in ratios), median(seconds)]
        rows.append(cells)
    header = ["method", "plants", "right", "median free run %", "median over the expert's"]
    return lines_of([*header, "below twice the expert's", "median s"], rows)


def machine():
    """The processor and the number of its cores."""
    path = pathlib.Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.exists() else []
    models = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return f"{(models or [platform.machine()])[0]}, {os.cpu_count()} cores"


def write_page(folder, numpy):
    tables = {part: read_table(folder, part) for part in COLUMNS}
    lines = ["# Plants, swings and fits", "", *summary(tables), ""]
    if tables["plants"] and tables["experts"]:
        lines += ["## Free runs of the plants", "", *compared(tables), ""]
    for part, columns in COLUMNS.items():
        if not tables[part]:
            continue
        lines += [f"## {TITLES[part]}", ""]
        rows = ([row.get(column, "") for column in columns] for row in tables[part])
        lines += [*lines_of(columns, rows), ""]
    day = datetime.date.today().isoformat()
    lines.append(
        f"Seconds of one thread; {machine()}, Python {platform.python_version()}, "
        f"NumPy {numpy}, {day}. Command: "
        "`python3 benchmarks/studies/plants/run.py PROGRAM FOLDER`"
    )
    (folder / "plants.md").write_text("\n".join(lines) + "\n")
