# SPDX-License-Identifier: MIT
"""Benches on which something changes while the record goes on.

Written down before any of them was diagnosed. The record is cut at 60 %: in the second part the
change goes on, is over, or never comes again.
"""

import numpy as np

from benches import Bench, bench, noisy, simulate, steps

MOTOR = "time s\ninput u [V] hold zero\nparam a = 7\nparam b = 2.4\ndw/dt = a*u - b*w\n"
OVEN = "time s\ninput P [W] hold zero\nparam a = 0.018\nparam b = 5e-3\ndT/dt = a*P - b*(T-20)\n"
CUT = 0.6


@bench("passing", lacks=("T:parameter-drift",))
def oven_dries(rng):
    """Wet lining loses its water: the loss falls in a straight line, and stays where it is."""
    time = np.arange(2400) * 5.0
    power = steps(rng, 2400, 0, 100, 60, 240)
    end = CUT * time[-1]

    def rates(t, x, u):
        return 0.02 * u - (6e-3 - 2.5e-3 * min(t / end, 1)) * (x - 20)

    x = simulate(rates, [30], time, power, 4)[:, 0]
    return Bench(time, {"T [degC]": noisy(rng, x, 0.3)}, {"P [W]": power}, OVEN)


@bench("passing", lacks=("T:change",))
def oven_door(rng):
    """The door stood open for a fifth of the first part."""
    time = np.arange(2400) * 5.0
    power = steps(rng, 2400, 0, 100, 60, 240)
    begin, end = (fraction * CUT * time[-1] for fraction in (0.45, 0.65))

    def rates(t, x, u):
        return 0.02 * u - (1.5e-2 if begin < t < end else 6e-3) * (x - 20)

    x = simulate(rates, [30], time, power, 4)[:, 0]
    return Bench(time, {"T [degC]": noisy(rng, x, 0.3)}, {"P [W]": power}, OVEN)


@bench("passing", lacks=("w:change",))
def motor_belt_changed(rng):
    """At two thirds of the first part another belt was put on: gain and friction jump."""
    time = np.arange(3000) * 0.01
    volts = steps(rng, 3000, -6, 6, 20, 120)
    change = 2 / 3 * CUT * time[-1]

    def rates(t, x, u):
        return (8 * u - 2 * x) if t < change else (6 * u - 3.2 * x)

    x = simulate(rates, [0], time, volts)[:, 0]
    return Bench(time, {"w [rad/s]": noisy(rng, x, 0.5)}, {"u [V]": volts}, MOTOR)


@bench("passing", lacks=("w:periodic-forcing",))
def motor_beside_a_pump(rng):
    """A pump on the same bench shakes, and is switched off for the second part."""
    time = np.arange(3000) * 0.01
    volts = steps(rng, 3000, -6, 6, 20, 120)
    end = CUT * time[-1]

    def rates(t, x, u):
        return 8 * u - 2 * x + (6 * np.sin(19 * t + 1) if t < end else 0)

    x = simulate(rates, [0], time, volts)[:, 0]
    return Bench(time, {"w [rad/s]": noisy(rng, x, 0.5)}, {"u [V]": volts}, MOTOR)


@bench("passing", lacks=("v:quadratic-drag",), also=("v:parameter-drift", "v:time-trend"))
def boat_takes_in_water(rng):
    """Drag of the square of the speed, and a thrust that falls as the boat gets heavier."""
    time = np.arange(2400) * 0.25
    thrust = steps(rng, 2400, -2, 2, 20, 80)

    def rates(t, x, u):
        return (u - 0.3 * x * abs(x)) * (1 - 0.25 * t / time[-1])

    x = simulate(rates, [0], time, thrust, 8)[:, 0]
    model = "time s\ninput F [N] hold zero\nparam a = 0.9\nparam b = 0.3\ndv/dt = a*F - b*v\n"
    return Bench(time, {"v [m/s]": noisy(rng, x, 0.4)}, {"F [N]": thrust}, model)


@bench("passing", lacks=("h:periodic-forcing",))
def pond_with_tide(rng):
    """What flows in from the sea swings with the tide, in both parts."""
    time = np.arange(2400) * 0.1
    pump = steps(rng, 2400, 0, 5, 20, 100)

    def rates(t, x, u):
        return 0.2 * u - 0.25 * x + 0.2 * np.sin(2 * np.pi * t / 12.4 + 0.7)

    x = simulate(rates, [2], time, pump, 4)[:, 0]
    model = "time h\ninput q hold zero\nparam a = 0.18\nparam b = 0.3\ndh/dt = a*q - b*h\n"
    return Bench(time, {"h [m]": noisy(rng, x, 0.5)}, {"q": pump}, model)


@bench("passing", lacks=("v:change",))
def cart_on_a_table(rng):
    """The table was levelled twice: a constant force that jumps."""
    time = np.arange(2400) * 0.02
    force = steps(rng, 2400, -3, 3, 20, 100)
    first, second = (fraction * CUT * time[-1] for fraction in (0.3, 0.75))

    def rates(t, x, u):
        tilt = 0.8 if t < first else (-0.5 if t < second else 0.1)
        return u - 0.6 * x + tilt

    x = simulate(rates, [0], time, force)[:, 0]
    model = "time s\ninput F [N] hold zero\nparam a = 0.9\nparam b = 0.7\ndv/dt = a*F - b*v\n"
    return Bench(time, {"v [m/s]": noisy(rng, x, 0.5)}, {"F [N]": force}, model)


@bench("passing", lacks=("w:parameter-drift",))
def fan_on_a_battery(rng):
    """The battery sags while the fan runs, and is full again in the second part."""
    time = np.arange(3000) * 0.02
    duty = steps(rng, 3000, 0, 1, 20, 120)
    end = CUT * time[-1]

    def rates(t, x, u):
        charge = 1 - 0.3 * (t if t < end else t - end) / end
        return 90 * charge * u - 1.5 * x

    x = simulate(rates, [0], time, duty)[:, 0]
    model = "time s\ninput d hold zero\nparam a = 80\nparam b = 1.3\ndw/dt = a*d - b*w\n"
    return Bench(time, {"w [rad/s]": noisy(rng, x, 0.5)}, {"d": duty}, model)
