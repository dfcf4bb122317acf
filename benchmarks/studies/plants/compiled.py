# SPDX-License-Identifier: MIT
"""Free runs of equations that are given as text, compiled with the C compiler; their fit."""

import ctypes
import dataclasses
import hashlib
import pathlib
import re
import subprocess
import tempfile

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import least_squares

SCHEDULES = ((0.1, 0.3, 1.0), (1.0,))  # parts of each piece, one fit after the other
FAR = 1e6  # what stands for a run that leaves
NAMES = {"abs": "fabs", "max": "fmax", "min": "fmin", "sign": "sgn", "clip": "clipped"}
SOURCE = """#include <math.h>
static double sgn(double x) {{ return (x > 0) - (x < 0); }}
static double step(double x) {{ return x > 0; }}
static double clipped(double x, double a, double b) {{ return x < a ? a : x > b ? b : x; }}
static void rates(const double* p, const double* x, const double* u, double t, double* d) {{
{rates}
}}
void run(const double* p, const double* x0, const double* u, long n, double h, long parts,
         double begin, double* out) {{
  double x[{order}], y[{order}], k[4][{order}];
  for (int i = 0; i < {order}; ++i) x[i] = x0[i];
  for (long s = 0; s < n * parts; ++s, u += {inputs} * 3) {{
    const double t = begin + s * h;
    if (s % parts == 0) {{
{outputs}
    }}
    rates(p, x, u, t, k[0]);
    for (int i = 0; i < {order}; ++i) y[i] = x[i] + h / 2 * k[0][i];
    rates(p, y, u + {inputs}, t + h / 2, k[1]);
    for (int i = 0; i < {order}; ++i) y[i] = x[i] + h / 2 * k[1][i];
    rates(p, y, u + {inputs}, t + h / 2, k[2]);
    for (int i = 0; i < {order}; ++i) y[i] = x[i] + h * k[2][i];
    rates(p, y, u + 2 * {inputs}, t + h, k[3]);
    for (int i = 0; i < {order}; ++i)
      x[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
  }}
}}
"""


@dataclasses.dataclass
class Piece:
    """Samples without a gap."""

    step: float
    channels: dict  # name -> samples
    inputs: dict
    begin: float = 0.0  # time of the first sample


@dataclasses.dataclass
class Model:
    """Equations as text; `numbers` are their starts, and those that end in _late dead times."""

    equations: dict  # state -> right-hand side
    numbers: dict
    outputs: dict  # channel -> formula
    holds: dict = dataclasses.field(default_factory=dict)  # input -> zero, linear, smooth
    late: dict = dataclasses.field(default_factory=dict)  # input -> name of its dead time
    starts: dict = dataclasses.field(default_factory=dict)  # state -> guess or formula of samples
    parts: int = 4  # steps of a sample
    low: dict = dataclasses.field(default_factory=dict)  # number -> its least value


def in_c(text, places):
    """An expression as C; places: name -> how C calls it."""
    text = re.sub(r"\^", "**", text)
    while "**" in text:  # base: a name, a call or a bracket; exponent: a number or a bracket
        base = r"((?:[A-Za-z_]\w*)?\((?:[^()]|\([^()]*\))*\)|[A-Za-z_]\w*|[\d.]+)"
        power = r"(\((?:[^()])*\)|-?[\d.]+)"
        new = re.sub(base + r"\*\*" + power, r"POW(\1,\2)", text, count=1)
        assert new != text, text
        text = new
    number = r"(?<![\w.])\d+(?:\.\d*)?(?:[eE][+-]?\d+)?"
    text = re.sub(number, lambda found: repr(float(found[0])), text).replace("POW", "pow")
    names = NAMES | places
    return re.sub(r"[A-Za-z_]\w*", lambda found: names.get(found[0], found[0]), text)


def compiled(model):
    """The function `run` of a model."""
    places = {name: f"p[{i}]" for i, name in enumerate(model.numbers)}
    places |= {name: f"x[{i}]" for i, name in enumerate(model.equations)}
    places |= {name: f"u[{i}]" for i, name in enumerate(model.holds)}
    rates = [f"  d[{i}] = {in_c(text, places)};" for i, text in enumerate(model.equations.values())]
    outputs = [f"      *out++ = {in_c(text, places)};" for text in model.outputs.values()]
    source = SOURCE.format(
        rates="\n".join(rates),
        outputs="\n".join(outputs),
        order=len(model.equations),
        inputs=len(model.holds),
    )
    folder = pathlib.Path(tempfile.gettempdir()) / "lacuna_recordings"
    folder.mkdir(exist_ok=True)
    path = folder / hashlib.sha256(source.encode()).hexdigest()[:16]
    if not path.with_suffix(".so").exists():
        path.with_suffix(".c").write_text(source)
        command = ["cc", "-O2", "-shared", "-fPIC", "-o", path.with_suffix(".so")]
        subprocess.run([*command, path.with_suffix(".c"), "-lm"], check=True)
    return ctypes.CDLL(str(path.with_suffix(".so"))).run


def acting(samples, hold, late, step, parts):
    """An input at the begin, the middle and the end of each step; of a held one its mean there."""
    count = len(samples)
    knots = np.arange(count + 1) * step
    edges = np.arange(count * parts + 1) * step / parts - late
    if hold == "zero":
        total = np.concatenate([[0.0], np.cumsum(samples) * step])
        integral = np.interp(edges, knots, total) + samples[0] * np.minimum(edges, 0.0)
        return np.repeat(np.diff(integral)[:, None] * parts / step, 3, axis=1)
    times = edges[:-1, None] + np.array([0.0, 0.5, 1.0]) * step / parts
    times = np.clip(times, 0.0, knots[-2])
    if hold == "smooth":
        return CubicSpline(knots[:-1], samples)(times)
    return np.interp(times, knots[:-1], samples)


def pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def free_run(run, model, numbers, start, piece, count):
    """Outputs at the first samples of a piece: samples x channels."""
    values = dict(zip(model.numbers, numbers))
    table = np.zeros((count * model.parts, 3, max(1, len(model.holds))))
    for place, (name, hold) in enumerate(model.holds.items()):
        late = values[model.late[name]] if name in model.late else 0.0
        samples = piece.inputs[name][:count]
        table[:, :, place] = acting(samples, hold, late, piece.step, model.parts)
    if not model.holds:
        table = np.zeros((count * model.parts, 3, 1))
    out = np.empty((count, len(model.outputs)))
    p, x = np.array([*numbers, 0.0]), np.array(start, float)
    h = ctypes.c_double(piece.step / model.parts)
    sizes, begin = (ctypes.c_long(count), ctypes.c_long(model.parts)), ctypes.c_double(piece.begin)
    run(pointer(p), pointer(x), pointer(table), sizes[0], h, sizes[1], begin, pointer(out))
    return np.nan_to_num(np.clip(out, -FAR, FAR), nan=FAR)


def guess_of(model, piece):
    """The states at the first sample: measured, a difference, or what the model says."""
    found = []
    for state in model.equations:
        guess = model.starts.get(state, 0.0)
        if state in piece.channels:
            guess = piece.channels[state][0]
        elif isinstance(guess, str):  # a channel whose derivative it is
            samples = piece.channels[guess]
            span = min(len(samples) - 1, 5)
            guess = (samples[span] - samples[0]) / span / piece.step
        found.append(float(guess))
    return found


def spread_of(model, pieces):
    """Standard deviation of each channel over all pieces."""
    names = model.outputs
    return np.array([np.concatenate([p.channels[n] for p in pieces]).std() for n in names])


def errors(run, model, pieces, numbers, starts, part, spread):
    """What free runs through parts of pieces leave, over the motion: samples x channels."""
    rows = []
    for piece, start in zip(pieces, starts):
        samples = np.column_stack([piece.channels[name] for name in model.outputs])
        count = max(min(len(samples), 20), int(part * len(samples)))
        found = free_run(run, model, numbers, start, piece, count)
        rows.append((found - samples[:count]) / spread)
    return np.concatenate(rows)


def solved(residuals, theta, low):
    """The best end of several schedules."""
    ends = []
    for schedule in SCHEDULES:
        at = theta
        for part in schedule:
            found = least_squares(
                residuals, at, x_scale="jac", args=(part,), bounds=(low, np.inf), max_nfev=60
            )
            at = found.x
        ends.append(found)
    return min(ends, key=lambda end: end.cost).x


def fit(model, pieces):
    """Numbers by name, and what the free run leaves; each piece has a start of its own."""
    run, order, free = compiled(model), len(model.equations), len(model.numbers)
    spread = spread_of(model, pieces)
    starts = [x for piece in pieces for x in guess_of(model, piece)]
    theta = np.array([*model.numbers.values(), *starts], float)
    low = np.full(len(theta), -np.inf)
    low[:free] = [model.low.get(name, -np.inf) for name in model.numbers]

    def residuals(z, part):
        begins = z[free:].reshape(len(pieces), order)
        return errors(run, model, pieces, z[:free], begins, part, spread).ravel()

    theta = solved(residuals, theta, low)
    error = float(np.sqrt(np.mean(residuals(theta, 1.0) ** 2)))
    return dict(zip(model.numbers, theta[:free])), error


def error_of(model, pieces, numbers):
    """What the free run leaves of other pieces, the start of each fitted to it.

    Of a channel without a sign the start may have either.
    """
    run, spread = compiled(model), spread_of(model, pieces)
    values = [numbers[name] for name in model.numbers]
    squares = []
    for piece in pieces:
        guess = np.array(guess_of(model, piece))
        ends = []
        for sign in (1, -1) if any("abs(" in law for law in model.outputs.values()) else (1,):

            def residuals(z, part, piece=piece):
                return errors(run, model, [piece], values, [z], part, spread).ravel()

            found = solved(residuals, sign * guess, -np.inf)
            ends.append(residuals(found, 1.0) ** 2)
        squares.append(min(ends, key=np.sum))
    return float(np.sqrt(np.mean(np.concatenate(squares))))
