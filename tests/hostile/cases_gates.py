# SPDX-License-Identifier: MIT
"""Values of options and places of files that nobody should give, over all commands."""
import json

from cases import GOOD, MODEL, Case, oscillation

INPUT_MODEL = dict(MODEL, inputs=[{"name": "u"}])
INPUT_MODEL["equations"] = MODEL["equations"][:1] + [
    {"state": "y", "terms": [{"term": "x", "coefficient": -1.0}, {"term": "u", "coefficient": 1.0}]}]
FILES = {"r.csv": GOOD, "m.json": json.dumps(MODEL).encode(), "o.csv": oscillation(40),
         "d.json": json.dumps(INPUT_MODEL).encode(),
         "u.csv": GOOD.replace(b"t,x,y", b"t,u,v")}

# What each command needs at least to come to an answer.
IDENTIFY, FIT = "identify r.csv --degree 1", "fit m.json r.csv"
DIAGNOSE = "diagnose --model m.json r.csv --max-effects 0"
SYNC, CHECK, COMPARE = "sync m.json r.csv", "check r.csv", "compare m.json r.csv"
SIMULATE = "simulate m.json --x0 1,0 --t-end 1 --dt 0.1"
READING = [IDENTIFY, DIAGNOSE, FIT, SYNC, CHECK, COMPARE]
WRITING = [(IDENTIFY, "--model-out"), (IDENTIFY, "--json"), (IDENTIFY, "--report"),
           (DIAGNOSE, "--model-out"), (DIAGNOSE, "--json"), (DIAGNOSE, "--report"),
           (FIT, "--model-out"), (FIT, "--json"), (FIT, "--report"), (SYNC, "--json"),
           (SYNC, "--report"), (CHECK, "--json"), (COMPARE, "--json"), (SIMULATE, "--output"),
           ("export m.json --format c", "--output"), ("model m.json", "--output")]

NO_COUNT = ["-1", "1.5", "nan", "x", "1e400", "99999999999999999999999", "''"]
NO_SIZE = ["-1", "nan", "inf", "1e400", "x", "''"]


def case(name, arguments, status=2, part="", **more):
    return Case("gates: " + name, arguments, status, part, FILES, **more)


def value_cases():
    """Numbers that are none, or out of their range, option by option."""
    for command in READING:
        for option, values in {"--seed": NO_COUNT, "--dt": NO_SIZE + ["0"]}.items():
            for value in values[::2]:
                yield case("%s %s %s" % (command.split()[0], option, value),
                           "%s %s=%s" % (command, option, value), 2,
                           "step" if value in ["-1", "inf", "0"] and option == "--dt" else option)
    for option, values in {"--start-samples": NO_COUNT + ["0"], "--ahead": NO_COUNT + ["0"],
                           "--restarts": NO_COUNT + ["101"], "--starts": NO_COUNT}.items():
        for value in values:
            yield case("fit %s %s" % (option, value), "%s %s=%s" % (FIT, option, value), 2, option)
    for value in NO_COUNT + ["21"]:
        yield case("diagnose --max-effects " + value,
                   "diagnose --model m.json r.csv --max-effects=" + value, 2, "--max-effects")
    for value in ["0", "2", "-1", "x", "''", "nan"]:
        yield case("identify --hidden " + value, "identify r.csv --hidden=" + value, 2, "--hidden")
    for value in ["x", "x=", "x=-1", "x=nan", "x=inf", "=1", "q=1", "x=1=2", "''"]:
        yield case("simulate --noise " + value, "%s --noise=%s" % (SIMULATE, value), 2, "--noise")
    for value in ["nan", "inf", "x", "''", "2"]:  # the end comes first
        yield case("simulate --t-start " + value, "%s --t-start=%s" % (SIMULATE, value), 2, "t-start")
    for value in ["u", "u=", "u=none", "=zero", "x=zero", "''"]:
        yield case("simulate --hold " + value,
                   "simulate d.json --x0 1,0 --t-end 1 --dt .1 --input-data u.csv --hold=" + value,
                   2, "--hold")
    for value, part in {"x": "--map", "=x": "NAME=COLUMN", "x=": "no column ''", "''": "--map",
                        "x=none": "no column 'none'", "x=99": "no column '99'",
                        "x=-1": "no column '-1'"}.items():
        yield case("fit --map " + value, "%s --map=%s" % (FIT, value), 2, part)


def repeated_cases():
    """What can be given once is refused the second time."""
    for command, option in [(IDENTIFY, "--degree 1"), (IDENTIFY, "--seed 1"), (FIT, "--ahead 5"),
                            (FIT, "--json a --json"), (SYNC, "--dt 0.1"), (SIMULATE, "--t-end 2"),
                            (SIMULATE, "--x0 1,0"), (COMPARE, "--integrator rk4"),
                            (CHECK, "--model m.json"), (DIAGNOSE, "--model m.json")]:
        yield case("twice: %s %s" % (command.split()[0], option),
                   "%s %s %s" % (command, option, option), 2, option.split()[0])


def unknown_cases():
    """Words that no command knows, and options of another command."""
    for command, words in {
            IDENTIFY: ["--jsn a", "--x0 1,0", "--holdout", "--differentiator none"],
            DIAGNOSE: ["--degree 1", "--efect none", "--differentiator none"],
            FIT: ["--degree 1", "--preset robust"], SYNC: ["--report", "--cupling x=1"],
            CHECK: ["--model none", "--differentiator none"], COMPARE: ["o.csv --json", "--report a"],
            "compare r.csv o.csv": ["--integrator none"],
            SIMULATE: ["--json a", "r.csv"], "list": ["--json a", "basis filter"],
            "describe": ["ols none", "--json a"], "completion": ["fish", "bash zsh", ""],
            "model m.json": ["r.csv", "--format c"],
            "export m.json": ["", "--format none", "--format ''", "--format C --format c"]}.items():
        for word in words:
            yield case("unknown: %s %s" % (command.split()[0], word), command + " " + word)


def source_cases():
    """Places from which nothing can be read."""
    before = ("ln -s b a; ln -s a b; mkdir folder; touch empty empty.json empty.ode; "
              "ln -s /proc/self/mem memory; ln -s gone.csv gone")
    long_name = "n" * 5000
    for command in ["identify %s --degree 1", "diagnose --model m.json %s", "fit m.json %s",
                    "sync m.json %s", "check %s", "compare m.json %s", "compare %s r.csv"]:
        for place in ["a", "folder", "empty", "gone", "memory", "r.csv/x", long_name, "none*.csv"]:
            yield case("from %.8s: %s" % (place, command % "it"), command % place, 2,
                       place[:8], before=before)
    for command in ["diagnose --model %s r.csv", "fit %s r.csv", "sync %s r.csv",
                    "check r.csv --model %s", "simulate %s --x0 1,0 --t-end 1 --dt 0.1",
                    "export %s --format c", "model %s"]:
        for place in ["a", "folder", "empty.json", "empty.ode", "gone", "m.json/x", "r.csv"]:
            yield case("model from %s: %s" % (place, command % "it"), command % place, 2,
                       place, before=before)
    for option in ["--holdout none.csv", "--holdout folder", "--config a", "--config folder",
                   "--config empty"]:
        yield case("identify " + option, "%s %s" % (IDENTIFY, option), 2, option.split()[1],
                   before=before)
    for place in ["a", "folder", "empty", "gone"]:
        yield case("input from " + place,
                   "simulate d.json --x0 1,0 --t-end 1 --dt .1 --input-data " + place, 2, place,
                   before=before)


def pipe_cases():
    """Pipes are read like files; one that nobody fills any more is an empty file."""
    for command in ["identify p --degree 1", "check p", "fit m.json p", "sync m.json p"]:
        yield case("pipe: " + command, command, 0, "", before="mkfifo p; (cat r.csv > p &)")
        yield case("empty pipe: " + command, command, 2, "p", before="mkfifo p; (true > p &)")
    yield case("pipe: model", "model p", 0, "", before="mkfifo p; (cat m.json > p &)")
    yield case("pipe as standard input", "identify /dev/stdin --degree 1", 0, "Equations",
               before="exec < <(cat r.csv)")


def target_cases():
    """Places to which nothing can be written, and results that would replace what is read."""
    before = "mkdir folder; ln -s b a; ln -s a b; ln -s r.csv link.csv; ln r.csv second.csv"
    for command, option in WRITING:
        word = command.split()[0]
        source = "m.json" if "m.json" in command else "r.csv"
        for place in ["none/x.json", "folder", "a", "/proc/none.json", "./" + source]:
            yield case("%s %s to %s" % (word, option, place),
                       "%s %s %s" % (command, option, place), 2, "", before=before)
    for command in [IDENTIFY + " --json", SYNC + " --json", CHECK + " --json",
                    "simulate d.json --x0 1,0 --t-end 1 --dt .1 --input-data r.csv --map u=x -o"]:
        for place in ["link.csv", "second.csv", "folder/../r.csv"]:
            yield case("%s over %s" % (command.split()[0], place), command + " " + place, 2,
                       place, before=before)
    for command, option in [(IDENTIFY, "--json a.out --report a.out"), (FIT, "--json a.out --model-out a.out"),
                            (DIAGNOSE, "--json - --report -"), (IDENTIFY, "--json x --report ./x")]:
        yield case("two to one: %s %s" % (command.split()[0], option),
                   "%s %s" % (command, option), 2, "")
    for command in [IDENTIFY, DIAGNOSE, FIT]:
        yield case("pictures over a file: " + command.split()[0], command + " --plot r.csv", 2,
                   "r.csv")


def cases():
    for some in [value_cases, repeated_cases, unknown_cases, source_cases, pipe_cases,
                 target_cases]:
        yield from some()
