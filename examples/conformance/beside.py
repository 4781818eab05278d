"""Who keeps beside the path of H-14, measured along the route: spec/hardened/H-14.md#requirements-failure.

What lies beyond an end of the route, and where the nearest point of the reference path is, is
decided in fractions: an object may be as near to that path as rounding is fine.
"""
import math
from fractions import Fraction
from functools import cached_property

from geometry import EPS, segment_distance
from paper import segments
from stopping import cross, displacement


def rounded(x, y):
    return {"x": float(x), "y": float(y)}


class Beside:
    """The places, and a, by which the CAV's half width is greater; T, when the CAV stands."""

    def __init__(self, cycle, places, a, T):
        self.ego, self.route, self.places, self.a, self.T = (
            cycle["ego"], cycle["route"], places, a, T)

    @cached_property
    def lines(self):
        """The segments of the reference path: from where to where, in doubles and in fractions."""
        at = [displacement(self.ego, station) for station in self.route["stations"]]
        return [(rounded(*a), rounded(*b), a, b)
                for a, b in segments({**self.route, "stations": at}) if a != b]

    @cached_property
    def route_bends(self):
        """Whether the route bends, but does not turn off or change lanes near the CAV, for who goes
        its way and for who comes towards it."""
        turns, c, s = [], Fraction(self.ego["cos"]), Fraction(self.ego["sin"])
        for _, _, a, b in self.lines:
            gx, gy = b[0] - a[0], b[1] - a[1]
            away = math.hypot(*rounded(*from_nearest((0, 0), a, b)).values())
            turns.append((abs(float(c * gy - s * gx)), math.hypot(gx, gy), away))
        return {towards: all(across <= length * (0.05 + away / radius) - EPS
                             for across, length, away in turns)
                for towards, radius in ((True, 30), (False, 300))}

    def nearest(self, at, lines):
        """The distance to the reference path, and the segments that are so near."""
        gaps = [segment_distance(at, a, b) for a, b, _, _ in lines]
        least = min(gaps)
        return least, [line for line, gap in zip(lines, gaps) if gap <= least + EPS]

    def is_along_the_route(self, x, y):
        """Whether it does not lie beyond an end."""
        if self.route["closed"]:
            return True
        (_, _, start, second), (_, _, last_but_one, end) = self.lines[0], self.lines[-1]
        return all((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1]) > 0
                   for a, b in ((start, second), (end, last_but_one)))

    @cached_property
    def centres(self):
        """Those of the CAV's rectangle at the places."""
        offset = Fraction(self.ego["center_offset"])
        return [(place.x + offset * Fraction(place.heading["cos"]),
                 place.y + offset * Fraction(place.heading["sin"])) for place in self.places]

    @cached_property
    def leads_along_the_route(self):
        """Whether the path bends as the route does, and has no place beyond an end."""
        bends = all(
            abs(cross(self.ego, place.heading)) <= 0.05 + float(place.progress) / 30 - EPS
            for place in self.places)
        return bends and all(self.is_along_the_route(*centre) for centre in self.centres)

    @cached_property
    def offsets(self):
        """Of each place D_k and E_k: how far it is from the reference path, and how wide there."""
        centres = [rounded(*centre) for centre in self.centres]
        gaps = [segment_distance(centres[0], a, b) for a, b, _, _ in self.lines]
        far = min(gaps) + 1 + 2 * max(
            math.hypot(at["x"] - centres[0]["x"], at["y"] - centres[0]["y"]) for at in centres)
        near = [line for line, gap in zip(self.lines, gaps) if gap <= far]
        known = [self.nearest(at, near) for at in centres]
        return [(offset, max(self.extent(place.heading, a, b) for a, b, _, _ in lines))
                for place, (offset, lines) in zip(self.places, known)]

    def extent(self, heading, a, b):
        """E_k: half of what the CAV's rectangle takes across a segment, and a."""
        x, y = b["x"] - a["x"], b["y"] - a["y"]
        along = abs(heading["cos"] * x + heading["sin"] * y)
        across = abs(heading["cos"] * y - heading["sin"] * x)
        return ((along * self.ego["width"] + across * self.ego["length"]) / (2 * math.hypot(x, y))
                + self.a)

    def keeps_beside(self, motion):
        """Whether nothing of an object comes to where the path leads."""
        if not any(motion.w) or not motion.goes_along or not self.leads_along_the_route:
            return False
        wx, wy = (float(it) for it in motion.w)
        ahead = wx * self.ego["cos"] + wy * self.ego["sin"]
        aside = abs(wx * self.ego["sin"] - wy * self.ego["cos"])
        if not self.route_bends[aside <= -ahead - EPS]:
            return False
        if not self.is_along_the_route(*motion.centre):
            return False
        D, lines = self.nearest(rounded(*motion.centre), self.lines)
        if D > 20 - EPS or self.lies_across(motion):
            return False
        return all(self.is_free(motion, *from_nearest(motion.centre, a, b)) for _, _, a, b in lines)

    def lies_across(self, motion):
        """Whether it lies where the path leads, though its centre may be beside it."""
        cav = {**self.ego, "width": self.ego["width"] + 2 * self.a}
        return any(motion.is_on(cav, place.pose) for place in self.places)

    def is_free(self, motion, qx, qy):
        x, y, item = float(qx), float(qy), motion.item
        D, c, s = math.hypot(x, y), item["cos"], item["sin"]
        half = (abs(c * x + s * y) * item["length"] + abs(c * y - s * x) * item["width"]) / 2
        drift = abs(float(motion.w[0]) * x + float(motion.w[1]) * y)
        keeps_its_lane = motion.is_behind and drift <= motion.speed * D / 10 - EPS
        t = 0.0 if keeps_its_lane else max(self.T, motion.yielded)
        return D > 0 and all((abs(D - offset) - extent - EPS) * D > half + drift * t
                             for offset, extent in self.offsets)


def from_nearest(c, a, b):
    """From the nearest point of a segment to c."""
    x, y, gx, gy = c[0] - a[0], c[1] - a[1], b[0] - a[0], b[1] - a[1]
    part = min(max((x * gx + y * gy) / (gx * gx + gy * gy), 0), 1)
    return x - part * gx, y - part * gy
