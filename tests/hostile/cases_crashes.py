# SPDX-License-Identifier: MIT
"""Models and records that hold next to nothing: empty, repeated and constant equations, constant
channels, few samples, blank stretches, values at the ends of doubles, delays, stiff slaves."""
import math

from cases import Case

MODELS = {
    "empty": "dx/dt = 0\ndy/dt = 0\n",
    "one-empty": "dx/dt = y\ndy/dt = 0\n",
    "repeated": "dx/dt = y\ndy/dt = y\n",
    "constant": "dx/dt = 1\ndy/dt = -2\n",
    "identities": "dx/dt = y\ndy/dt = x\n",
    "bias": "dx/dt = y\ndy/dt = -x + b\ndb/dt = 0\n",
    "delay": "dx/dt = y\ndy/dt = -x + 0.1*delay(x, 0.3)\n",
}


def record(n=120, x=math.cos, y=lambda t: -math.sin(t), row="{:.6f},{},{}"):
    lines = [row.format(0.1 * i, *("" if v is None else "%.9g" % v for v in (x(0.1 * i), y(0.1 * i))))
             for i in range(n)]
    return ("t,x,y\n" + "\n".join(lines) + "\n").encode()


GOOD = record()


def constant(value):
    return lambda t: value


def model_cases():
    """Every model through every journey. A model that simulates gives the same as an export."""
    for name, text in MODELS.items():
        files = {"m.ode": text.encode(), "r.csv": GOOD}
        start = "1,0" + (",0" if name == "bias" else "")
        yield Case("model %s: diagnose" % name, "diagnose --model m.ode r.csv --json -", 0,
                   '"verdict":', files)
        yield Case("model %s: sync" % name, "sync m.ode r.csv", 0, "Synchronisation", files)
        yield Case("model %s: simulate" % name,
                   "simulate m.ode --x0 %s --t-end 3 --dt 0.1" % start, 0, "t", files)
        yield Case("model %s: text" % name, "model m.ode", 0, '"equations"', files)
        yield Case("model %s: check" % name, "check r.csv --model m.ode", 0, "x", files)
        yield Case("model %s: export" % name, "export m.ode --format modelica", 0, "der(x)", files)


def record_cases():
    """Records of which one channel, or all of them, hold nothing."""
    still = {"zero": 0.0, "tenth": 0.1, "large": 1e9, "tiny": 1e-300}
    model = {"m.ode": MODELS["delay"].encode(), "p.ode": MODELS["one-empty"].encode()}
    for name, value in still.items():
        files = {**model, "r.csv": record(y=constant(value))}
        status, said = (2, "range of numbers") if name == "tiny" else (0, None)
        yield Case("still %s: diagnose" % name, "diagnose --model p.ode r.csv --json -", status,
                   said or '"verdict":', files)
        yield Case("still %s: check" % name, "check r.csv", 0, "y", files)
        yield Case("still %s: sync" % name, "sync p.ode r.csv", status,
                   said or "Synchronisation", files)
    for name in ["zero", "tenth"]:
        files = {**model, "r.csv": record(x=constant(still[name]), y=constant(still[name]))}
        yield Case("all still %s" % name, "diagnose --model p.ode r.csv", 2, "nothing moves", files)
    for n in [1, 2, 3, 5, 8, 13, 19]:
        files = {**model, "r.csv": record(n)}
        yield Case("%d samples: diagnose" % n, "diagnose --model p.ode r.csv", 2, "", files)
        yield Case("%d samples: identify" % n, "identify r.csv --degree 2", 2 if n < 10 else 0, "",
                   files)
    blank = {**model, "r.csv": record(x=lambda t: None if 6.0 < t < 9.0 else math.cos(t),
                                      y=lambda t: None if 6.0 < t < 9.0 else -math.sin(t))}
    for command in ["diagnose --model p.ode r.csv", "identify r.csv --degree 1"]:
        yield Case("blank stretch: " + command, command, 0, "", blank)


def library_cases():
    """Libraries from which constraints leave nothing."""
    files = {"r.csv": GOOD}
    for degree in [0, 1]:
        yield Case("no column: degree %d" % degree,
                   'identify r.csv --degree %d --fix "dx: 1 = 0" --fix "dy: 1 = 0"' % degree,
                   *((0, "Equations") if degree else (1, "no equation was found")),
                   files)
    yield Case("no column: one term",
               'identify r.csv --terms x --fix "dx: x = 0" --fix "dy: x = 0"', 1, "no equation was found",
               files)
    yield Case("no column: robust",
               'identify r.csv --preset robust --degree 0 --fix "dx: 1 = 0" --fix "dy: 1 = 0"', 1,
               "no equation was found", files)


def stiff_cases():
    """Slaves that are faster than the samples, and one that nothing holds."""
    rows = ["%.4f,%d,%.6f" % (1e-3 * i, 1 if i // 20 % 2 else -1, 1 if i // 20 % 2 else -1)
            for i in range(200)]
    files = {"r.csv": ("t,u,y\n" + "\n".join(rows) + "\n").encode()}
    for pole in ["4e3", "2e4"]:
        yield Case("stiff: " + pole, "sync m.ode r.csv", 0, "steps between them were adapted",
                   {**files, "m.ode": ("input u hold zero\ndy/dt = %s*(u-y)\n" % pole).encode()})
    yield Case("runs away", "sync m.ode r.csv", 1, "try --coupling y=",
               {**files, "m.ode": b"input u\ndy/dt = 1e5*y + u\n"})
    yield Case("strong coupling", "sync m.ode r.csv --coupling y=1e4", 0, "adapted",
               {**files, "m.ode": b"input u\ndy/dt = u - y\n"})


def cases():
    return [*model_cases(), *record_cases(), *library_cases(), *stiff_cases()]
