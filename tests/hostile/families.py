#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Families of hostile runs: outputs over one another and over inputs, damaged archives, nested
JSON, far times, time limits.
Usage: families.py PROGRAM [EVERY [FIRST]]

Every EVERY-th case from number FIRST on, by default all of them: half a minute of a core. For each:
it ends by itself in 20 s of a core with status 0, 1, 2 or 130 and with the one that is
expected where one is; it shows neither a trace nor a name of the program's source; inputs are as
they were, and what was written is whole.
"""
import concurrent.futures
import io
import itertools
import json
import os
import random
import re
import sys
import tempfile
import time
import zipfile

import run
from cases import GOOD, MODEL, Case, npy

FEWEST = 300
STATUSES = (0, 1, 2, 130)
SOURCE_NAMES = re.compile(r"\w::\w|terminate called|what\(\)|Aborted|core dumped|Assertion|"
                          r"error: [a-z]+_[a-z_]+: |error: [A-Z][a-z]+[A-Z]\w+: |nan %|inf %")
ANY = None  # status

TEXT_MODEL = b"state x\nstate y\ndx/dt = y\ndy/dt = -x\n"
FILES = {"r.csv": GOOD, "m.json": json.dumps(MODEL).encode(), "m.ode": TEXT_MODEL}
IDENTIFY, FIT = "identify r.csv --degree 1", "fit m.json r.csv"
DIAGNOSE = "diagnose --model m.json r.csv --max-effects 0"
SYNC, CHECK, COMPARE = "sync m.json r.csv", "check r.csv", "compare m.json r.csv"
SIMULATE = "simulate m.json --x0 1,0 --t-end 1 --dt 0.1"
BENCH = "bench r.csv --parts regressor=ols --degree 1"
PLAN = "plan m.ode --measure x=0.1 --duration 1 --candidates 1 --evaluations 1"
WRITING = {IDENTIFY: ["--model-out", "--json", "--report", "--plot"],
           DIAGNOSE: ["--model-out", "--json", "--report", "--plot"],
           FIT: ["--model-out", "--json", "--report", "--plot"],
           SYNC: ["--json", "--report", "--plot"], BENCH: ["--csv", "--report", "--plot"],
           PLAN: ["--inputs-out", "--json", "--report"], CHECK: ["--json"], COMPARE: ["--json"],
           SIMULATE: ["-o"], "export m.json --format c": ["-o"], "model m.json": ["-o"]}
LINKS = ("ln -s r.csv link.csv; ln r.csv second.csv; ln -s new to_new; ln -s to_new to_to_new;"
         "ln -s m.json link.json; ln m.json second.json; mkdir p; ln -s ../r.csv p/orbit.svg;"
         "ln -s ../m.json p/model.svg; ln -s p q")


def case(name, arguments, status=ANY, files=None, before="true"):
    return Case(name, arguments, status, "", files or FILES, before)


def output_cases():
    """A result over an input, two results to one file: refused before any work."""
    for command, options in WRITING.items():
        word = command.split()[0]
        source = "r.csv" if "r.csv" in command else "m.json"
        for option in options:
            places = (["p", "q", "./p/"] if option == "--plot" else
                      ["./" + source, "link" + source[1:], "second" + source[1:],
                       "p/../" + source])
            if option != "--plot" and command is PLAN:
                places = ["./m.ode", "p/../m.ode"]
            for place in places:
                yield case("over an input: %s %s %s" % (word, option, place),
                           "%s %s %s" % (command, option, place), 2, before=LINKS)
        for one, other in itertools.combinations(options, 2):
            if "--plot" in (one, other):
                pairs = [("f/x.svg", "f")]
            else:
                pairs = [("new", "./new"), ("new", "to_new"), ("to_to_new", "new")]
            for first, second in pairs:
                yield case("two results: %s %s %s %s %s" % (word, one, first, other, second),
                           "%s %s %s %s %s" % (command, one, first, other, second), 2,
                           before=LINKS + "; mkdir f")
    for argument in ["'*.csv'", "r.csv+r.csv", "r.csv#S", "./r.csv"]:
        yield case("over what a word means: " + argument, "check %s --json r.csv" % argument, 2)
    yield case("a dash is standard output", SIMULATE + " -o -", 0)
    yield case("over a sheet", "check 'b.xlsx#S' --json b.xlsx", 2, {"b.xlsx": workbook()})


def workbook(rows=30):
    """A workbook with one sheet S of numbers."""
    cells = "".join("<row>%s</row>" % "".join("<c><v>%.9g</v></c>" % v for v in row)
                    for row in [(0.1 * i, (i * i) % 7, i) for i in range(rows)])
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("xl/workbook.xml", '<workbook><sheets><sheet name="S" sheetId="1"/>'
                         "</sheets></workbook>")
        archive.writestr("xl/worksheets/sheet1.xml",
                         "<worksheet><sheetData>%s</sheetData></worksheet>" % cells)
    return packed.getvalue()


def arrays():
    """An .npz of times and one channel."""
    header = "{'descr': '<f8', 'fortran_order': False, 'shape': (4,), }"
    values = npy(header, b"".join(b"\0" * 6 + bytes([0xf0, 0x3f + i]) for i in range(4)))
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("t.npy", values)
        archive.writestr("x.npy", values)
    return packed.getvalue()


def damaged(data, seed):
    """Bytes changed, cut, doubled or moved."""
    chance = random.Random(seed)
    data = bytearray(data)
    for _ in range(chance.choice([1, 1, 3, 20])):
        at = chance.randrange(len(data))
        length = min(chance.choice([1, 2, 4, 40]), len(data) - at)
        kind = chance.randrange(4)
        if kind == 0:
            data[at:at + length] = bytes(chance.choice([0, 255, chance.randrange(256)])
                                         for _ in range(length))
        elif kind == 1 and len(data) > length + 4:
            del data[at:at + length]
        elif kind == 2:
            data[at:at] = data[at:at + length]
        else:
            to = chance.randrange(len(data) - length + 1)
            data[to:to + length] = data[at:at + length]
    return bytes(data)


def archive_cases():
    """Workbooks and archives of arrays with bytes changed; begins of HDF5 and MATLAB files."""
    for seed in range(24):
        yield case("workbook %d" % seed, "check 'b.xlsx#S'", ANY,
                   {"b.xlsx": damaged(workbook(), seed)})
        yield case("arrays %d" % seed, "check b.npz", ANY, {"b.npz": damaged(arrays(), seed)})
    for seed in range(8):
        noise = random.Random(seed).randbytes(2000)
        begin = b"\x89HDF\r\n\x1a\n" + bytes([seed % 4]) + b"\0" * 4 + b"\x08\x08\0" + noise
        yield case("HDF5 %d" % seed, "check b.h5", ANY, {"b.h5": begin})
        mat = b"MATLAB 5.0 MAT-file".ljust(124) + b"\0\1IM" + noise
        yield case("MATLAB %d" % seed, "check b.mat", ANY, {"b.mat": mat})


def json_cases():
    """Levels of brackets, and many keys, in every file of JSON and in --set."""
    nested = {"lists": ("[", "]"), "objects": ('{"a":', "}"), "mixed": ('{"a":[', "]}")}
    uses = {"m.json": ["model m.json", FIT, DIAGNOSE, SYNC, COMPARE, SIMULATE,
                       "export m.json --format c", CHECK + " --model m.json"],
            "c.json": [IDENTIFY + " --config c.json", DIAGNOSE + " --config c.json",
                       BENCH + " --config c.json"],
            "a.json": [PLAN + " --after a.json"]}
    for (name, commands), (kind, (open_, close)) in itertools.product(uses.items(),
                                                                     nested.items()):
        for depth, closed in [(40, True), (100000, True), (100000, False)]:
            text = open_ * depth + ("1" + close * depth if closed else "")
            command = commands[(depth + len(kind)) % len(commands)]
            yield case("%d %s%s in %s of %s" % (depth, kind, "" if closed else " left open", name,
                                                command.split()[0]),
                       command, 2, dict(FILES, **{name: text.encode()}))
    keys = "{%s}" % ",".join('"k%d":1' % i for i in range(100000))
    for name, commands in uses.items():
        for command in commands:
            yield case("100000 keys in %s of %s" % (name, command.split()[0]), command, 2,
                       dict(FILES, **{name: keys.encode()}))
    for depth in [33, 20000]:
        for path in ["basis", "regressor.threshold"]:
            yield case("--set %s=%d brackets" % (path, depth), "%s --set '%s=%s%s'" % (
                IDENTIFY, path, "[" * depth, "]" * depth), 2)


def record(begin, step, n=40):
    rows = ["%r,%r,%r" % (begin + step * i, ((i * 7919) % 97) / 97.0, ((i * 31) % 17) / 17.0)
            for i in range(n)]
    return ("t,x,y\n" + "\n".join(rows) + "\n").encode()


def time_cases():
    """Times far from 0, steps far from 1, events, delays and initial values of such times."""
    columns = [(1e17, 1e3), (-1e300, 1e290), (1e308, 1e300), (-1e17, 16.0), (1e12, 1e-3),
               (0.0, 1e-300), (0.0, 1e300), (-1e-300, 1e-302)]
    commands = [IDENTIFY, FIT, DIAGNOSE, SYNC, CHECK, COMPARE, BENCH, PLAN + " --data r.csv"]
    for (begin, step), command in itertools.product(columns, commands):
        yield case("times from %g by %g: %s" % (begin, step, command.split()[0]), command, ANY,
                   dict(FILES, **{"r.csv": record(begin, step)}))
    statements = ["every 1 from -1e17: x += 1", "every 1 from -1e300: x += 1",
                  "every 1e-300: x += 1", "every 1e300 from -1e300: x += 1", "at 1e300: x += 1",
                  "at -1e300: x = 0", "every 1 until 1e300: x += 1", "initial x = 1 at -1e300",
                  "initial x = 1 at 1e17", "initial x = 1e300", "param k = 1e300 in -1e300..1e300"]
    for statement in statements:
        files = dict(FILES, **{"m.ode": TEXT_MODEL + statement.encode() + b"\n"})
        for command in ["simulate m.ode --x0 1,0 --t-end 1 --dt 0.1", "model m.ode",
                        "simulate m.ode --t-end 1 --dt 0.1", "fit m.ode r.csv"]:
            yield case("%s: %s" % (statement, command.split()[0]), command, ANY, files)
    for times in ["--t-start 1e17 --t-end 1.1e17 --dt 1e15", "--t-start -1e300 --t-end 1 --dt 1e299",
                  "--t-end 1e-300 --dt 1e-301", "--t-end 1e300 --dt 1e299", "--t-end nan --dt 1",
                  "--t-start 1e17 --t-end 100000000000000016 --dt 1"]:
        yield case("simulate " + times, "simulate m.json --x0 1,0 " + times, ANY)


def limit_cases():
    """Time limits with every option of the commands that have one."""
    common = ["", "--threads 2", "--effort quick", "--effort full", "--holdout r.csv", "--json -",
              "--report p.html", "--model-out n.json", "--seed 3"]
    options = {"identify r.csv": common + ["--preset robust", "--preset paper", "--alternatives 3",
                                           "--hidden 1", "--explain", "--degree 5",
                                           "--set refiner=none", "--memory 16M"],
               "diagnose --model m.json r.csv": common + ["--each", "--max-effects 1", "--explain",
                                                          "--effect linear-term", "--fill-gap"],
               "fit m.json r.csv": common + ["--profile", "--bands", "--starts 10", "--ahead 2"],
               SYNC: ["", "--integrator rk4", "--json -", "--report p.html", "--coupling x=1"],
               COMPARE: ["", "--integrator dopri8", "--json -"],
               "simulate m.json --x0 1,0 --t-end 1e6 --dt 0.1": ["", "-o new", "--noise x=1"],
               "plan m.ode --measure x=0.1 --duration 10": ["", "--runs 3", "--safe x=-9..9",
                                                            "--data r.csv", "--json -"],
               "bench r.csv --parts regressor=ols,stlsq": ["", "--noise 0,1 --draws 20", "--csv -",
                                                           "--report p.html"]}
    for command, its in options.items():
        for option, limit in itertools.product(its, ["0.001", "0.02", "1"]):
            yield case("%s in %s s: %s" % (command.split()[0], limit, option),
                       "%s %s --time-limit %s" % (command, option, limit))


def all_cases():
    for family in [output_cases, archive_cases, json_cases, time_cases, limit_cases]:
        for one in family():
            one.name = family.__name__.split("_")[0] + ": " + one.name
            yield one


def written_faults(one, status, folder):
    """What stands there half written, or after an error."""
    found = []
    for name in ["p.html", "n.json", "new"]:
        path = os.path.join(folder, name)
        if not os.path.isfile(path):
            continue
        text = run.read(path)
        if status == 2:
            found.append("wrote %s in spite of its error" % name)
        elif name == "n.json" and not text.rstrip().endswith(b"}"):
            found.append("half of " + name)
        elif name == "p.html" and b"</html>" not in text[-20:]:
            found.append("half of " + name)
    return found


def faults(one, result, folder):
    status, core, out, err = result
    shown = (out + err).decode("utf-8", "replace")
    expected = STATUSES if one.status is ANY else (one.status,)
    found = [] if status in expected else ["status %s" % status]
    if core > run.LONGEST:
        found.append("takes %.0f s of a core" % core)
    name = SOURCE_NAMES.search(shown)
    if name:
        found.append("shows %r" % name.group())
    if status == 2:
        found += run.error_faults(err)
    found += ["leaves " + name for name in os.listdir(folder) if name.endswith(".tmp")]
    found += ["changed " + name for name, content in one.files.items()
              if run.read(os.path.join(folder, name)) != content]
    return found + written_faults(one, status, folder)


def examine(program, one):
    """What is wrong with one case, its message, and the seconds of a core that it took."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in one.files.items():
            with open(os.path.join(folder, name), "wb") as stream:
                stream.write(content)
        result = run.run(program, one, folder)
        return faults(one, result, folder), result[3], result[1]


def main():
    program = os.path.abspath(sys.argv[1])
    everything = list(all_cases())
    every = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    first = int(sys.argv[3]) % every if len(sys.argv) > 3 else 0
    chosen = everything[first::every]
    begin, mishandled, core = time.monotonic(), 0, 0.0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for one, (wrong, err, used) in zip(chosen, pool.map(lambda c: examine(program, c), chosen)):
            core += used
            if wrong:
                mishandled += 1
                print("%s: %s\n    %s\n    %s" % (ascii(one.name), "; ".join(wrong),
                                                 ascii(one.arguments[:150]), ascii(err[:300])),
                      flush=True)
    print("%d of %d runs, %d mishandled, %.0f s, %.0f s of a core" % (
        len(chosen), len(everything), mishandled, time.monotonic() - begin, core))
    if len(everything) < FEWEST:
        print("fewer than %d runs" % FEWEST)
    return 1 if mishandled or len(everything) < FEWEST else 0


if __name__ == "__main__":
    sys.exit(main())
