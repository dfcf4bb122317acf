"""Solved problems from two lists: docs/gallery.md, the examples of docs/machines.md, pictures.

Each problem has models of a few lines, commands, the lines of the answer that are shown and one of
the pictures that the last command draws. Answers and pictures are those of the program; a test of
the pages runs every block again.

Usage: gallery.py PROGRAM [PART]   (PART: only problems whose title has it; prints, writes nothing)
"""

import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
SCOPE = "--map th=CH1,w=CH2,u=CH3"


class Problem(NamedTuple):
    """A question, what is run, which lines answer it, and what shows it."""

    title: str
    question: str
    models: dict
    commands: list
    answer: list    # patterns of the lines that are shown
    picture: str    # of those that --plot writes
    caption: str


def driven(law, drive="2*sin(1.1*t) + sin(2.7*t)"):
    """A bench on which a mass is driven; the force is measured."""
    return (f"state x [m]\nstate v [m/s]\ndx/dt = v\ndv/dt = {law} + {drive}\n"
            f"F = {drive} [m/s^2]\n")


def nominal(law):
    """The model of such a bench."""
    return (f"time s\ninput F [m/s^2] hold smooth\nstate x [m]\nstate v [m/s]\n"
            f"dx/dt = v\ndv/dt = {law} + F\n")


RECORD = "lacuna simulate {0} --x0 {1} --t-end {2} --dt {3} --noise {4} -o {5}"

PROBLEMS = [
    Problem(
        "A pendulum on a motor",
        "An oscilloscope saw it twice. What does the model on the desk lack?",
        {}, ["lacuna diagnose --model data/pendulum.ode data/pendulum_scope_1.csv.gz "
         f"--holdout data/pendulum_scope_2.csv.gz {SCOPE}"],
        ["^Explained", "^Equation w", "^On records"], "deviation_w",
        "Measured speed minus model: the nominal one, and with the friction; the noise as a band"),
    Problem(
        "Lorenz's convection", "Three signals with noise, no model. Which equations do they obey?",
        {"lorenz.ode": "state x\nstate y\nstate z\ndx/dt = 10*(y - x)\ndy/dt = x*(28 - z) - y\n"
                       "dz/dt = x*y - 8/3*z\n"},
        [RECORD.format("lorenz.ode", "1,1,20", 20, 0.01, "x=0.1,y=0.1,z=0.1", "lorenz.csv"),
         "lacuna identify lorenz.csv --degree 2"],
        ["^  d[xyz]/dt"], "comparison_x", "The signal x and the model, in windows of one period"),
    Problem(
        "Van der Pol's valve", "One trace winds onto a cycle. What feeds it?",
        {"valve.ode": "state x [V]\nstate y [V]\ndx/dt = y\ndy/dt = 2*(1 - x^2)*y - x\n"},
        [RECORD.format("valve.ode", "0.1,0", 30, 0.02, "x=0.02,y=0.02", "valve.csv"),
         "lacuna identify valve.csv --degree 3"],
        ["^Fits", "^  d[xy]/dt"], "comparison_y",
        "The signal y and the model, in windows of one period"),
    Problem(
        "A spring that hardens", "A shaken mass; the force is measured. Is the spring linear?",
        {"shaker.ode": driven("-3*x - 0.3*v - 2*x^3")},
        [RECORD.format("shaker.ode", "0,0", 40, 0.02, "x=0.005,v=0.01", "shaker.csv"),
         "lacuna identify shaker.csv --inputs F --degree 3"],
        ["^Fits", "^  d[xv]/dt"], "comparison_x", "The displacement and the model"),
    Problem(
        "A dose by mouth", "Concentrations in the blood only. How fast is the drug absorbed?",
        {"patient.ode": "time h\nstate a [mg]\nstate b [mg]\nda/dt = -1.2*a\n"
                        "db/dt = 1.2*a - 0.15*b\nconc = b/20 [mg/L]\n",
         "dose.ode": "time h\nstate gut [mg]\nstate blood [mg]\nparam ka = 0.5 [1/h] in 0.1..10\n"
                     "param ke = 0.3 [1/h] in 0.01..3\nparam V = 10 [L] in 1..100\n"
                     "dgut/dt = -ka*gut\ndblood/dt = ka*gut - ke*blood\nconc = blood/V [mg/L]\n"
                     "initial gut = 100 at 0 fixed\ninitial blood = 0 at 0 fixed\n"},
        [RECORD.format("patient.ode", "100,0", 24, 0.5, "conc=0.05", "blood.csv"),
         "lacuna fit dose.ode blood.csv"],
        ["^ *(ka|ke|V) ", "^Verdict"], "comparison_conc",
        "Measured concentrations and the fitted model"),
    Problem(
        "An epidemic",
        "Only the infected are counted. How contagious is it, how long does it last?",
        {"town.ode": "time d\nstate a\nstate b\nda/dt = -0.5*a*b/1000\n"
                     "db/dt = 0.5*a*b/1000 - 0.2*b\ncases = b\n",
         "sir.ode": "time d\nstate S\nstate I\nparam beta = 0.3 [1/d] in 0.01..5\n"
                    "param gamma = 0.1 [1/d] in 0.01..5\ndS/dt = -beta*S*I/1000\n"
                    "dI/dt = beta*S*I/1000 - gamma*I\ncases = I\n"
                    "initial S = 998 at 0 fixed\ninitial I = 2 at 0 fixed\n"},
        [RECORD.format("town.ode", "998,2", 60, 1, "cases=3", "cases.csv"),
         "lacuna fit sir.ode cases.csv"],
        ["^ *(beta|gamma) ", "^Verdict"], "comparison_I", "Counted cases and the fitted model"),
    Problem(
        "A paddle in air", "The model has viscous drag. Is that what the air does?",
        {"paddle.ode": driven("-0.8*x - 0.2*v - 0.25*v*abs(v)"),
         "viscous.ode": nominal("-0.8*x - 0.2*v")},
        [RECORD.format("paddle.ode", "0,0", 40, 0.02, "x=0.01,v=0.02", "paddle.csv"),
         "lacuna diagnose --model viscous.ode paddle.csv"],
        ["^Equation", "^On records"], "comparison_v",
        "The speed: measured, nominal model, with the drag of the square"),
    Problem(
        "A diode across a capacitor",
        "A linear circuit bends one of its waves. Which part conducts?",
        {"bench.ode": "time ms\nstate i [mA]\nstate v [V]\n"
                      "di/dt = 2*(2.2*sin(1.1*t) + 0.9*sin(2.7*t)) - 2*v - 0.6*i\n"
                      "dv/dt = 0.8*i - 0.002*(exp(v/0.3) - 1)\n"
                      "u = 2.2*sin(1.1*t) + 0.9*sin(2.7*t) [V]\n",
         "linear.ode": "time ms\ninput u [V] hold smooth\nstate i [mA]\nstate v [V]\n"
                       "di/dt = 2*u - 2*v - 0.6*i\ndv/dt = 0.8*i\n"},
        [RECORD.format("bench.ode", "0,0", 40, 0.02, "i=0.01,v=0.01", "circuit.csv"),
         "lacuna diagnose --model linear.ode circuit.csv"],
        ["^Equation", "^On records"], "comparison_v",
        "The voltage: measured, nominal model, with the diode"),
    Problem(
        "A command that comes late", "The controller's model fits badly whatever its gain. Why?",
        {"plant.ode": "state x [m]\nstate v [m/s]\ndx/dt = v\n"
                      "dv/dt = -2*x - 0.5*v + 2*sin(1.1*(t - 0.15)) + sin(2.7*(t - 0.15))\n"
                      "F = 2*sin(1.1*t) + sin(2.7*t) [m/s^2]\n",
         "prompt.ode": nominal("-2*x - 0.5*v")},
        [RECORD.format("plant.ode", "0,0", 40, 0.02, "x=0.005,v=0.01", "plant.csv"),
         "lacuna diagnose --model prompt.ode plant.csv"],
        ["^Equation", "^On records"], "rivals", "Every explanation that was judged"),
    Problem(
        "A model that is complete", "Does it lack anything? An honest answer may be no.",
        {"bench.ode": driven("-2*x - 0.5*v"), "model.ode": nominal("-2*x - 0.5*v")},
        [RECORD.format("bench.ode", "0,0", 40, 0.02, "x=0.005,v=0.01", "bench.csv"),
         "lacuna diagnose --model model.ode bench.csv"],
        ["^No discrepancy", "^On records"], "comparison_v", "The speed and the model"),
    Problem(
        "Degrees for radians",
        "The model is right, and nothing fits. What went wrong with the file?",
        {"bench.ode": "time s\nstate a\nstate b\nda/dt = b\n"
                      "db/dt = -19.62*sin(a) - 0.3*b\nth = a*180/pi\nw = b\n",
         "pendulum.ode": "time s\nstate th [rad]\nstate w [rad/s]\ndth/dt = w\n"
                         "dw/dt = -19.62*sin(th) - 0.3*w\n"},
        [RECORD.format("bench.ode", "0.8,0", 10, 0.01, "th=0.1,w=0.02", "angles.csv"),
         "lacuna diagnose --model pendulum.ode angles.csv",
         "lacuna sync pendulum.ode angles.csv"],
        ["^Hint", "^Does not hold"], "comparison_w", "The speed and the model as they are"),
    Problem(
        "The next experiment",
        "Viscous or dry friction? Which input distinguishes them, within a safe range?",
        {"viscous.ode": nominal("-0.3*v").replace("state x [m]\n", "").replace("dx/dt = v\n", "")
                        .replace("hold smooth", "hold zero"),
         "dry.ode": nominal("-0.2*tanh(v/0.01)").replace("state x [m]\n", "")
                    .replace("dx/dt = v\n", "").replace("hold smooth", "hold zero")},
        ["lacuna plan viscous.ode dry.ode --input 'F=-1..1, hold 0.5, family steps, pieces 6' "
         "--measure v=0.02 --safe v=-2..2 --duration 6 --sample 0.05 --candidates 40 "
         "--searches 1 --evaluations 60"],
        ["^This experiment", "^Run 1", "^Safe"], "responses_1_v", "What both models do under it"),
]


def machine(title, truth, nominal_model, begin, end, step, noise, picture, caption):
    """An example of docs/machines.md: a machine that is simulated, and its first model."""
    (name, law), (short, model) = truth, nominal_model
    record = name.replace(".ode", ".csv")
    return Problem(
        title, "", {name: law, short: model},
        [RECORD.format(name, begin, end, step, noise, record),
         f"lacuna diagnose --model {short} {record}"],
        ["^Equation", "^On records"], picture, caption)


DRIVE = "2*sin(1.1*t) + sin(2.7*t)"

MACHINES = [
    machine(
        "Robot joint, geared servo",
        ("arm.ode", "state q [rad]\nstate w [rad/s]\ndq/dt = w\n"
         f"dw/dt = 3*({DRIVE}) - 9*sin(q) - 0.4*w - 0.8*tanh(w/0.05)\ni = {DRIVE} [A]\n"),
        ("joint.ode", "time s\ninput i [A] hold smooth\nstate q [rad]\nstate w [rad/s]\n"
         "dq/dt = w\ndw/dt = 3*i - 9*sin(q) - 0.4*w\n"),
        "0.3,0", 40, 0.02, "q=0.003,w=0.01", "deviation_w",
        "Measured speed minus model: the nominal one, and with dry friction"),
    machine(
        "Propeller, fan, valve",
        ("rotor.ode", "state th [rad]\nstate w [rad/s]\ndth/dt = w\n"
         "dw/dt = 6*(1 + 0.4*(64*sin(1.1*t) - 8.8*cos(1.1*t))/65.21"
         " + 0.3*(64*sin(3.7*t) - 29.6*cos(3.7*t))/77.69)^2 - 30*sin(th) - 0.8*w\n"
         "u = 1 + 0.4*sin(1.1*t) + 0.3*sin(3.7*t) [V]\n"),
        ("propeller.ode", "time s\ninput u [V] hold smooth\nstate th [rad]\n"
         "state w [rad/s]\ndth/dt = w\ndw/dt = 6*u^2 - 30*sin(th) - 0.8*w\n"),
        "0.2,0", 40, 0.02, "th=0.002,w=0.01", "deviation_th",
        "Measured angle minus model: the nominal one, and with a rotor that has to speed up"),
    machine(
        "Heater, room, oven",
        ("oven.ode", "time min\nstate T [degC]\ndT/dt = 0.6 + 0.4*sin(0.21*t)"
         " + 0.3*sin(0.057*t) - 0.05*(T - 18) - 0.5*clip(t - 200, 0, 1)\n"
         "P = 6 + 4*sin(0.21*t) + 3*sin(0.057*t) [kW]\n"),
        ("heater.ode", "time min\ninput P [kW] hold smooth\nstate T [degC]\n"
         "dT/dt = 0.1*P - 0.05*(T - 18)\n"),
        "24", 400, 0.5, "T=0.02", "deviation_T",
        "Measured temperature minus model: the nominal one, and with a door that opens"),
    machine(
        "Tank, vessel",
        ("vessel.ode", "state h [m]\ndh/dt = 0.02 + 0.015*sin(0.05*t) + 0.012*sin(0.017*t)"
         " - 0.02*sqrt(h) - 0.05*max(h - 1.5, 0)\n"
         "u = 2 + 1.5*sin(0.05*t) + 1.2*sin(0.017*t) [V]\n"),
        ("tank.ode", "time s\ninput u [V] hold smooth\nstate h [m]\n"
         "dh/dt = 0.01*u - 0.02*sqrt(h)\n"),
        "1", 1200, 1, "h=0.003", "deviation_h",
        "Measured level minus model: the nominal one, and with the overflow"),
    machine(
        "Reactor, cell culture",
        ("enzyme.ode", "time min\nstate S [mM]\nstate P [mM]\n"
         "dS/dt = 0.5 + 0.4*sin(0.3*t) - 1.5*S/(2 + S + 1.2*P)\n"
         "dP/dt = 1.5*S/(2 + S + 1.2*P) - 0.4*P\nfeed = 0.5 + 0.4*sin(0.3*t) [mM/min]\n"),
        ("reactor.ode", "time min\ninput feed [mM/min] hold smooth\nstate S [mM]\n"
         "state P [mM]\ndS/dt = feed - 1.5*S/(2 + S)\ndP/dt = 1.5*S/(2 + S) - 0.4*P\n"),
        "1,0.5", 150, 0.25, "S=0.005,P=0.005", "deviation_S",
        "Measured substrate minus model: the nominal one, and with a product that inhibits"),
    machine(
        "Circuit",
        ("stage.ode", "time ms\nstate x [V]\nstate y [V]\n"
         "dx/dt = 4*sin(1.3*t) + 2*sin(0.31*t) - 0.5*x - 2*y\n"
         "dy/dt = 2*clip(x, -1.5, 1.5) - 0.4*y\nu = 2*sin(1.3*t) + sin(0.31*t) [V]\n"),
        ("filter.ode", "time ms\ninput u [V] hold smooth\nstate x [V]\nstate y [V]\n"
         "dx/dt = 2*u - 0.5*x - 2*y\ndy/dt = 2*x - 0.4*y\n"),
        "0,0", 60, 0.02, "x=0.01,y=0.01", "deviation_y",
        "Measured voltage minus model: the nominal one, and with a stage that limits"),
    machine(
        "Cart, stage",
        ("rail.ode", "state x [m]\nstate v [m/s]\ndx/dt = v\n"
         f"dv/dt = {DRIVE} - 2*x - 0.5*v - 12*max(x - 0.8, 0)\nF = {DRIVE} [m/s^2]\n"),
        ("cart.ode", "time s\ninput F [m/s^2] hold smooth\nstate x [m]\nstate v [m/s]\n"
         "dx/dt = v\ndv/dt = F - 2*x - 0.5*v\n"),
        "0,0", 40, 0.02, "x=0.003,v=0.01", "deviation_x",
        "Measured place minus model: the nominal one, and with an end stop"),
]


def run(command, folder, program):
    """What a command prints."""
    typed = command.replace("lacuna ", f"'{program}' ", 1)
    done = subprocess.run(typed, shell=True, cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{command}\n{done.stderr}{done.stdout}")
    return done.stdout


def solved(problem, folder, program):
    """Runs a problem in a folder, into which its pictures go (plots). What all of it printed."""
    (folder / "data").symlink_to(ROOT / "data")
    for name, text in problem.models.items():
        (folder / name).write_text(text)
    *before, last = problem.commands
    return "".join(run(command, folder, program) for command in [*before, last + " --plot plots"])


def answer(problem, printed):
    """The lines of the answer that are shown, with what is folded behind them."""
    shown, depth = [], None
    for line in printed.splitlines():
        indent = len(line) - len(line.lstrip())
        if any(re.search(pattern, line) for pattern in problem.answer):
            depth = indent
        elif not line or depth is None or indent <= depth:
            depth = None
        if depth is not None:
            shown.append(line)
    return shown


def slug(title):
    return re.sub("[^a-z]+", "_", title.lower()).strip("_")


def section(problem, shown, folder):
    """The part of the page on a problem."""
    lines = []
    for name, text in problem.models.items():
        lines += [f"```ode {name}", *text.strip().splitlines(), "```", ""]
    lines += ["```sh", *problem.commands, "```", "", "```text", *shown, "```", ""]
    return lines + [f"![{problem.caption}](pictures/{folder}/{slug(problem.title)}.svg)", ""]


HEAD = """# Gallery

Twelve problems, each with its record, commands, answer and one picture of those that `--plot` writes.
Records are shipped or made on the spot by a fixed seed. `scripts/gallery.py` writes this page from
one list; a test (`tests/integration/pages_test.cpp`) runs every block of it.
"""


def shown_of(problem, pictures, program):
    """Runs a problem and keeps its picture, where there is a folder for it: the answer."""
    with tempfile.TemporaryDirectory() as name:
        begin = time.time()
        shown = answer(problem, solved(problem, Path(name), program))
        print(f"{problem.title}: {time.time() - begin:.1f} s", *shown, sep="\n")
        if pictures:
            pictures.mkdir(exist_ok=True)
            shutil.copy(Path(name) / "plots" / f"{problem.picture}.svg",
                        pictures / f"{slug(problem.title)}.svg")
    return shown


def write_gallery(program):
    page = HEAD.splitlines() + [""]
    for problem in PROBLEMS:
        shown = shown_of(problem, ROOT / "docs/pictures/gallery", program)
        page += [f"## {problem.title}", "", problem.question, ""]
        page += section(problem, shown, "gallery")
    (ROOT / "docs/gallery.md").write_text("\n".join(page).rstrip() + "\n")


def write_machines(program):
    """The examples of docs/machines.md, each behind the table of its machine."""
    page = ROOT / "docs/machines.md"
    for problem in MACHINES:
        shown = shown_of(problem, ROOT / "docs/pictures/machines", program)
        before, heading, rest = page.read_text().partition(f"\n## {problem.title}\n")
        own, following, others = rest.partition("\n## ")
        own = own.partition("\nAn example:\n")[0].rstrip("\n") + "\n"
        example = "\n".join(["", "An example:", "", *section(problem, shown, "machines")])
        page.write_text(before + heading + own + example + following + others)


def main(program, part):
    """Writes the pages and their pictures, or shows the answers of some problems."""
    if not part:
        write_gallery(program)
        write_machines(program)
        return
    for problem in [*PROBLEMS, *MACHINES]:
        if part in problem.title:
            shown_of(problem, None, program)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), sys.argv[2] if len(sys.argv) > 2 else "")
