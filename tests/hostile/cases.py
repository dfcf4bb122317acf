# SPDX-License-Identifier: MIT
"""Inputs that nobody should give: files, options, models, configurations, environments.

Each case is what a shell would run, with the files it needs, the status it must end with and a
part of its message. What holds for all of them is checked in run.py.
"""
import gzip
import json
import math
import struct
from dataclasses import dataclass, field


@dataclass
class Case:
    name: str
    arguments: str                     # of lacuna, as a shell reads them; in the case's folder
    status: int = 2
    part: str = ""                     # of the message, or of the result where status is 0
    files: dict = field(default_factory=dict)
    before: str = "true"               # run first in the same shell
    out: str = "out"                   # where standard output goes


def oscillation(n=60, header="t,x,y", row="{:.6f},{:.9f},{:.9f}"):
    lines = [row.format(0.1 * i, math.cos(0.1 * i), -math.sin(0.1 * i)) for i in range(n)]
    return (header + "\n" + "\n".join(lines) + "\n").encode()


GOOD = oscillation()
MODEL = {
    "format": "lacuna.model/1", "time_unit": "s",
    "states": [{"name": "x"}, {"name": "y"}], "inputs": [],
    "equations": [{"state": "x", "terms": [{"term": "y", "coefficient": 1.0}]},
                  {"state": "y", "terms": [{"term": "x", "coefficient": -1.0}]}]}


def changed(path, value):
    """The model with one value replaced; a path like ("states", 0, "name")."""
    model = json.loads(json.dumps(MODEL))
    place = model
    for key in path[:-1]:
        place = place[key]
    if value is DELETE:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return json.dumps(model).encode()


DELETE = object()


def npy(header, data=b"", version=b"\x01\x00"):
    text = header.encode("latin-1")
    return b"\x93NUMPY" + version + struct.pack("<H", len(text)) + text + data


def table_cases():
    good = GOOD.decode()
    head, *rows = good.splitlines()
    bad = {
        "empty": b"", "blank": b"\n\n \n", "comments": b"# a\n# b\n", "header": b"t,x,y\n",
        "one-row": b"t,x\n0,1\n", "two-rows": b"t,x\n0,1\n1,2\n",
        "ragged-short": (good + "6,1\n").encode(), "ragged-long": (good + "6,1,1,1\n").encode(),
        "text": (good + "6,one,1\n").encode(), "hex": (good + "6,0x1g,1\n").encode(),
        "infinite": (good + "6,inf,1\n").encode(), "huge": (good + "6,1e400,1\n").encode(),
        "minus-infinite": (good + "6,1,-inf\n").encode(),
        "backwards": (good + "1,1,1\n").encode(),
        "often-the-same-time": (good + 9 * (rows[-1] + "\n")).encode(),
        "infinite-time": (good + "inf,1,1\n").encode(),
        "twice-named": good.replace("t,x,y", "t,x,x").encode(),
        "twice-after-cleaning": good.replace("t,x,y", "t,a b,a-b").encode(),
        "header-short": good.replace("t,x,y", "t,x").encode(),
        "header-long": good.replace("t,x,y", "t,x,y,z").encode(),
        "only-blanks": b"t,x\n0,\n1,\n2,\n3,\n", "only-nan": b"t,x\n0,nan\n1,nan\n2,nan\n",
        "binary": bytes(range(256)) * 20, "utf16-unmarked": GOOD.decode().encode("utf-16-le"),
        "utf16-cut": GOOD.decode().encode("utf-16")[:9], "utf32": GOOD.decode().encode("utf-32"),
        "matlab": b"MATLAB 5.0 MAT-file" + bytes(200), "hdf5": b"\x89HDF\r\n\x1a\n" + bytes(200),
        "png": b"\x89PNG\r\n\x1a\n" + bytes(200), "zip": b"PK\x03\x04" + bytes(200),
        "gz-cut": gzip.compress(GOOD)[:-20], "gz-header": b"\x1f\x8b", "gz-short": b"\x1f\x8b\x08\0",
        "gz-damaged": gzip.compress(GOOD)[:30] + b"\xff" * 40, "gz-empty": gzip.compress(b""),
        "gz-in-gz": gzip.compress(gzip.compress(GOOD)),
        "one-line": GOOD.replace(b"\n", b","), "quote-open": GOOD + b'6,"1,1\n',
        "decimal-comma-mix": GOOD + b"6;1;1\n",
        "json": json.dumps(MODEL).encode(), "xml": b"<xml><a/></xml>\n" * 20,
        "very-long-field": b"t,x\n0," + b"9" * 100000 + b"e9\n1,1\n2,2\n",
    }
    for name, content in bad.items():
        yield Case("table-" + name, "identify r.csv", 2, "r.csv", {"r.csv": content})
    fine = {
        "crlf": GOOD.replace(b"\n", b"\r\n"), "cr": GOOD.replace(b"\n", b"\r"),
        "bom": b"\xef\xbb\xbf" + GOOD, "semicolon": GOOD.replace(b",", b";"),
        "tabs": GOOD.replace(b",", b"\t"), "blanks": GOOD.replace(b",", b"  "),
        "decimal-comma": GOOD.replace(b",", b";").replace(b".", b","),
        "nul-row": GOOD + b"6,\0,1\n", "utf16": GOOD.decode().encode("utf-16"),
        "utf16-big": b"\xfe\xff" + GOOD.decode().encode("utf-16-be"),
        "no-last-newline": GOOD[:-1], "empty-lines": GOOD.replace(b"\n", b"\n\n"),
        "trailing-delimiter": GOOD.replace(b"\n", b",\n"), "plus": GOOD.replace(b",0.", b",+0."),
        "gz": gzip.compress(GOOD), "gz-two": gzip.compress(GOOD[:300]) + gzip.compress(GOOD[300:]),
        "latin1": GOOD.replace(b"t,x,y", b"t [s],\xfcber [\xb0C],y"),
        "escape": GOOD.replace(b"t,x,y", b"t,x\x1b[31m [V\x1b],y"),
        "odd-names": GOOD.replace(b"t,x,y", b"t,sin,pi"), "no-header": GOOD[6:],
        "missing": GOOD.replace(b",0.995004165", b","), "preamble": b"Scope 3\nmodel,7\n" + GOOD,
        "repeated-row": (good + rows[-1] + "\n").encode(),
        "dates": b"t,x,y\n" + b"".join(b"2024-01-%02d,%s\n" % (d + 1, rows[d].split(",", 1)[1].encode())
                                       for d in range(28)),
    }
    for name, content in fine.items():
        yield Case("table-" + name, "identify r.csv --degree 1", 0, "Equations",
                   {"r.csv": content})
    dictionary = "{'descr': '%s', 'fortran_order': %s, 'shape': %s, }\n"
    values = struct.pack("<180d", *[v for i in range(60) for v in
                                    (0.1 * i, math.cos(0.1 * i), -math.sin(0.1 * i))])
    for name, content in {
        "empty": b"", "magic": b"\x93NUMPY", "cut": npy(dictionary % ("<f8", False, "(60, 3)")),
        "version": npy("x", version=b"\x09\0"), "no-dictionary": npy("nothing"),
        "negative": npy(dictionary % ("<f8", False, "(-1, 3)"), values),
        "overflow": npy(dictionary % ("<f8", False, "(9223372036854775807, 9)"), values),
        "zero": npy(dictionary % ("<f8", False, "(0, 3)")),
        "cube": npy(dictionary % ("<f8", False, "(3, 4, 5)"), values),
        "object": npy(dictionary % ("|O", False, "(60, 3)"), values),
        "complex": npy(dictionary % ("<c16", False, "(30, 3)"), values),
        "text": npy(dictionary % ("<U8", False, "(60, 3)"), values),
        "wide": npy(dictionary % ("<f99999999999999999999", False, "(60, 3)"), values),
        "open": npy("{'descr': '<f8', 'shape': (60, 3", values),
        "no-shape": npy("{'descr': '<f8', 'fortran_order': False}", values),
        "nan-time": npy(dictionary % ("<f8", False, "(60, 3)"),
                        struct.pack("<d", math.inf) + values[8:]),
    }.items():
        yield Case("npy-" + name, "identify r.npy", 2, "r.npy", {"r.npy": content})
    yield Case("npy-good", "identify r.npy --degree 1", 0, "Equations",
               {"r.npy": npy(dictionary % ("<f8", False, "(60, 3)"), values)})


def model_cases():
    simulate = "simulate m.json --x0 1,0 --t-end 1 --dt 0.1"
    nested = b'{"a":' + b"[" * 100000 + b"]" * 100000 + b"}"
    whole = json.dumps(MODEL).encode()
    for name, content in {
        "empty": b"", "blank": b" \n", "list": b"[]", "number": b"1", "null": b"null",
        "open": whole[:-1], "two": whole + whole, "comma": whole.replace(b"[]", b"[,]"),
        "nested": nested, "binary": bytes(range(256)), "nul": whole.replace(b'"x"', b'"x\0"'),
        "overflow": whole.replace(b"-1.0", b"1e999"), "nan": whole.replace(b"-1.0", b"NaN"),
        "infinity": whole.replace(b"-1.0", b"Infinity"), "utf8": whole.replace(b'"s"', b'"\xff"'),
        "twice": whole.replace(b'"inputs"', b'"states": [], "inputs"'),
        "surrogate": whole.replace(b'"s"', b'"\\ud800"'), "comment": b"// a\n" + whole,
    }.items():
        yield Case("model-" + name, simulate, 2, "m.json", {"m.json": content})
    for path in [("format",), ("states",), ("equations",), ("states", 0, "name"),
                 ("equations", 0, "state"), ("equations", 0, "terms"), ("equations", 0),
                 ("equations", 0, "terms", 0, "term"),
                 ("equations", 0, "terms", 0, "coefficient")]:
        for kind, value in {"missing": DELETE, "null": None, "number": 7, "list": [[]],
                            "object": {"a": 1}}.items():
            if path[-1] == "coefficient" and kind == "number":
                continue
            yield Case("model-%s-%s" % ("-".join(map(str, path)), kind), simulate, 2, "m.json",
                       {"m.json": changed(path, value)})
    for name in ["", " ", "x y", "1x", "sin", "pi", "y", "\u00e4", "x\u001b[31m", "t", "x" + "\n"]:
        yield Case("model-name-%r" % name, simulate, 2, "m.json",
                   {"m.json": changed(("states", 0, "name"), name)})
    for unit in ["\u001b[31m", "\u0000", "a\nb", "\u009b31m"]:
        yield Case("model-unit-%r" % unit, simulate, 2, "$.states[0].unit",
                   {"m.json": changed(("states", 0, "unit"), unit)})
    for term in ["", " ", "q", "x+", "*x", "x**2", "x)", "(x", "sin", "sin()", "sin(x", "sin(x,y)",
                 "min(x)", "clip(x,1)", "delay(x)", "delay(x,-1)", "delay(x,y)", "x y", "2x",
                 "1e999*x", "0x10", "1..2", "x;y", "x\u0000", "\u00d7", "$", "x^", "max(,)", "-",
                 "(" * 5000 + "x" + ")" * 5000, "-" * 5000 + "x", "x^" * 5000 + "x",
                 "x+" * 5000 + "x", "sin(" * 5000 + "x" + ")" * 5000, "," * 5000]:
        yield Case("model-term-%.20r" % term, simulate, 2, "$.equations[0].terms[0].term",
                   {"m.json": changed(("equations", 0, "terms", 0, "term"), term)})
    # Fine to read; the numbers do not allow an orbit.
    for term in ["exp(1000*x)", "1/(y*0)", "log(-1-x^2)", "sqrt(-1-x^2)", "x^1e300"]:
        yield Case("orbit-%s" % term, "simulate m.json --x0 2,0 --t-end 10 --dt 0.1", 1, "",
                   {"m.json": changed(("equations", 0, "terms", 0, "term"), term)})


def option_cases():
    files = {"r.csv": GOOD, "m.json": json.dumps(MODEL).encode()}
    for bad in ["--seed -1", "--seed 18446744073709551616", "--seed 1.5", "--seed x", "--seed ''",
                "--threads 0", "--threads -1", "--threads 1.5", "--threads 99999999999",
                "--threads ''", "--max-memory 0", "--max-memory -1", "--max-memory x",
                "--max-memory 1", "--progress maybe", "--degree -1", "--degree x", "--degree 1e3",
                "--degree 99999999999", "--degree 60", "--dt ''", "--dt 0", "--dt -1", "--dt nan",
                "--dt inf", "--dt x", "--states ''", "--states q", "--states x,x", "--states t,x",
                "--inputs q", "--inputs x,x", "--derivatives q", "--time q",
                "--time ''", "--trajectory q", "--embed x", "--embed x=1.5",
                "--embed q=1", "--embed x=99", "--hold x=zero", "--hold u", "--preset none",
                "--preset ''", "--config none.json", "--config .", "--config r.csv", "--terms ''",
                "--terms q", "--terms 'x,sin('", "--set a", "--set =1", "--set a=1",
                "--set .=1", "--set a..b=1", "--set regressor=none", "--set regressor.type=7",
                "--set regressor.none=1", "--set basis.max_degree=1.5", "--set basis.max_degree=x",
                "--set basis.max_degree=[]", "--set basis.max_degree=null", "--set basis=7",
                "--set 'regressor={\"type\": \"stlsq\", \"threshold\": -1}'", "--set preset=7",
                "--set tolerances=none", "--set regressor.type='\udcff'", "--integrator none",
                "--json .", "--json none/x", "--json r.csv", "--model-out r.csv",
                "--json a --model-out a", "--json - --model-out -", "--none", "-z", "--json",
                "r2.csv", "'*.none'", "--set " + "a." * 5000 + "a=1",
                "--set 'a=" + "[" * 5000 + "]" * 5000 + "'"]:
        yield Case("identify %.40s" % bad, "identify r.csv " + bad, 2, "", files)
    for bad in ["", "--x0 1 --t-end 1 --dt .1", "--x0 1,0,0 --t-end 1 --dt .1",
                "--x0 a,b --t-end 1 --dt .1", "--x0 nan,0 --t-end 1 --dt .1",
                "--x0 inf,0 --t-end 1 --dt .1", "--x0 '' --t-end 1 --dt .1",
                "--x0 1,0 --t-end 0 --dt .1", "--x0 1,0 --t-end -1 --dt .1",
                "--x0 1,0 --t-end nan --dt .1", "--x0 1,0 --t-end inf --dt .1",
                "--x0 1,0 --t-end 1 --dt 0", "--x0 1,0 --t-end 1 --dt -1",
                "--x0 1,0 --t-end 1 --dt nan", "--x0 1,0 --t-end 1e300 --dt 1e-300",
                "--x0 1,0 --t-end 1e12 --dt 1", "--x0 1,0 --t-end 1 --dt .1 -o .",
                "--x0 1,0 --t-end 1 --dt .1 -o m.json", "--x0 1,0 --t-end 1 --dt .1 -o none/x",
                "--x0 1,0 --t-end 1 --dt .1 --integrator none",
                "--x0 1,0 --t-end 1e8 --dt 1 --max-memory 200M"]:
        yield Case("simulate %.40s" % bad, "simulate m.json " + bad, 2, "", files)
    for bad in ["sync none r.csv", "sync m.json none.csv", "sync m.json r.csv --coupling x",
                "sync m.json r.csv --coupling q=1", "sync m.json r.csv --coupling x=nan",
                "sync m.json r.csv --coupling x=", "sync m.json r.csv --json r.csv",
                "diagnose r.csv", "diagnose --model m.json", "diagnose --model none r.csv",
                "diagnose --model r.csv r.csv", "diagnose --model m.json r.csv --effect none",
                "diagnose --model m.json r.csv --holdout none.csv",
                "diagnose --model m.json r.csv --limits x", "diagnose --model m.json r.csv --limits q=1:2",
                "diagnose --model m.json r.csv --limits x=2:1",
                "diagnose --model m.json r.csv --tolerance x", "diagnose --model m.json r.csv --tolerance x:q=1",
                "diagnose --model m.json r.csv --tolerance x:y=-1",
                "diagnose --model m.json r.csv --set decision.none=1",
                "diagnose --model m.json r.csv --set decision.significance=x",
                "diagnose --model m.json r.csv --max-effects -1",
                "diagnose --model m.json r.csv --json m.json",
                "diagnose --model m.json r.csv --model-out m.json", "list none", "list effect basis",
                "describe", "describe nothing", "none", "", "--none", "identify", "simulate", "sync",
                "identify none.csv", "identify .", "identify ''", "identify r.csv none.csv",
                "identify m.json r.csv"]:
        yield Case(bad or "nothing", bad, 2, "", files)
    for good, part in {"list": "regressor", "list basis": "monomials", "--version": "lacuna",
                       "--help": "identify", "describe stlsq": "threshold",
                       "identify --help": "--degree",
                       "identify r.csv --degree 1 --seed 18446744073709551615": "Equations",
                       "identify './r*.csv' --degree 1": "Equations",
                       "identify r.csv --degree 1 --json -": "lacuna.identification/1",
                       "identify r.csv --degree 1 --model-out -": "lacuna.model/1",
                       "identify r.csv --degree 1 --max-memory 1G": "Equations"}.items():
        yield Case("fine: " + good, good, 0, part, files)


def configuration_cases():
    for name, content in {
        "empty": b"", "list": b"[]", "open": b"{", "number": b"7", "nested":
        b'{"a":' + b"[" * 50000 + b"]" * 50000 + b"}", "overflow": b'{"basis": {"max_degree": 1e999}}',
        "utf8": b'{"preset": "\xff"}', "unknown": b'{"none": 1}', "stage": b'{"regressor": 7}',
        "stage-list": b'{"regressor": ["ols"]}', "type": b'{"regressor": {"type": "none"}}',
        "type-number": b'{"regressor": {"type": 1}}', "option": b'{"regressor": {"type": "stlsq", "none": 1}}',
        "range": b'{"regressor": {"type": "stlsq", "threshold": -1}}',
        "range-high": b'{"basis": {"type": "monomials", "max_degree": 1e9}}',
        "boolean": b'{"basis": {"type": "monomials", "with_inputs": "yes"}}',
        "inner": b'{"regressor": {"type": "irls-l1", "inner": "none"}}',
        "itself": b'{"regressor": {"type": "irls-l1", "inner": "irls-l1"}}',
        "preset": b'{"preset": 7}', "tolerances": b'{"tolerances": "none"}',
        "terms": b'{"basis": {"type": "expressions", "terms": [1]}}',
        "formula": b'{"basis": {"type": "expressions", "terms": ["x+"]}}',
    }.items():
        yield Case("config-" + name, "identify r.csv --config c.json", 2, "",
                   {"r.csv": GOOD, "c.json": content})


def environment_cases():
    files = {"r.csv": oscillation(3000), "m.json": json.dumps(MODEL).encode()}
    orbit = "simulate m.json --x0 1,0 --t-end 100 --dt 0.01"
    for command in ["list", "--help", "describe stlsq", orbit, "identify r.csv --degree 1",
                    "identify r.csv --degree 1 --json -", "sync m.json r.csv"]:
        yield Case("full: " + command, command, 2, "standard output", files, out="/dev/full")
    for command in [orbit + " -o o.csv", "identify r.csv --degree 1 --json o.json"]:
        for signal in ["true", "trap '' XFSZ"]:
            yield Case("limit: %s, %s" % (signal, command), command, 2, "cannot be written",
                       files, before=signal + "; ulimit -f 1")
    none = "ulimit -s 4194304; ulimit -v 3000000"
    for command in ["list", "identify r.csv --degree 1 --threads 4", orbit + " -o o.csv"]:
        yield Case("no threads: " + command, command, 0, "", files, before=none)
    links = "ln -s b a; ln -s a b; ln -s none c"
    for command in ["identify a", "identify c", "simulate a --x0 1 --t-end 1 --dt 1", orbit + " -o a",
                    "identify r.csv --config a", "sync a r.csv", "sync m.json a"]:
        yield Case("links: " + command, command, 2, "", files, before=links)
    yield Case("links: to nothing yet", orbit + " -o c", 0, "", files, before=links)
    bomb = "head -c 300000000 /dev/zero | gzip -1 > bomb.gz"
    for source, before in {"/dev/zero": "true", "/dev/null": "true", "bomb.gz": bomb}.items():
        yield Case("endless: " + source, "identify %s --max-memory 200M" % source, 2, source,
                   files, before=before)
    yield Case("read-only folder", orbit + " -o /proc/none", 2, "/proc/none", files)
    for locale in ["C", "C.UTF-8", "none", "de_DE.UTF-8"]:
        yield Case("locale: " + locale, "identify r.csv --degree 1", 0, "Equations", files,
                   before="export LC_ALL=" + locale)
    for variable in ["TERM=none", "HOME=/none", "TMPDIR=/none", "COLUMNS=-1"]:
        yield Case("environment: " + variable, "identify r.csv --degree 1", 0, "Equations", files,
                   before="export " + variable)
    for before, status, part in [("true", 0, "Equations"), ("export TMPDIR=/none", 2, "set TMPDIR"),
                                 ("ulimit -f 1", 2, "set TMPDIR"),
                                 ("trap '' XFSZ; ulimit -f 1", 2, "set TMPDIR")]:
        yield Case("in pieces: " + before, "identify - --degree 1 --memory 16MB", status, part,
                   files, before="exec < r.csv; " + before)
    yield Case("closed input", "identify r.csv --degree 1", 0, "Equations", files,
               before="exec < /dev/null")


def all_cases():
    for cases in [table_cases, model_cases, option_cases, configuration_cases, environment_cases]:
        yield from cases()
