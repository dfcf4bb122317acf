# SPDX-License-Identifier: MIT
"""Twenty pendulums, swings and oscillators that move freely; only the angle, behind an encoder.

The list was written down before any of them was identified; cases that are `kept` are not looked
at while the program is changed.
"""

import dataclasses

import numpy as np

from simulation import runge_kutta


@dataclasses.dataclass(frozen=True)
class Swing:
    name: str
    kind: str  # pendulum, swing (slow, long), oscillator (a spring)
    steps: int  # of the encoder, a turn
    amplitude: float  # rad
    seed: int
    kept: bool = False


SWINGS = [
    Swing("pendulum_fine", "pendulum", 4096, 2.9, 8101),
    Swing("pendulum_wide", "pendulum", 2048, 2.6, 8102),
    Swing("pendulum_coarse", "pendulum", 200, 2.8, 8103, kept=True),
    Swing("pendulum_three_quarters", "pendulum", 500, 2.2, 8104),
    Swing("pendulum_half", "pendulum", 1000, 1.6, 8105),
    Swing("pendulum_quarter", "pendulum", 1024, 1.2, 8106, kept=True),
    Swing("pendulum_small", "pendulum", 4096, 0.8, 8107),
    Swing("pendulum_low_steps", "pendulum", 360, 1.9, 8108),
    Swing("pendulum_near_the_top", "pendulum", 800, 2.9, 8109, kept=True),
    Swing("swing_of_a_playground", "swing", 1000, 1.0, 8110),
    Swing("swing_pushed_high", "swing", 600, 1.7, 8111, kept=True),
    Swing("bell", "swing", 2000, 2.4, 8112),
    Swing("boom", "swing", 400, 1.4, 8113),
    Swing("crane_load", "swing", 4000, 0.7, 8114, kept=True),
    Swing("torsion_bar", "oscillator", 200, 1.5, 8115),
    Swing("balance_wheel", "oscillator", 720, 2.9, 8116, kept=True),
    Swing("flywheel_on_a_spring", "oscillator", 1024, 1.0, 8117),
    Swing("needle", "oscillator", 2048, 0.3, 8118),
    Swing("wheel_on_a_wire", "oscillator", 500, 0.6, 8119, kept=True),
    Swing("disc_on_a_rod", "oscillator", 4096, 2.0, 8120),
]


@dataclasses.dataclass
class SwingRecord:
    time: np.ndarray
    angle: np.ndarray
    stiffness: float  # of sin(th), or of th
    damping: float  # 1/s


def terms_of(swing):
    """What is right in the equation of the speed."""
    return {"th" if swing.kind == "oscillator" else "sin(th)", "th_d1"}


def swing_record(swing):
    """15 to 35 swings at 60 to 150 samples each, released from rest at an angle."""
    rng = np.random.default_rng(swing.seed)
    stiffness = {"pendulum": (10, 45), "swing": (2, 6), "oscillator": (8, 90)}[swing.kind]
    stiffness = rng.uniform(*stiffness)
    turn = 6.283 / stiffness**0.5
    step = float(rng.choice([0.005, 0.01, 0.02])) if swing.kind != "swing" else 0.02
    step = max(step, round(turn / 150, 3))
    count = int(rng.uniform(15, 35) * turn / step)
    damping = rng.uniform(0.5, 2) / (count * step)
    bent = swing.kind != "oscillator"

    def rates(t, x):
        back = np.sin(x[0]) if bent else x[0]
        return (x[1], -stiffness * back - damping * x[1])

    x, angles = (swing.amplitude * float(rng.choice([-1, 1])), 0.0), []
    for _ in range(count):
        angles.append(float(x[0]))
        for _ in range(10):
            x = runge_kutta(rates, x, step / 10)
    lattice = 2 * np.pi / swing.steps
    angle = np.round(np.array(angles) / lattice) * lattice
    return SwingRecord(np.arange(count) * step, angle, stiffness, damping)
