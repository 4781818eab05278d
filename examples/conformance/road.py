"""The road at the places of H-14: spec/hardened/H-14.md#requirements-the-road.

A place is made of fractions, and so are the triangles of the corridor here: nothing is rounded that decides. Positions
are relative to the CAV's reference point.
"""
import itertools
from fractions import Fraction

from paper import segments


def on_the_road(cycle, places):
    """Whether each place other than p is in the corridor."""
    road, at = list(triangles(cycle["route"])), 0
    for place in places[1:]:
        # The triangle of the place before comes first: a path goes on where it was.
        numbers = itertools.chain(range(at, len(road)), range(at))
        at = next((k for k in numbers if holds(road[k], cycle["ego"], place)), None)
        if at is None:
            return False
    return True


def triangles(route):
    for a, b in segments(route):
        yield a["left"], a["right"], b["right"]
        yield a["left"], b["right"], b["left"]


def holds(triangle, ego, place):
    """Whether a triangle with an area holds a place, its sides included."""
    # Rounding keeps an order: what is outside the rounded box is outside.
    for axis, key in enumerate("xy"):
        ends = [corner[axis] - ego[key] for corner in triangle]
        if not min(ends) <= place.pose[key] <= max(ends):
            return False
    a, b, c = ([Fraction(corner[0]) - Fraction(ego["x"]), Fraction(corner[1]) - Fraction(ego["y"])]
               for corner in triangle)
    turns = [turn(a, b, place), turn(b, c, place), turn(c, a, place)]
    # Where there is no area the three add up to 0.
    return any(turns) and (min(turns) >= 0 or max(turns) <= 0)


def turn(a, b, place):
    """Twice the area of the triangle from a to b to the place, negative where it turns to the right."""
    return (b[0] - a[0]) * (place.y - a[1]) - (b[1] - a[1]) * (place.x - a[0])
