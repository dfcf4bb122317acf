# SPDX-License-Identifier: MIT
"""Recordings of machines, most of them measured, each with the structure an expert writes down.

The records lie in LACUNA_DATA and in the repository's data; their READMEs say where they come from.
Both models are run freely through a held-out record; the initial state is fitted to it for both
alike. A chaotic record is run in pieces. What an expert knows beside the channels (a state that is
not measured, a speed without its sign) stands in the grey box and cannot be found by `identify`:
such rows have a plain structure in the channels alone beside it ("channels alone %").
"""

import dataclasses
import os
import pathlib

from compiled import Model

DATA = pathlib.Path(os.environ.get("LACUNA_DATA", "."))
OWN = pathlib.Path(__file__).resolve().parents[3] / "data"


@dataclasses.dataclass
class Recording:
    name: str
    files: tuple  # of the fit and held out, each a path or (path, first row, last row)
    channels: tuple  # names in the command
    holds: dict  # input -> how it runs between samples, as an expert knows it
    options: str  # of the command
    box: Model
    pieces: int | None = None  # samples of each piece of a free run; None: up to a gap
    step: float | None = None  # s; None: from the column of the time
    plain: Model | None = None  # in the channels alone, where the box knows more


def newton(x, force, numbers, channel=None, **more):
    """A channel, its derivative v and a law of forces."""
    equations = {x: "v", "v": force}
    return Model(equations, numbers, {channel or x: x}, starts={"v": channel or x}, **more)


def plain(equations, numbers, outputs=None, **more):
    """Equations whose states are measured, all of them where no outputs are named."""
    return Model(equations, numbers, {name: name for name in outputs or equations}, **more)


def rossler(a, b):
    """The circuit's own time runs 10 000 times as fast."""
    equations = {"x": "-a*y-b*z", "y": "c*x+d*y", "z": "e+f*x*z-g*z"}
    values = dict(zip("abcdefg", (a, a, a, b, 500 * a / 1e4, 4.5 * a, 6 * a)))
    return plain(equations, values)


REAL, DEVICES, PRACTICE = DATA / "real", DATA / "devices", DATA / "practice"


def pair(folder):
    return (folder / "train.csv.gz", folder / "test.csv.gz")


def heaters(name, file, options, box):
    """The surrounding differs from record to record, so the end of each is held out."""
    path = DEVICES / "tclab" / file
    files = ((path, 0, 600), (path, 600, None))
    return Recording(name, files, tuple(box.outputs), {"Q1": "zero"}, options, box)


ROOM = {"a": 0.01, "k": 0.006, "c": 0.2}
SINES = "validation_experiment_env_2_sin_2_50_run_1.csv"
LONG_SINES = "tclab_sine_test_5min_period.csv"
OSCILLATOR = DEVICES / "oscillators/oscillator1_train.csv.gz"
SILVERBOX = DATA / "silverbox/silverbox_snls80mv.csv.gz"
PENDULUM = "p*sin(th)-d*w-f*tanh(w/s)+g*u"
SWINGING = {"p": -18.0, "d": 0.2, "f": 0.3, "s": 0.03, "g": 1.2}
TURNED = {"holds": {"u": "linear"}, "low": {"s": 1e-3}, "parts": 10}

RECORDINGS = [
    Recording(
        "emps",
        (DATA / "emps/emps_train.csv.gz", DATA / "emps/emps_validation.csv.gz"),
        ("q",),
        {"F": "zero"},
        "--states q --embed q=2 --inputs F --hold F=zero",
        newton(
            "q",
            "a*F-b*v-c*tanh(v/s)-d",
            {"a": 0.011, "b": 2.5, "c": 0.15, "s": 0.002, "d": 0.0},
            holds={"F": "zero"},
            low={"s": 1e-4},
        ),
    ),
    Recording(
        "silverbox",
        ((SILVERBOX, 40650, 105712), (SILVERBOX, 105712, 127399)),
        ("y",),
        {"u": "smooth"},
        "--embed y=2 --inputs u",
        newton(
            "y",
            "g*u-d*v-k*y-m*y^2-c*y^3+o",
            {"g": 1.8e5, "d": 40.0, "k": 1.9e5, "m": 0.0, "c": 7e5, "o": 0.0},
            holds={"u": "smooth"},
        ),
    ),
    Recording(
        "silverbox_arrow",
        ((SILVERBOX, 40650, 105712), (SILVERBOX, 100, 40574)),
        ("y",),
        {"u": "smooth"},
        "--embed y=2 --inputs u",
        newton(
            "y",
            "g*u-d*v-k*y-m*y^2-c*y^3+o",
            {"g": 1.8e5, "d": 40.0, "k": 1.9e5, "m": 0.0, "c": 7e5, "o": 0.0},
            holds={"u": "smooth"},
        ),
    ),
    Recording(
        "ced",
        pair(REAL / "ced"),
        ("y",),
        {"u": "zero"},
        "--embed y=3 --inputs u --hold u=zero",
        Model(
            {"m": "-a*m+b*u-f*tanh(m/0.05)", "w": "v", "v": "k*(m-w)-d*v"},
            {"a": 4.0, "b": 5.0, "f": 3.0, "k": 500.0, "d": 10.0},
            {"y": "abs(w)"},
            holds={"u": "zero"},
            starts={"w": -1.0, "m": -1.0},
            parts=8,
        ),
        plain=Model(
            {"y": "v", "v": "a", "a": "g*u-j*a-d*v-k*y+o"},
            {"g": 1000.0, "j": 10.0, "d": 500.0, "k": 1500.0, "o": 100.0},
            {"y": "y"},
            holds={"u": "zero"},
            starts={"v": "y"},
        ),
    ),
    Recording(
        "bouc_wen",
        pair(REAL / "bouc_wen"),
        ("y",),
        {"u": "smooth"},
        "--embed y=2 --inputs u",
        Model(
            {
                "y": "v",
                "v": "a*u-k*y-d*v-p*z",
                "z": "q*v-g*abs(v)*z-e*v*abs(z)",
            },
            {"a": 500.0, "k": 25000.0, "d": 5.0, "p": 500.0, "q": 50.0, "g": 0.8, "e": -1.0},
            {"y": "y"},
            holds={"u": "smooth"},
            starts={"v": "y"},
        ),
        plain=newton(
            "y",
            "a*u-k*y-d*v-c*y^3-f*tanh(v/s)",
            {"a": 500.0, "k": 56000.0, "d": 60.0, "c": 5000.0, "f": -3000.0, "s": 10.0},
            holds={"u": "smooth"},
            low={"s": 1.0},
        ),
    ),
    Recording(
        "drag",
        pair(REAL / "position_only_drag"),
        ("y",),
        {"F": "linear"},
        "--embed y=2 --inputs F",
        newton(
            "y",
            "a*F-k*y-d*v-c*v*abs(v)",
            {"a": 0.9, "k": 36.0, "d": 0.5, "c": 0.5},
            holds={"F": "linear"},
        ),
    ),
    Recording(
        "chemostat",
        pair(REAL / "chemostat_biomass_only"),
        ("y",),
        {"D": "linear", "Sin": "linear"},
        "--states y --inputs D,Sin",
        Model(
            {"X": "m*S*X/(K+S)-D*X", "S": "D*(Sin-S)-m/q*S*X/(K+S)"},
            {"m": 0.5, "K": 1.2, "q": 0.5},
            {"y": "X"},
            holds={"D": "linear", "Sin": "linear"},
            starts={"X": 1.0, "S": 4.0},
        ),
        plain=plain(
            {"y": "a*y-D*y-b*y^2+c*Sin*y"},
            {"a": 0.3, "b": 0.1, "c": 0.01},
            holds={"D": "linear", "Sin": "linear"},
        ),
    ),
    Recording(
        "neuron",
        pair(REAL / "neuron_voltage_only"),
        ("y",),
        {"I": "linear"},
        "--embed y=2 --inputs I",
        Model(
            {"v": "a*v-b*v^3-r+c*I", "r": "d*v-e*r+f"},
            {"a": 0.9, "b": 0.3, "c": 0.9, "d": 0.09, "e": 0.07, "f": 0.05},
            {"y": "v"},
            holds={"I": "linear"},
            starts={"v": -1.0, "r": -0.5},
        ),
        plain=newton(
            "y",
            "a*v-b*y^2*v-k*y-c*y^3+g*I-o",
            {"a": 0.9, "b": 1.0, "k": 0.02, "c": 0.02, "g": 0.06, "o": 0.05},
            holds={"I": "linear"},
        ),
    ),
    Recording(
        "compartments",
        pair(REAL / "compartments_plasma_only"),
        ("y",),
        {"d": "linear"},
        "--states y --inputs d",
        Model(
            {"c1": "g*d-a*c1+b*c2", "c2": "e*c1-b*c2"},
            {"g": 0.09, "a": 0.7, "b": 0.35, "e": 0.45},
            {"y": "c1"},
            holds={"d": "linear"},
        ),
        plain=plain({"y": "g*d-a*y"}, {"g": 0.09, "a": 0.4}, holds={"d": "linear"}),
    ),
    heaters(
        "heater",
        SINES,
        "--states T1 --inputs Q1 --hold Q1=zero",
        plain(
            {"T1": "c-a*T1+k*Q1"},
            ROOM | {"late": 5.0},
            holds={"Q1": "zero"},
            late={"Q1": "late"},
            low={"late": 0.0},
        ),
    ),
    heaters(
        "heater_embedded",
        SINES,
        "--states T1 --embed T1=2 --inputs Q1 --hold Q1=zero",
        newton(
            "T1",
            "c-a*v-b*T1+k*Q1",
            {"c": 0.01, "a": 0.07, "b": 0.0005, "k": 0.0005},
            holds={"Q1": "zero"},
        ),
    ),
    heaters(
        "two_heaters_lab",
        LONG_SINES,
        "--states T1,T2 --inputs Q1 --hold Q1=zero",
        plain(
            {"h": "w*(Q1-h)", "T1": "c-a*T1+x*T2+k*h", "T2": "e*T1-b*T2+o"},
            {"w": 0.06, "c": 0.1, "a": 0.01, "x": 0.001, "k": 0.006, "e": 0.004, "b": 0.01}
            | {"o": 0.1},
            holds={"Q1": "zero"},
            low={"x": 0.0},
            outputs=("T1", "T2"),
        ),
    ),
    heaters(
        "heater_long_sines",
        LONG_SINES,
        "--states T1 --embed T1=2 --inputs Q1 --hold Q1=zero",
        newton(
            "T1",
            "c-a*v-b*T1+k*Q1",
            {"c": 0.01, "a": 0.07, "b": 0.0005, "k": 0.0005},
            holds={"Q1": "zero"},
        ),
    ),
    Recording(
        "two_tanks_lower",
        (DEVICES / "two_tanks/train.csv", DEVICES / "two_tanks/test.csv"),
        ("y",),
        {"u": "zero"},
        "--embed y=2 --inputs u --hold u=zero",
        Model(
            {
                "h": "(k*u-a*sqrt(19.62*max(h,0)))/0.5",
                "l": "(a*sqrt(19.62*max(h,0))-b*sqrt(19.62*max(l,0)))/0.25",
            },
            {"k": 0.0035, "a": 0.019, "b": 0.016},
            {"y": "l"},
            holds={"u": "zero"},
            starts={"h": 0.05, "l": 0.1},
        ),
        plain=newton(
            "y",
            "o-a*v-b*y+k*u",
            {"o": 0.0, "a": 0.5, "b": 0.05, "k": 0.002},
            holds={"u": "zero"},
        ),
    ),
    Recording(
        "oscillator",
        ((OSCILLATOR, 0, 7000), (OSCILLATOR, 7000, None)),
        ("x", "v"),
        {},
        "--states x,v",
        plain(
            {"x": "v", "v": "a*sin(x)-b*v^3-c*x^3-d*x*v-e*x*cos(x)"},
            {"a": 0.7, "b": 0.4, "c": 0.3, "d": 0.4, "e": 0.9},
        ),
    ),
    Recording(
        "oscillator_in_time",
        tuple(DEVICES / f"oscillators/oscillator2_{n}.csv.gz" for n in ("train", "out_of_domain")),
        ("x", "v"),
        {},
        "--states x,v",
        plain(
            {"x": "v", "v": "a*sin(t)-b*v^3-c*x*v-d*x*exp(e*x)"},
            {"a": 0.25, "b": 0.4, "c": 0.8, "d": 4.5, "e": 0.4},
        ),
    ),
    Recording(
        "pendulum_scope",
        (OWN / "pendulum_scope_1.csv.gz", OWN / "pendulum_scope_2.csv.gz"),
        ("th", "w"),
        {"u": "linear"},
        "--map th=CH1,w=CH2,u=CH3 --states th,w --inputs u",
        plain({"th": "w", "w": PENDULUM}, SWINGING, **TURNED),
        step=0.01,
    ),
    Recording(
        "pendulum_coulomb",
        tuple(PRACTICE / f"pendulum_coulomb/r{i}_n1.csv.gz" for i in (1, 2)),
        ("th", "w"),
        {"u": "linear"},
        "--states th,w --inputs u",
        plain({"th": "w", "w": PENDULUM}, SWINGING, **TURNED),
    ),
    Recording(
        "spring_cubic",
        tuple(PRACTICE / f"msd_cubic_stiffness/r{i}_n1.csv.gz" for i in (1, 2)),
        ("x", "v"),
        {"u": "linear"},
        "--states x,v --inputs u",
        plain(
            {"x": "v", "v": "g*u-k*x-d*v-c*x^3"},
            {"g": 1.2, "k": 20.0, "d": 0.5, "c": 9.0},
            holds={"u": "linear"},
        ),
    ),
    *(
        Recording(
            name,
            tuple(PRACTICE / f"{name}/r{i}_adc.csv.gz" for i in (1, 2)),
            ("x", "y", "z"),
            {},
            "--states x,y,z",
            rossler(10400.0, 2400.0),
            pieces=200,
        )
        for name in ("stock_tl072", "null_ideal", "hum_y")
    ),
]
