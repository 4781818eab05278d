"""How far the CAV needs to stop, and when it is where: spec/hardened/H-14.md#requirements-windows.

Times change without bound with the distance where the CAV comes to stand. So distances are
fractions, and only the square root is rounded.
"""
import math
from fractions import Fraction


def dot(a, b):
    """Of two headings."""
    return a["cos"] * b["cos"] + a["sin"] * b["sin"]


def cross(a, b):
    return a["cos"] * b["sin"] - a["sin"] * b["cos"]


def between(a, b, heading):
    """The displacement from a to b, along a heading and across it (to the left)."""
    x, y = b["x"] - a["x"], b["y"] - a["y"]
    c, s = heading["cos"], heading["sin"]
    return x * c + y * s, y * c - x * s


def displacement(a, b):
    """From a to b, in fractions."""
    return Fraction(b["x"]) - Fraction(a["x"]), Fraction(b["y"]) - Fraction(a["y"])


def a_tyre(parameters):
    """What tyres hold: no vehicle brakes harder."""
    return max(parameters["a_b"], 11.5)


def still_braking(a, rest):
    """How long what brakes with a still moves when it has so far to go."""
    return math.sqrt(2 * max(rest, 0) / a)


class Stop:
    """Going on for tau at most, speeding up with a_max, then braking with a_b, or harder."""

    def __init__(self, cycle):
        parameters = cycle["parameters"]
        tau, self.a_max, self.a_b = (Fraction(parameters[key]) for key in ("tau", "a_max", "a_b"))
        self.v = v = Fraction(cycle["ego"]["speed"])
        v_tau = v + self.a_max * tau
        self.s_tau = v * tau + self.a_max * tau**2 / 2
        self.s_stop = self.s_tau + v_tau**2 / (2 * self.a_b)
        self.a_tyre = Fraction(a_tyre(parameters))
        self.s_tyre = v**2 / (2 * self.a_tyre)
        self.T = float(tau + v_tau / self.a_b)

    def first(self, f):
        """The earliest time at which it can have driven f."""
        if f > self.s_tau:
            return self.T - still_braking(self.a_b, self.s_stop - f)
        return (math.sqrt(self.v**2 + 2 * self.a_max * f) - float(self.v)) / float(self.a_max)

    def last(self, f):
        """The latest time at which it has driven no more than f, below s_tyre."""
        return float(self.v / self.a_tyre) - still_braking(self.a_tyre, self.s_tyre - f)
