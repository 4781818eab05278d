"""Who keeps beside the path of H-14, measured along the route: spec/hardened/H-14.md#requirements-not-examined.

In plain doubles, from the CAV on: these are within what MARGIN-18 leaves a program.
"""
import math
from functools import cached_property

from geometry import EPS
from paper import segments
from stopping import cross, displacement

ERROR, NEAREST, ALIKE = 1e-5, 0.09, 1e-6
NEARER = 0.125 - 4 * ERROR


class Beside:
    """The places, and a, by which the CAV's half width is greater; T, when the CAV stands."""

    def __init__(self, cycle, places, a, T):
        self.ego, self.route, self.places, self.a, self.T = (
            cycle["ego"], cycle["route"], places, a, T)

    @cached_property
    def lines(self):
        """The segments of the reference path, from the CAV on."""
        at = [displacement(self.ego, it) for it in self.route["stations"]]
        rounded = lambda point: tuple(map(float, point))
        return [(rounded(a), rounded(b))
                for a, b in segments({**self.route, "stations": at}) if a != b]

    @cached_property
    def route_bends(self):
        """Whether the route bends, but does not turn off or change lanes near the CAV, for who goes
        its way and for who comes towards it."""
        turns, c, s = [], self.ego["cos"], self.ego["sin"]
        for a, b in self.lines:
            gx, gy = b[0] - a[0], b[1] - a[1]
            away = math.hypot(*from_nearest((0, 0), a, b))
            turns.append((abs(c * gy - s * gx) + EPS, math.hypot(gx, gy), away))
        return {towards: all(across <= length * (0.05 + away / radius - ERROR)
                             for across, length, away in turns)
                for towards, radius in ((True, 30), (False, 300))}

    def nearest(self, at):
        """The distance to the reference path, and the segments that may be so near."""
        gaps = [math.hypot(*from_nearest(at, *line)) for line in self.lines]
        least = min(gaps)
        return least, [line for line, gap in zip(self.lines, gaps) if gap <= least + ALIKE]

    def is_along_the_route(self, x, y):
        """Whether it does not lie beyond an end."""
        if self.route["closed"]:
            return True
        (start, second), (last_but_one, end) = self.lines[0], self.lines[-1]
        return all((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1])
                   > ERROR * math.dist(a, b) + EPS
                   for a, b in ((start, second), (end, last_but_one)))

    @cached_property
    def sides(self):
        """A_0, [C_0 to the left, to the right], and A, B, [C to the left, to the right]; A is -inf and B inf
        where the CAV's path may leave the route."""
        covered, of_p = [], None
        for place in self.places:
            turned = abs(cross(self.ego, place.heading))
            x, y = (float(at) + self.ego["center_offset"] * place.heading[key]
                    for at, key in ((place.x, "cos"), (place.y, "sin")))
            if turned > 0.05 + float(place.progress) / 30 - ERROR or not self.is_along_the_route(x, y):
                return (0, [0, 0]), (-math.inf, math.inf, [0, 0])
            D, lines = self.nearest((x, y))
            here = [(D, left * D, self.extent(place.heading, *line))
                    for line in lines for left in self.signs((x, y), *line)]
            of_p = of_p or (max(D - E for D, _, E in here),
                            [min(s * left + E for _, left, E in here) for s in (1, -1)])
            covered += here
        return of_p, (min(D - E for D, _, E in covered), max(D + E for D, _, E in covered),
                      [max(s * left + E for _, left, E in covered) for s in (1, -1)])

    def signs(self, at, a, b):
        """1 on the left of a segment, -1 on its right, both where neither is certain."""
        across = (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0])
        return [1, -1] if abs(across) <= ERROR * math.dist(a, b) + EPS else [math.copysign(1, across)]

    def comes_no_nearer(self, at, line, D):
        """Whether the CAV comes no nearer than at p to who keeps to its lane there."""
        (A0, C0), (A, B, C) = self.sides
        if A - D >= D - B:
            return A > A0 - NEARER
        sign, *other = self.signs(at, *line)
        side = 0 if sign > 0 else 1
        return not other and C[side] < C0[side] + NEARER

    def extent(self, heading, a, b):
        """E_k: half of what the CAV's rectangle takes across a segment, and a."""
        x, y = b[0] - a[0], b[1] - a[1]
        along = abs(heading["cos"] * x + heading["sin"] * y)
        across = abs(heading["cos"] * y - heading["sin"] * x)
        return ((along * self.ego["width"] + across * self.ego["length"]) / (2 * math.hypot(x, y))
                + self.a)

    def keeps_beside(self, motion):
        """Whether nothing of an object comes to where the path leads."""
        if not any(motion.w) or not motion.goes_along:
            return False
        wx, wy = (float(it) for it in motion.w)
        ahead = wx * self.ego["cos"] + wy * self.ego["sin"]
        aside = abs(wx * self.ego["sin"] - wy * self.ego["cos"])
        if not self.route_bends[aside <= -ahead - EPS]:
            return False
        at = [float(it) for it in motion.centre]
        if not self.is_along_the_route(*at):
            return False
        D, lines = self.nearest(at)
        if D < NEAREST or D > 20 - ERROR or self.lies_across(motion):
            return False
        _, (A, B, _) = self.sides
        sides = (max(it["length"], it["width"]) for it in (motion.item, self.ego))
        sagitta = sum(side**2 for side in sides) / (6 * (300 if ahead > EPS else 30))
        room = max(A - D, D - B) - ERROR - sagitta
        return all(self.needed(motion, *from_nearest(at, *line),
                               motion.is_behind and self.comes_no_nearer(at, line, D)) < room
                   for line in lines)

    def lies_across(self, motion):
        """Whether it lies where the path leads, though its centre may be beside it."""
        cav = {**self.ego, "width": self.ego["width"] + 2 * self.a}
        return any(motion.is_on(cav, place.pose) for place in self.places)

    def needed(self, motion, x, y, keeps_lane):
        """The room that it needs along q, which is known to 4e-7 of its length."""
        item, D = motion.item, math.hypot(x, y)
        c, s, w = item["cos"], item["sin"], motion.speed
        half = (abs(c * x + s * y) * item["length"] + abs(c * y - s * x) * item["width"]) / 2 + 4e-5 * D
        drift = abs(float(motion.w[0]) * x + float(motion.w[1]) * y) / D
        if keeps_lane and drift < w * (0.1 - ERROR):
            return half / D
        return half / D + (drift + 4e-7 * w) * max(self.T, motion.yielded)


def from_nearest(c, a, b):
    """From the nearest point of a segment to c."""
    x, y, gx, gy = c[0] - a[0], c[1] - a[1], b[0] - a[0], b[1] - a[1]
    square = gx * gx + gy * gy
    part = min(max((x * gx + y * gy) / square, 0.0), 1.0) if square else 0.0
    return x - part * gx, y - part * gy
