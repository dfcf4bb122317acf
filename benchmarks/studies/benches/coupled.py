# SPDX-License-Identifier: MIT
"""Benches with several measured states, most with more than one input.

Written down, with what holds, before any of them was diagnosed.
"""

import numpy as np
from benches import BEYOND, Bench, bench, channels_of, noisy, on_lattice, simulate, steps, switch


@bench("coupled", lacks=("T2:missing-coupling", "T3:missing-coupling", "T2:linear-term",
                         "T3:linear-term", "T2:extra-state"))
def rooms_with_a_door(rng):
    """Three rooms in a row; the door between the last two stands open."""
    time = np.arange(2000) * 5.0
    heat = np.column_stack([steps(rng, 2000, 0, 2, 30, 150), steps(rng, 2000, -5, 12, 60, 240)])

    def rates(t, x, u):
        out = u[1]
        return np.array([
            0.05 * u[0] - 6e-3 * (x[0] - x[1]) - 2e-3 * (x[0] - out),
            6e-3 * (x[0] - x[1]) - 4e-3 * (x[1] - x[2]) - 2e-3 * (x[1] - out),
            4e-3 * (x[1] - x[2]) - 3e-3 * (x[2] - out),
        ])

    x = simulate(rates, [18, 16, 14], time, heat, 2)
    model = (
        "time min\ninput P [kW] hold zero\ninput Te [degC] hold zero\n"
        "param g = 0.04\nparam c = 5e-3\nparam a = 2.5e-3\nparam b = 2.5e-3\nparam d = 3.5e-3\n"
        "dT1/dt = g*P - c*(T1-T2) - a*(T1-Te)\n"
        "dT2/dt = c*(T1-T2) - b*(T2-Te)\n"
        "dT3/dt = -d*(T3-Te)\n"
    )
    names = ["T1 [degC]", "T2 [degC]", "T3 [degC]"]
    inputs = {"P [kW]": heat[:, 0], "Te [degC]": heat[:, 1]}
    return Bench(time, channels_of(rng, names, x, 0.4), inputs, model)


@bench("coupled", lacks=("w1:cross-term", "w2:cross-term", "w3:cross-term"))
def body_that_turns(rng):
    """A body with three torques; the model forgets that its moments of inertia differ."""
    time = np.arange(2500) * 0.02
    torque = np.column_stack([steps(rng, 2500, -2, 2, 20, 100) for _ in range(3)])

    def rates(t, x, u):
        return np.array([
            u[0] - 0.5 * x[0] - 0.5 * x[1] * x[2],
            u[1] - 0.6 * x[1] + 0.7 * x[0] * x[2],
            u[2] - 0.4 * x[2] - 0.2 * x[0] * x[1],
        ])

    x = simulate(rates, [0, 0, 0], time, torque, 4)
    model = "time s\n" + "".join(f"input M{k} hold zero\n" for k in (1, 2, 3))
    model += "".join(f"param a{k} = 0.9\nparam b{k} = 0.6\n" for k in (1, 2, 3))
    model += "".join(f"dw{k}/dt = a{k}*M{k} - b{k}*w{k}\n" for k in (1, 2, 3))
    names = [f"w{k} [rad/s]" for k in (1, 2, 3)]
    inputs = {f"M{k}": torque[:, k - 1] for k in (1, 2, 3)}
    return Bench(time, channels_of(rng, names, x, 0.5), inputs, model)


@bench("coupled", lacks=BEYOND)
def car_with_soft_tyres(rng):
    """Side forces of the tyres saturate with the angle of slip, which is a sum of three terms."""
    time = np.arange(2400) * 0.02
    steer = steps(rng, 2400, -0.12, 0.12, 20, 90)

    def rates(t, x, u):
        front = 14 * 0.04 * np.tanh((u - (x[0] + 1.2 * x[1]) / 20) / 0.04)
        rear = 17 * 0.04 * np.tanh(-(x[0] - 1.4 * x[1]) / 20 / 0.04)
        return np.array([9 * (front + rear) - 20 * x[1], 6 * (1.2 * front - 1.4 * rear)])

    x = simulate(rates, [0, 0], time, steer, 8)
    model = (
        "time s\ninput s [rad] hold zero\nparam a = 13\nparam b = 18\nparam c = 110\n"
        "param d = 0.3\nparam e = 11\nparam f = 90\n"
        "dy/dt = -a*y - b*r + c*s\ndr/dt = d*y - e*r + f*s\n"
    )
    return Bench(time, channels_of(rng, ["y [m/s]", "r [rad/s]"], x, 0.5), {"s [rad]": steer},
                 model)


@bench("coupled", lacks=("w2:coulomb-friction",))
def drive_with_a_shaft(rng):
    """Motor and load with a shaft between them; the load has dry friction."""
    time = np.arange(3000) * 0.005
    torque = steps(rng, 3000, -4, 4, 40, 200)

    def rates(t, x, u):
        shaft = 90 * x[2] + 0.4 * (x[0] - x[1])
        return np.array([
            3 * u - 0.3 * x[0] - shaft,
            0.7 * shaft - 0.2 * x[1] - 1.8 * switch(x[1], 0.02),
            x[0] - x[1],
        ])

    x = simulate(rates, [0, 0, 0], time, torque, 10)
    model = (
        "time s\ninput M [N m] hold zero\nparam a = 2.7\nparam b = 0.4\nparam k = 80\n"
        "param c = 0.5\nparam m = 0.6\nparam d = 0.3\n"
        "dw1/dt = a*M - b*w1 - k*p - c*(w1-w2)\n"
        "dw2/dt = m*k*p + m*c*(w1-w2) - d*w2\ndp/dt = w1 - w2\n"
    )
    names = ["w1 [rad/s]", "w2 [rad/s]", "p [rad]"]
    return Bench(time, channels_of(rng, names, x, 0.3), {"M [N m]": torque}, model)


@bench("coupled", lacks=("A:quadratic-term",), also=("B:quadratic-term",))
def reactor_of_second_order(rng):
    """A becomes B by a reaction of second order beside the one that is known."""
    time = np.arange(2400) * 0.05
    feed = steps(rng, 2400, 0.2, 2.5, 30, 140)

    def rates(t, x, u):
        return np.array([
            0.8 * (u - x[0]) - 0.5 * x[0] - 0.6 * x[0] ** 2,
            0.5 * x[0] - 0.8 * x[1] - 0.3 * x[1],
        ])

    x = simulate(rates, [0.5, 0.2], time, feed, 2)
    model = (
        "time min\ninput cf hold zero\nparam q = 0.8 fixed\nparam k1 = 0.7\nparam k2 = 0.25\n"
        "dA/dt = q*(cf-A) - k1*A\ndB/dt = k1*A - q*B - k2*B\n"
    )
    return Bench(time, channels_of(rng, ["A", "B"], x, 0.5), {"cf": feed}, model)


@bench("coupled")
def chain_of_three(rng):
    """Prey, hunters and hunters of these: the model is complete, its numbers are not right."""
    time = np.arange(2000) * 0.1

    def rates(t, x, u):
        eaten, hunted = 1.2 * x[0] * x[1] / (1 + x[0]), 0.5 * x[1] * x[2]
        return np.array([
            x[0] * (1 - 0.4 * x[0]) - eaten, 0.8 * eaten - 0.2 * x[1] - hunted,
            0.6 * hunted - 0.1 * x[2],
        ])

    x = simulate(rates, [1, 0.5, 0.8], time, None, 4)
    model = (
        "time d\nparam r = 1.1\nparam m = 0.4\nparam a = 1.1\nparam e = 1.1\nparam d = 0.25\n"
        "param h = 0.45\nparam g = 0.3\nparam l = 0.12\n"
        "dx/dt = r*x - m*x^2 - a*x*y/(1+x)\ndy/dt = e*x*y/(1+x) - d*y - h*y*z\n"
        "dz/dt = g*y*z - l*z\n"
    )
    return Bench(time, channels_of(rng, ["x", "y", "z"], x, 1), {}, model)


@bench("coupled", lacks=("w:missing-coupling", "w:linear-term", "w:cross-term",
                         "w:cubic-stiffness", "w:cubic-term"))
def arm_that_hangs(rng):
    """An arm on a motor whose current is measured; the model forgets its weight."""
    time = np.arange(3000) * 0.01
    volts = steps(rng, 3000, -1.5, 1.5, 30, 150)

    def rates(t, x, u):
        return np.array([
            x[1], 20 * x[2] - 0.8 * x[1] - 12 * np.sin(x[0]), 5 * u - 15 * x[2] - 0.5 * x[1]
        ])

    x = simulate(rates, [0, 0, 0], time, volts, 4)
    model = (
        "time s\ninput u [V] hold zero\nparam k = 18\nparam b = 1\nparam g = 4.5\n"
        "param r = 13\nparam e = 0.6\n"
        "dth/dt = w\ndw/dt = k*i - b*w\ndi/dt = g*u - r*i - e*w\n"
    )
    names = ["th [rad]", "w [rad/s]", "i [A]"]
    return Bench(time, channels_of(rng, names, x, 0.3), {"u [V]": volts}, model)


@bench("coupled", lacks=("q:delay", "q:lag", "q:extra-state"), also=("al:delay", "al:lag"))
def plane_with_a_slow_rudder(rng):
    """Short period of an aeroplane; its elevator follows the command in 0.15 s."""
    time = np.arange(2400) * 0.02
    command = steps(rng, 2400, -0.1, 0.1, 20, 100)

    def rates(t, x, u):
        return np.array([
            -1.2 * x[0] + x[1] - 0.15 * x[2], -6 * x[0] - 1.5 * x[1] - 9 * x[2],
            (u - x[2]) / 0.15,
        ])

    x = simulate(rates, [0, 0, 0], time, command, 4)
    model = (
        "time s\ninput de [rad] hold zero\nparam a = 1\nparam b = 0.1\nparam c = 5\n"
        "param d = 1.8\nparam e = 8\n"
        "dal/dt = -a*al + q - b*de\ndq/dt = -c*al - d*q - e*de\n"
    )
    return Bench(time, channels_of(rng, ["al [rad]", "q [rad/s]"], x[:, :2], 0.5),
                 {"de [rad]": command}, model)


@bench("coupled")
def converter_complete(rng):
    """Current and voltage of a step-up converter, coarsely read: nothing is missing."""
    time = np.arange(4000) * 1e-4
    duty, source = steps(rng, 4000, 0.2, 0.6, 60, 300), steps(rng, 4000, 10, 14, 200, 700)

    def rates(t, x, u):
        return np.array([
            400 * (u[1] - (1 - u[0]) * x[1] - 0.3 * x[0]),
            2500 * ((1 - u[0]) * x[0] - x[1] / 12),
        ])

    x = simulate(rates, [2, 20], time, np.column_stack([duty, source]), 4)
    model = (
        "time s\ninput d hold zero\ninput Vs [V] hold zero\nparam a = 360\nparam r = 90\n"
        "param b = 2700\nparam g = 240\n"
        "di/dt = a*Vs - a*(1-d)*v - r*i\ndv/dt = b*(1-d)*i - g*v\n"
    )
    measured = {"i [A]": on_lattice(noisy(rng, x[:, 0], 0.4), 0.05),
                "v [V]": on_lattice(noisy(rng, x[:, 1], 0.2), 0.1)}
    return Bench(time, measured, {"d": duty, "Vs [V]": source}, model)


@bench("coupled", lacks=("T:linear-term", "T:constant-offset"))
def tank_that_cools(rng):
    """Level and temperature of a mixed tank; the model forgets what its wall loses."""
    time = np.arange(2400) * 2.0
    hot, cold = steps(rng, 2400, 0, 2, 20, 120), steps(rng, 2400, 0, 2, 20, 120)

    def rates(t, x, u):
        inflow = u[0] * (60 - x[1]) + u[1] * (15 - x[1])
        return np.array([
            0.01 * (u[0] + u[1]) - 0.02 * np.sqrt(x[0]),
            0.01 * inflow / x[0] - 3e-3 * (x[1] - 20) / x[0],
        ])

    x = simulate(rates, [1, 30], time, np.column_stack([hot, cold]), 2)
    model = (
        "time s\ninput qh hold zero\ninput qc hold zero\nparam a = 9e-3\nparam k = 0.018\n"
        "dh/dt = a*(qh + qc) - k*sqrt(h)\n"
        "dT/dt = a*(qh*(60-T) + qc*(15-T))/h\n"
    )
    return Bench(time, channels_of(rng, ["h [m]", "T [degC]"], x, 0.4), {"qh": hot, "qc": cold},
                 model)


@bench("coupled", lacks=("w:saturation", "w:cubic-term"))
def motor_with_iron(rng):
    """Torque of the current saturates: 0.6 tanh(i/0.6) in the place of i."""
    time = np.arange(3000) * 2e-3
    volts = steps(rng, 3000, -12, 12, 30, 200)

    def rates(t, x, u):
        return np.array([40 * u - 250 * x[0] - 3 * x[1],
                         120 * 0.6 * np.tanh(x[0] / 0.6) - 2 * x[1]])

    x = simulate(rates, [0, 0], time, volts, 6)
    model = (
        "time s\ninput u [V] hold zero\nparam a = 36\nparam r = 220\nparam e = 2.5\n"
        "param k = 80\nparam b = 2.5\ndi/dt = a*u - r*i - e*w\ndw/dt = k*i - b*w\n"
    )
    return Bench(time, channels_of(rng, ["i [A]", "w [rad/s]"], x, 0.4), {"u [V]": volts}, model)


@bench("coupled", lacks=("v2:coulomb-friction",))
def masses_with_a_brake(rng):
    """Two masses in which positions and speeds are measured; a brake rubs on the second."""
    time = np.arange(2500) * 0.02
    force = steps(rng, 2500, -6, 6, 20, 120)

    def rates(t, x, u):
        spring = 30 * (x[0] - x[2]) + 0.3 * (x[1] - x[3])
        return np.array([
            x[1], u - 20 * x[0] - 0.4 * x[1] - spring,
            x[3], 0.5 * spring - 8 * x[2] - 0.2 * x[3] - 0.8 * switch(x[3], 0.005),
        ])

    x = simulate(rates, [0, 0, 0, 0], time, force, 10)
    model = (
        "time s\ninput F [N] hold zero\nparam k1 = 18\nparam c1 = 0.5\nparam k = 27\n"
        "param c = 0.25\nparam m = 0.45\nparam k2 = 9\nparam c2 = 0.3\n"
        "dx1/dt = v1\ndv1/dt = F - k1*x1 - c1*v1 - k*(x1-x2) - c*(v1-v2)\n"
        "dx2/dt = v2\ndv2/dt = m*k*(x1-x2) + m*c*(v1-v2) - k2*x2 - c2*v2\n"
    )
    names = ["x1 [m]", "v1 [m/s]", "x2 [m]", "v2 [m/s]"]
    return Bench(time, channels_of(rng, names, x, 0.3), {"F [N]": force}, model)
