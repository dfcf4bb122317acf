# SPDX-License-Identifier: MIT
"""Answers that could contradict themselves: values and steps of any size, offsets, constants,
comparisons of nothing, records held out that are not others, simulations without numbers."""
import math

from cases import Case

OSCILLATOR = b"dx/dt = y\ndy/dt = -x\n"
DECAY = b"param k = 1 in 0..3\ndx/dt = -k*x\n"


def record(n=200, step=0.05, scale=1.0, offset=0.0, columns="t,x,y", phase=0.0, noise=0.0):
    """Cosine and its derivative, in other units and with an offset, by all digits."""
    rows = [columns]
    for i in range(n):
        t = step * i
        angle = 0.1 * i + phase
        off = noise * math.sin(i * i * 12.9898)
        rows.append("%r,%r,%r" % (t, scale * (math.cos(angle) + off + offset),
                                  scale * (offset - math.sin(angle) + off)))
    return ("\n".join(rows) + "\n").encode()


def constant(value, n=60):
    return ("t,x\n" + "".join("%r,%r\n" % (0.1 * i, value) for i in range(n))).encode()


def range_cases():
    """What is beyond the range and resolution of doubles is refused, in every command."""
    models = {"m.ode": OSCILLATOR}
    for scale in [1e-300, 1e-200, 1e-100, 1e100, 1e200, 1e300]:
        files = dict(models, **{"r.csv": record(scale=scale)})
        for command in ["identify r.csv --degree 2", "sync m.ode r.csv", "fit m.ode r.csv",
                        "diagnose --model m.ode r.csv", "compare r.csv r.csv"]:
            yield Case("size %g: %s" % (scale, command), command, 2, "range of numbers", files)
    for step in [1e-200, 1e-60, 1e60, 1e200]:
        files = dict(models, **{"r.csv": record(step=step)})
        for command in ["identify r.csv --degree 2", "fit m.ode r.csv"]:
            yield Case("step %g: %s" % (step, command), command, 2, "range of numbers", files)
    for offset in [1e10, 1e12, 1e15]:
        files = dict(models, **{"r.csv": record(offset=offset)})
        for command in ["identify r.csv --degree 2", "fit m.ode r.csv", "sync m.ode r.csv",
                        "diagnose --model m.ode r.csv"]:
            yield Case("offset %g: %s" % (offset, command), command, 2, "offset", files)


def answer_cases():
    """Other sizes are answered, and what is said is held to consistency.py."""
    for scale in [1e-30, 1e-9, 1e-3, 1e3, 1e9, 1e30]:
        for noise in [0.0, 0.003]:
            files = {"r.csv": record(scale=scale, noise=noise)}
            yield Case("size %g, noise %g" % (scale, noise), "identify r.csv --degree 2 --json -", 0,
                       "lacuna.identification/1", files)
    for offset in [1.0, 1e3, 1e6]:
        files = {"r.csv": record(offset=offset, noise=0.001)}
        yield Case("offset %g" % offset, "identify r.csv --degree 1", 0, "Equations", files)
        yield Case("offset %g, as JSON" % offset, "identify r.csv --degree 1 --json -", 0, "verdict",
                   files)
    yield Case("offset 1e8 of a linear record", "identify r.csv --degree 1", 0, "Equations",
               {"r.csv": record(offset=1e8)})
    files = {"r.csv": record(step=0.1), "s.csv": record(step=0.1, phase=1.0), "m.ode": OSCILLATOR}
    for command, part in {
        "identify r.csv --degree 2 --holdout s.csv": "of other records",
        "sync m.ode r.csv": "Holds", "compare r.csv s.csv": "measure",
        "diagnose --model m.ode r.csv --holdout s.csv": "No discrepancy",
    }.items():
        yield Case("fine: " + command, command, 0, part, files)


def constant_cases():
    for value in [0.0, 1.0, -5.5, 1e-9, 1e9]:
        yield Case("constant %g" % value, "identify r.csv", 2, "is constant",
                   {"r.csv": constant(value)})
    for value in [1e-300, 1e300]:
        yield Case("constant %g" % value, "identify r.csv", 2, "range of numbers",
                   {"r.csv": constant(value)})


def nothing_compared_cases():
    files = {"r.csv": record(noise=0.001), "s.csv": record(phase=1.0, noise=0.001),
             "k.csv": record(n=30, phase=2.0), "m.ode": OSCILLATOR,
             "f.ode": b"param a = 1\ndx/dt = a*y\ndy/dt = -x\n"}
    for model in ["m.ode", "f.ode"]:
        for samples in [200, 1000, 100000]:
            yield Case("no sample left, %s, %d" % (model, samples),
                       "fit %s r.csv --start-samples %d --holdout s.csv" % (model, samples), 0,
                       "there is no gap", files)
        yield Case("a short record held out, " + model, "fit %s r.csv --holdout k.csv" % model, 0,
                   "there is no gap", files)
    for ahead in [200, 1000, 100000]:
        yield Case("%d samples ahead" % ahead, "fit f.ode r.csv --ahead %d" % ahead, 0,
                   "samples ahead nothing to compare", files)
    yield Case("no sample left, as JSON",
               "fit f.ode r.csv --start-samples 100000 --holdout s.csv --json -", 0, '"gap": null',
               files)
    yield Case("ahead of all, as JSON", "fit f.ode r.csv --ahead 100000 --json -", 0,
               '"rmse": null', files)


def same_record_cases():
    """A record that is used cannot confirm what was made of it."""
    files = {"r.csv": record(noise=0.001), "same.csv": record(noise=0.001),
             "spaced.csv": record(noise=0.001).replace(b",", b" ; "),
             "part.csv": b"\n".join(record(noise=0.001).split(b"\n")[:150]) + b"\n",
             "m.ode": OSCILLATOR}
    for held_out in ["r.csv", "same.csv", "spaced.csv", "part.csv", "./r.csv"]:
        for command in ["identify r.csv --degree 2 --holdout ", "fit m.ode r.csv --holdout ",
                        "diagnose --model m.ode r.csv --holdout "]:
            if "spaced" in held_out and "identify" not in command:
                continue
            yield Case("same record: " + command + held_out, command + held_out, 2,
                       "has the samples of", files)


def number_cases():
    """Numbers of which the records say nothing, and intervals that end where ranges do."""
    decay = ("t,x\n" + "".join("%r,%r\n" % (0.1 * i, math.exp(-0.01 * i) + 1e-3 * math.sin(i * i))
                               for i in range(100))).encode()
    files = {"r.csv": decay}
    for name, model, part in [
        ("range", b"param k = 0.1 in 0..0.1001\ndx/dt = -k*x\n", "k"),
        ("nothing", b"param k = 0.1\nparam b = 1\ndx/dt = -k*x + 1e-30*b\n", "not determined"),
        ("nothing, tiny", b"param b = 1\ndx/dt = -0.1*x + 1e-20*b*x\n", "not determined"),
        ("product", b"param a = 0.2\nparam b = 0.5\ndx/dt = -a*b*x\n", "Not identifiable"),
        ("hidden", b"param k = 0.1\ndx/dt = -k*x\ndz/dt = -z\n", "cannot be determined"),
    ]:
        for ending in ["", " --json -"]:
            yield Case("number, %s%s" % (name, ending), "fit m.ode r.csv" + ending, 0,
                       part if not ending else "lacuna.fit/1", dict(files, **{"m.ode": model}))


def simulation_cases():
    for name, model, arguments in [
        ("root", b"dx/dt = -1\ny = sqrt(x)\n", "--x0 1 --t-end 3 --dt 0.1"),
        ("logarithm", b"dx/dt = -1\ny = log(x)\n", "--x0 1 --t-end 3 --dt 0.1"),
        ("quotient", b"dx/dt = 1\ny = 1/x\n", "--x0 0 --t-end 3 --dt 0.1"),
        ("overflow", b"dx/dt = 1\ny = exp(1000*x)\n", "--x0 0 --t-end 3 --dt 0.1"),
        ("growth", b"dx/dt = x^2\n", "--x0 1 --t-end 3 --dt 0.1"),
        ("growth, steps", b"dx/dt = x^3\n", "--x0 1e150 --t-end 3 --dt 1 --integrator rk4"),
        ("beside another", b"dx/dt = 0*x\ndz/dt = sqrt(-1-z)\n", "--x0 1,1 --t-end 3 --dt 0.1"),
        ("beside, steps", b"dx/dt = 0*x\ndz/dt = sqrt(-1-z)\n",
         "--x0 1,1 --t-end 3 --dt 0.1 --integrator rk4"),
        ("huge", b"dx/dt = x\n", "--x0 1e307 --t-end 9 --dt 0.5"),
        ("noise", b"dx/dt = 0*x\n", "--x0 1 --t-end 3 --dt 0.1 --noise x=1.7e308"),
        ("time", b"dx/dt = 0*x\n", "--x0 1 --t-start 1.7e308 --t-end 1.79e308 --dt 1e307"),
    ]:
        status = 0 if name == "time" else 1
        yield Case("simulate: " + name, "simulate m.ode -o o.csv " + arguments, status,
                   "" if name == "time" else "nothing was written", {"m.ode": model})


def cases():
    return [case for kind in [range_cases, answer_cases, constant_cases, nothing_compared_cases,
                              same_record_cases, number_cases, simulation_cases]
            for case in kind()]
