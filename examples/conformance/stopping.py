"""H-04: how far the CAV needs to stop, the way to a point, and the places that are examined."""
import math

from geometry import EPS, distance


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


def ways(points):
    """The way to each point: the steps up to it, along the heading where each begins."""
    way = [0.0]
    for a, b in zip(points, points[1:]):
        way.append(way[-1] + max(between(a, b, a)[0], 0.0))
    return way


def s_stop(cycle):
    """Reaction, then braking, from where the CAV is; counted from the first point."""
    ego, first, parameters = cycle["ego"], cycle["trajectory"]["points"][0], cycle["parameters"]
    v, tau, a_max = ego["speed"], parameters["tau"], parameters["a_max"]
    ahead = between(first, ego, first)[0] > -EPS
    e = distance(ego, first) if ahead else 0.0
    return (e + v * tau + a_max * tau * tau / 2
            + (v + a_max * tau)**2 / (2 * parameters["a_b"]))


def places(cycle, horizon, beyond=None):
    """The places up to a horizon, and the first one beyond s_stop (or beyond another way): each a
    point and a center_offset. A trajectory that ends before s_stop is examined beyond its end, as
    if the CAV went straight on."""
    points = cycle["trajectory"]["points"]
    offset, stop, way = cycle["ego"]["center_offset"], s_stop(cycle), ways(points)
    beyond = stop if beyond is None else beyond
    for point, here, before in zip(points, way, [0.0, *way]):
        is_next = before <= (1 + 1e-6) * beyond + EPS
        if here > (1 + 1e-6) * horizon + EPS and not is_next:
            return
        yield point, offset
    if way[-1] < stop + EPS:
        step = min(0.25, cycle["ego"]["length"])
        k = math.floor(offset / step) + 1
        while k * step < offset + stop - way[-1] + EPS:
            yield points[-1], k * step
            k += 1
        yield points[-1], k * step
