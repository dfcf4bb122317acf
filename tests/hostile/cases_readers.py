# SPDX-License-Identifier: MIT
"""Names, units and comments that nobody should have, what is given twice, and models without end.

Every reader is given the same characters: models and options refuse them with the place, headers
of records are cleaned and a note says so.
"""
import json

from cases import GOOD, MODEL, Case, changed, oscillation

UNSEEN = [0x1B, 0x7F, 0x85, 0xAD, 0x61C, 0x200B, 0x200C, 0x200D, 0x200E, 0x200F, 0x2028, 0x2029,
          0x202A, 0x202B, 0x202C, 0x202D, 0x202E, 0x2060, 0x2066, 0x2067, 0x2068, 0x2069, 0xFEFF]
OTHER_WRITING = [0xA0, 0x301, 0x30A, 0x2126, 0x212A, 0x212B, 0xFF21, 0x2002, 0x5D0, 0x645, 0x1F600]
ODE = "time s\nstate x [m]\nstate y [m/s]\ndx/dt = y\ndy/dt = -x\n"
LOOK = "model m.ode"


def ode(text):
    return {"m.ode": text.encode() if isinstance(text, str) else text}


def character_cases():
    for code in UNSEEN + OTHER_WRITING:
        name, c = "U+%04X" % code, chr(code)
        yield Case("readers-ode-unit-" + name, LOOK, 2, name,
                   ode(ODE.replace("[m]", "[k%sm]" % c)))
        yield Case("readers-json-unit-" + name, "model m.json", 2, "$.states[0].unit",
                   {"m.json": changed(("states", 0, "unit"), "k%sm" % c)})
        yield Case("readers-header-unit-" + name, "check r.csv", 0, "is read as",
                   {"r.csv": GOOD.replace(b",x,", (",x [k%sm]," % c).encode())})
        yield Case("readers-json-name-" + name, "model m.json", 2, "is not an identifier",
                   {"m.json": changed(("states", 0, "name"), "x" + c)})
    for code in UNSEEN:
        name, c = "U+%04X" % code, chr(code)
        yield Case("readers-ode-comment-" + name, LOOK, 2, "m.ode:4:14: the character " + name,
                   ode(ODE.replace("dx/dt = y", "dx/dt = y # a%sb" % c)))
        yield Case("readers-ode-time-" + name, LOOK, 2, name, ode(ODE.replace("s\n", c + "s\n", 1)))
        yield Case("readers-description-" + name, "model m.json", 2, "$.description",
                   {"m.json": changed(("description",), "a %s b" % c)})
        yield Case("readers-time-unit-" + name, "check r.csv --time-unit 'm%ss'" % c, 2, 'is no unit of time',
                   {"r.csv": GOOD})
    for name, text in {"cr": "time s\rint evil = 42; //\n", "vt": "time s\vx\n",
                       "ff": "# a\fdx/dt = 2\n", "nul": "time s\0\n", "cr-comment": "# a\rb\n"}.items():
        yield Case("readers-ode-line-" + name, LOOK, 2, "end lines by a line feed"
                   if name != "nul" else "U+0000", ode(text + ODE.split("\n", 1)[1]))
    yield Case("readers-ode-utf16", LOOK, 2, "m.ode:1", ode(ODE.encode("utf-16")))
    yield Case("readers-header-break", "check r.csv", 0, "is read as",
               {"r.csv": GOOD.replace(b"t,x,y", b't,"x [coding:unicode_escape\x0b]",y')})


def text_cases():
    long = "v" * 256
    for name, part, text in [
            ("long-unit", "256 bytes", ODE.replace("[m]", "[%s]" % long)),
            ("long-name", "256 bytes", ODE.replace("x", long)),
            ("unit-brackets", "U+005B", ODE.replace("[m]", "[[m]]")),
            ("time-bracket", "U+005D", ODE.replace("time s", "time s]")),
            ("reserved", "formula language", ODE.replace("state x [m]\n", "").replace("x", "nan")),
            ("ohm", "(U+03A9)", ODE.replace("[m]", "[\u2126]"))]:
        yield Case("readers-ode-" + name, LOOK, 2, part, ode(text))
    for name, unit in {"brackets": "[m]", "blank": " m", "long": long, "newline": "a\nb"}.items():
        yield Case("readers-json-unit-" + name, "model m.json", 2, "$.states[0].unit",
                   {"m.json": changed(("states", 0, "unit"), unit)})
    for name, text in {
            "hash": ODE.replace("[m]", "[#/cm3]").replace("time s", "time [#]"),
            "bom": "\ufeff" + ODE, "quotes": ODE.replace("[m]", "[\"'\\\\$`]"),
            "letters": ODE.replace("[m]", "[\u00b5\u03a9\u00b7\u79d2\u043c]"),
            "keywords": "time = 2*x\ndx/dt = in\ndin/dt = -fixed\ndfixed/dt = -x\nstate = in [V]\n",
            "comment": "# \u0645\u062b\u0627\u0644, e\u0301, \U0001f600\n" + ODE,
            "summands": "dx/dt = 0" + "".join(" - sin(%d*x)" % i for i in range(1, 1000)) + "\n",
            "crlf": ODE.replace("\n", "\r\n")}.items():
        yield Case("readers-ode-good-" + name, LOOK, 0, '"equations"', ode(text))
    yield Case("readers-json-bom", "model m.json", 0, "dx/dt = y",
               {"m.json": b"\xef\xbb\xbf" + json.dumps(MODEL).encode()})
    yield Case("readers-config-bom", "identify r.csv --config c.json", 0, "Equations",
               {"r.csv": GOOD, "c.json": b"\xef\xbb\xbf{\"preset\": \"algorithm1\"}"})
    for name, option in {"word": "sin=x", "blank": "'a b=x'", "digit": "2x=x",
                         "long": long + "=x", "mark": "'x\u202e=x'"}.items():
        yield Case("readers-map-" + name, "check r.csv --map " + option, 2, "--map", {"r.csv": GOOD})


def twice_cases():
    for name, text in {
            "time": ODE + "time ms\n", "same-time": ODE + "time s\n", "state": ODE + "state x [V]\n",
            "same-state": ODE + "state x [m]\n", "equation": ODE + "dx/dt = 2*y\n",
            "param": ODE + "param k = 1\nparam k = 2\n", "input": ODE + "input u\ninput u\n",
            "input-state": ODE + "input x\n", "output": ODE + "z = x\nz = y\n",
            "initial": ODE + "initial x = 1\ninitial x = 1\n",
            "choice": ODE + "fixed dx/dt: y\nfree dx/dt: y\n"}.items():
        yield Case("readers-twice-ode-" + name, LOOK, 2, "is given twice, first in line", ode(text))
    whole = json.dumps(MODEL)
    term = '{"term": "y", "coefficient": 1.0}'
    for name, text in {
            "term": whole.replace(term, term + ", " + term),
            "state": whole.replace('{"name": "y"}', '{"name": "x"}'),
            "equation": whole.replace('{"state": "y"', '{"state": "x"')}.items():
        yield Case("readers-twice-json-" + name, "model m.json", 2, "is given twice, first at $.",
                   {"m.json": text.encode()})
    record = {"r.csv": GOOD, "m.json": json.dumps(MODEL).encode(),
              "u.csv": oscillation(header="t,x,u"),
              "c.json": b'{"basis": {"type": "monomials", "type": "expressions"}}'}
    for name, line in {
            "equation": "identify r.csv --equation 'x: y' --equation 'x: x'",
            "set": "identify r.csv --set regressor.threshold=0.1 --set regressor.threshold=0.2",
            "fix": "identify r.csv --fix 'x: y = 1' --fix 'x:y=2'",
            "coupling": "sync m.json r.csv --coupling x=1,x=2",
            "map": "check r.csv --map a=x --map a=y",
            "hold": "identify u.csv --inputs u --hold u=zero --hold u=linear",
            "embed": "identify u.csv --inputs u --embed x=1,x=2",
            "limits": "diagnose --model m.json r.csv --limits x=-1:1 --limits x=-2:2",
            "noise": "simulate m.json --x0 1,0 --t-end 1 --dt 0.1 --noise x=1,x=2",
            "tolerance": "diagnose --model m.json r.csv --tolerance x:y=5% --tolerance x:y=1%"}.items():
        yield Case("readers-twice-" + name, line, 2, "is given twice, first", record)
    yield Case("readers-twice-column", "check r.csv --map a=x,b=x", 2, "is called 'a' already", record)
    yield Case("readers-twice-library", "identify r.csv --degree 2 --terms 1,x", 2, "--degree", record)
    yield Case("readers-twice-key", "identify r.csv --config c.json", 2, "$.basis.type", record)


def size_cases():
    simulate = "simulate %s --x0 %s --t-end 0.02 --dt 0.01"
    for name, line in {"model": "model /dev/zero", "simulate": simulate % ("/dev/zero", "1"),
                       "fit": "fit /dev/zero r.csv", "export": "export /dev/urandom --format c",
                       "config": "identify r.csv --config /dev/zero"}.items():
        yield Case("readers-endless-" + name, line, 2, "64 MiB", {"r.csv": GOOD})
    yield Case("readers-endless-ode", LOOK, 2, "64 MiB", {}, before="ln -s /dev/zero m.ode")
    yield Case("readers-blanks", "model m.json", 2, "64 MiB", {},
               before="head -c 70000000 /dev/zero | tr '\\0' ' ' > m.json")
    many = range(100000)
    params = "".join("param k%d = %d\n" % (i, i) for i in many)
    yield Case("readers-many-parameters", LOOK, 0, '"equations"', ode(params + "dx/dt = -k7*x\n"))
    chain = "param k0 = 1\n" + "".join("param k%d = k%d + 1\n" % (i, i - 1)
                                       for i in range(1, 20000))
    yield Case("readers-chained-parameters", LOOK, 0, '"equations"', ode(chain + "dx/dt = -k19999*x\n"))
    states = "".join("dx%d/dt = x%d - x%d\n" % (i, (i + 1) % 20000, i) for i in range(20000))
    yield Case("readers-many-states", "model m.ode -o m.json", 0, "", ode(states))
    yield Case("readers-states-simulated",
               "simulate m.ode --x0 \"$(seq -s, 0 19999)\" --t-end 0.02 --dt 0.01", 0, "t",
               ode(states))
    terms = [{"term": "sin(%d*x)" % (i + 1), "coefficient": -1e-7} for i in many]
    wide = {"format": "lacuna.model/1", "states": [{"name": "x"}],
            "equations": [{"state": "x", "terms": terms}]}
    yield Case("readers-many-terms", simulate % ("m.json", "1"), 0, "t",
               {"m.json": json.dumps(wide).encode()})
    text = "dx/dt = 0" + "".join(" - 1e-7*sin(%d*x)" % (i + 1) for i in many) + "\n"
    yield Case("readers-many-summands", simulate % ("m.ode", "1"), 0, "t", ode(text))


def equal_term_cases():
    text = ("input u\nstate v1 [V]\nstate v2 [V]\nparam R1 = 10 fixed\nparam R2 = 10 fixed\n"
            "param C = 0.1 in 0.01..1\ndv1/dt = (u - v1)/(R1*C) - (v1 - v2)/(R2*C)\n"
            "dv2/dt = (v1 - v2)/(R2*C)\n")
    record = oscillation(header="t,u,v2")
    yield Case("readers-equal-terms", "fit m.ode r.csv", 0, "C", {**ode(text), "r.csv": record})
    yield Case("readers-equal-terms-free", "fit m.ode r.csv", 0, "R1",
               {**ode(text.replace(" fixed", " in 1..99")), "r.csv": record})


def cases():
    return [case for group in (character_cases, text_cases, twice_cases, size_cases,
                               equal_term_cases) for case in group()]
