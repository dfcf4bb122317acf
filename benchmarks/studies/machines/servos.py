# SPDX-License-Identifier: MIT
"""Pendulums on the axes of geared servos, whose friction climbs a ladder of six laws.

    J w' = t_m + t_e - viscous w - F sign(w)
    F = base + load + s (stribeck + load_stribeck + quad)

with s = exp(-|w / speed|^alpha), t_m = kt i the torque of the motor and t_e = -m g l sin(q) that
of gravity; a joint at rest stays there while |t_m + t_e| < F. Numbers of `servo_friction.csv`:
M. Duclusaud, G. Passault et al., arXiv 2410.08650 (the load acts as |t_e - t_m|, from the fifth
rung on as |external t_e - motor t_m|). The list was written down before any was diagnosed; cases
that are `kept` are not looked at while the program is changed.
"""

import csv
import dataclasses
import pathlib

import numpy as np

SERVOS = ("erob80_100", "erob80_50", "mx106", "mx64", "xl320", "xl330")
RUNGS = ("m1", "m2", "m3", "m4", "m5", "m6")
NOISES = (0.001, 0.01)  # of the deviation of a channel, of the angle at most of 1 rad
STEP, COUNT, SUBSTEPS = 0.01, 4000, 20


@dataclasses.dataclass(frozen=True)
class Case:
    servo: str
    rung: str
    noise: float
    seed: int
    coulomb: bool  # whether the nominal model has dry friction already
    kept: bool

    @property
    def name(self):
        return f"{self.servo}_{self.rung}_{self.noise:g}"


def all_cases():
    cells = [
        (i, s, j, r, n)
        for i, s in enumerate(SERVOS)
        for j, r in enumerate(RUNGS)
        for n in NOISES
    ]
    return [
        Case(s, r, n, 9100 + k, coulomb=(r != "m1" and (i + j) % 2 == 0), kept=(k % 3 == 2))
        for k, (i, s, j, r, n) in enumerate(cells)
    ]


CASES = all_cases()


def numbers_of(servo, rung):
    lines = pathlib.Path(__file__).with_name("servo_friction.csv").read_text().splitlines()
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        if (row["actuator"], row["model"]) == (servo, rung):
            return {k: float(v) if v else 0.0 for k, v in list(row.items())[2:]}
    raise KeyError((servo, rung))


class Servo:
    """A servo with a pendulum whose weight takes four times the dry friction to hold."""

    def __init__(self, case):
        self.case, self.n = case, numbers_of(case.servo, case.rung)
        self.gravity = 4 * numbers_of(case.servo, "m1")["friction_base"]
        length = 0.25
        self.inertia = self.n["armature"] + self.gravity * length / 9.81

    def friction(self, w, motor, external):
        """The largest dry friction at a speed, N m."""
        n, rung = self.n, self.case.rung
        slow = 0.0
        if rung not in ("m1", "m3"):
            slow = np.exp(-(np.abs(w / n["dtheta_stribeck"]) ** n["alpha"]))
        if rung in ("m1", "m2"):
            load, load_slow = 0.0, 0.0
        elif rung in ("m3", "m4"):
            load = n["load_friction_base"] * np.abs(external - motor)
            load_slow = n["load_friction_stribeck"] * np.abs(external - motor)
        else:
            load = np.abs(n["load_friction_external"] * external - n["load_friction_motor"] * motor)
            load_slow = np.abs(
                n["load_friction_external_stribeck"] * external
                - n["load_friction_motor_stribeck"] * motor
            )
        quad = 0.0
        if rung == "m6":
            smaller = np.where(
                np.abs(external) < np.abs(motor),
                n["load_friction_external_quad"] * external**2,
                n["load_friction_motor_quad"] * motor**2,
            )
            quad = np.where(external * motor < 0, smaller, 0.0)
        return n["friction_base"] + load + slow * (n["friction_stribeck"] + load_slow + quad)

    def drive(self, rng):
        """The current at the samples: three tones, and steps that are held for a while."""
        time = STEP * np.arange(COUNT)
        own = np.sqrt(self.gravity / self.inertia)
        top = self.gravity / self.n["kt"]
        tones = sum(
            top * rng.uniform(0.2, 0.45) * np.sin(own * f * time + rng.uniform(0, 6.283))
            for f in rng.uniform(0.15, 0.8, 3)
        )
        holds = rng.uniform(-0.6, 0.6, COUNT // 50 + 1) * top
        return tones + np.repeat(holds, 50)[:COUNT]

    def record(self, number):
        """t, q, w with noise and the current, without it, and the true states."""
        rng = np.random.default_rng([self.case.seed, number])
        current = self.drive(rng)
        q, w, states = rng.uniform(-0.5, 0.5), 0.0, np.empty((COUNT, 2))
        for k in range(COUNT):
            states[k] = q, w
            q, w = self.moved(q, w, self.n["kt"] * current[k])
        noise = self.case.noise * np.minimum(states.std(axis=0), (1.0, np.inf))
        return current, states, states + noise * rng.standard_normal(states.shape)

    def moved(self, q, w, motor):
        """A sample later: small steps, with rest where friction holds the joint."""
        h = STEP / SUBSTEPS
        for _ in range(SUBSTEPS):
            external = -self.gravity * np.sin(q)
            torque = motor + external
            dry = float(self.friction(w, motor, external))
            side = np.sign(w) if w != 0 else np.sign(torque)
            if w == 0 and abs(torque) <= dry:
                continue
            faster = w + h * (torque - self.n["friction_viscous"] * w - dry * side) / self.inertia
            w = 0.0 if w * faster < 0 else faster
            q += h * w
        return q, w

    def nominal(self):
        n, J = self.n, self.inertia
        dry = f" - {0.8 * numbers_of(self.case.servo, 'm1')['friction_base'] / J:.6g}*sign(w)"
        return (
            "time s\ninput i [A] hold zero\nstate q [rad]\nstate w [rad/s]\ndq/dt = w\n"
            f"dw/dt = {n['kt'] / J:.6g}*i - {self.gravity / J:.6g}*sin(q)"
            f" - {n['friction_viscous'] / J:.6g}*w" + (dry if self.case.coulomb else "") + "\n"
        )

    def rate(self, q, w, current):
        """The true dw/dt of a joint that moves."""
        motor, external = self.n["kt"] * current, -self.gravity * np.sin(q)
        dry = self.friction(w, motor, external) * np.sign(w)
        return (motor + external - self.n["friction_viscous"] * w - dry) / self.inertia
