# SPDX-License-Identifier: MIT
"""Four plants as somebody models them who knows what they are made of.

Each is a model in the quantities of its data sheet; the starts are 30 % off what holds (the pitch
of the magnets is known).
"""

import numpy as np

from expert import Box


def two_heaters(plant):
    """Heat balances: loss to the room, exchange between the plates, heaters, room temperature."""
    c = plant.coefficients
    truth = {"room": c[("T1", "1")] / (-c[("T1", "T1")] - c[("T1", "T2")])}
    for own, other, heater in (("T1", "T2", "Q1"), ("T2", "T1", "Q2")):
        truth["loss " + own] = -c[(own, own)] - c[(own, other)]
        truth["exchange " + own] = c[(own, other)]
        truth["heater " + own] = c[(own, heater)]
    truth |= {"late " + u: late for u, late in plant.delays.items()}

    def rates(p, x, u):
        return tuple(
            p["loss " + own] * (p["room"] - x[k])
            + p["exchange " + own] * (x[1 - k] - x[k])
            + p["heater " + own] * u[k]
            for k, own in enumerate(("T1", "T2"))
        )

    late = tuple("late " + u for u in plant.shape.inputs)
    inputs = [(lambda r, u=u: r.inputs[u], "late " + u) for u in plant.shape.inputs]
    return Box(truth, rates, inputs, ("T1", "T2"), {"T1": 0, "T2": 1}, dead_times=late)


def cart_terms(plant):
    """Damping and gain of a cart, and its dead time."""
    c = plant.coefficients
    truth = {"damping": -c[("x_d1", "x_d1")], "gain": c[("x_d1", "u")]}
    return truth | {"late u": plant.delays["u"]}


def linear_motor(plant):
    """A carriage over magnets whose pitch the data sheet gives: force ripple of sine and cosine."""
    truth = cart_terms(plant) | {
        "sine": plant.ripple[0] * np.cos(plant.ripple[2]),
        "cosine": plant.ripple[0] * np.sin(plant.ripple[2]),
    }
    turn = 2 * np.pi / plant.ripple[1]

    def rates(p, x, u):
        force = p["gain"] * u[0] + p["sine"] * np.sin(turn * x[0])
        force = force + p["cosine"] * np.cos(turn * x[0])
        return (x[1], force - p["damping"] * x[1])

    inputs = [(lambda r: r.inputs["u"], "late u")]
    return Box(truth, rates, inputs, ("x", "x_d1"), {"x": 0}, dead_times=("late u",))


def winch(plant):
    """A drum that pulls more than it gives way: a second gain where the input is positive."""
    truth = cart_terms(plant)
    truth["gain up"] = truth["gain"] * (1 + plant.asymmetry)

    def rates(p, x, u):
        return (x[1], p["gain"] * u[0] + p["gain up"] * u[1] - p["damping"] * x[1])

    inputs = [
        (lambda r: np.minimum(r.inputs["u"], 0.0), "late u"),
        (lambda r: np.maximum(r.inputs["u"], 0.0), "late u"),
    ]
    return Box(truth, rates, inputs, ("x", "x_d1"), {"x": 0}, dead_times=("late u",))


def cart_behind_filter(plant):
    """The filter is a state of its own: the pull m follows gain times input."""
    c = plant.coefficients
    sums, product = -c[("x_d2", "x_d2")], -c[("x_d2", "x_d1")]
    damping = (sums - (sums * sums - 4 * product) ** 0.5) / 2
    truth = {"damping": damping, "filter": 1 / (sums - damping)}
    truth |= {"gain": c[("x_d2", "u")] / (sums - damping), "late u": plant.delays["u"]}

    def rates(p, x, u):
        pull = x[2] + p["damping"] * x[1]  # from the acceleration, the third state
        slope = (p["gain"] * u[0] - pull) / p["filter"]
        return (x[1], x[2], slope - p["damping"] * x[2])

    inputs = [(lambda r: r.inputs["u"], "late u")]
    states = ("x", "x_d1", "x_d2")
    return Box(truth, rates, inputs, states, {"x": 0}, dead_times=("late u",))


GREY_BOXES = {
    make.__name__: make for make in (two_heaters, linear_motor, winch, cart_behind_filter)
}
