"""H-14, the fail-safe rule of spec/hardened/H-14.md: what the CAV can always do, going on for tau at
most and then braking to a stop along its path, and whom it meets then.

Which points of the trajectory are ahead, how many places a piece has and where the path ends has no
cautious side: the path is made of fractions. Positions are relative to the CAV's reference point.
"""
import itertools
import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from beside import Beside
from detection_history import S
from geometry import EPS, edges, from_centre, reach, segment_distance
from stopping import Stop, a_tyre, cross, displacement, dot


@dataclass
class Place:
    x: Fraction
    y: Fraction
    progress: Fraction
    length: Fraction
    heading: dict

    @cached_property
    def pose(self):
        return {"x": float(self.x), "y": float(self.y),
                "cos": self.heading["cos"], "sin": self.heading["sin"]}


def ahead(x, y, heading):
    return x * Fraction(heading["cos"]) + y * Fraction(heading["sin"])


def parted(cycle):
    """The points of the trajectory that are no nodes of the path, and those that are."""
    ego, points = cycle["ego"], cycle["trajectory"]["points"]
    passed = list(itertools.takewhile(
        lambda point: ahead(*displacement(ego, point), ego) <= Fraction(1, 8), points))
    return passed, points[len(passed):]


def circle(cycle, f):
    """The radius of the smallest one that the CAV can drive up to f when it brakes."""
    v = cycle["ego"]["speed"]
    return max(3.0, max(v - cycle["parameters"]["a_b"] * f / v, v / 2)**2 / 11.5) if v > 0 else 3.0


def at(ego, point):
    """How far ahead a point is, and how far to the left."""
    x, y = displacement(ego, point)
    return ahead(x, y, ego), ahead(y, -x, ego)


def passing_distance(cycle):
    """How far beside the CAV the trajectory passes it. In fractions, as which points are ahead has no
    cautious side."""
    ego, (passed, nodes) = cycle["ego"], parted(cycle)
    if not (passed and nodes) or at(ego, passed[-1])[0] > 0:
        return Fraction(0)
    (f_y, a_y), (f_z, a_z) = at(ego, passed[-1]), at(ego, nodes[0])
    return abs(a_y * f_z - a_z * f_y) / (f_z - f_y)


def excess(cycle, x, y, heading=None):
    """By how much a place, from p on, is farther aside than the CAV can drive, or its heading swings
    one of its ends farther aside."""
    ego, away = cycle["ego"], {"cos": float(x), "sin": float(y)}
    f = abs(dot(ego, away))
    r = circle(cycle, f)
    swung = 0.0
    if heading:
        lever = abs(ego["center_offset"]) + ego["length"] / 2
        swung = lever * (abs(cross(ego, heading)) - f / r)
    return max(abs(cross(ego, away)) - f**2 / (2 * r), swung)


def pieces(cycle):
    """Of each piece: from one place to the next (x, y, length), how often, and the headings on the
    piece and at its end. The last one goes straight on without an end (0 times)."""
    ego = cycle["ego"]
    d = min(Fraction(1, 4), Fraction(ego["length"]))
    nodes = [ego, *parted(cycle)[1]]
    for a, b in zip(nodes, nodes[1:]):
        x, y = displacement(a, b)
        n = max(1, math.ceil(abs(x) / d), math.ceil(abs(y) / d))
        length = abs(ahead(x, y, a)) + abs(ahead(y, -x, a))
        yield (x / n, y / n, length / n), n, a, b
    end = nodes[-1]
    yield (d * Fraction(end["cos"]), d * Fraction(end["sin"]), d), 0, end, end


def greatest_length(s_stop):
    """Of the path up to a place that is within reach."""
    return 2 * s_stop + 1


def path(cycle, s_stop):
    """The places, the last one where the progress is s_stop; or the first one that is farther from p than
    a CAV can be, as in a sharp turn, or too far along the path, which is not within reach."""
    ego, farthest = cycle["ego"], s_stop + max(1, Fraction(cycle["parameters"]["lateral_tolerance"]))
    places = [Place(Fraction(0), Fraction(0), Fraction(0), Fraction(0), ego)]
    for step, n, heading, end in pieces(cycle):
        node = places[-1]
        for k in range(1, n + 1) if n else itertools.count(1):
            o, x, y = places[-1], node.x + k * step[0], node.y + k * step[1]
            progress, length = ahead(x, y, ego), node.length + k * step[2]
            if progress > s_stop:
                part = (s_stop - o.progress) / (progress - o.progress)
                x, y = o.x + part * (x - o.x), o.y + part * (y - o.y)
                return [*places, Place(x, y, s_stop, o.length + part * step[2], heading)]
            places.append(Place(x, y, progress, length, end if k == n else heading))
            if length > greatest_length(s_stop) or x**2 + y**2 > farthest**2:
                return places


def from_origin(way):
    """The least distance of a way from p, where places are from p on."""
    return segment_distance(*[{"x": float(x), "y": float(y)} for x, y in [(0, 0), *way]])


def sweeps(sides, dx, dy, ux, uy, r1, r2):
    """Whether two rectangles (the sides of both; from centre to centre dx, dy) share a point when
    the second one is moved along (ux, uy) by some r from r1 to r2."""
    dx, dy, half = dx + (r1 + r2) / 2 * ux, dy + (r1 + r2) / 2 * uy, (r2 - r1) / 2
    most = sum(h for _, _, h in sides) + half
    if math.hypot(dx, dy) > 1.01 * most:
        return False
    sides = [(-uy, ux, 0.0), *sides, (ux, uy, half)]
    return all(abs(dx * nx + dy * ny) <= reach(sides, nx, ny) for nx, ny, _ in sides[:-1])


class Motion:
    """An object, its velocity w (in fractions), and the age of its list. It has that velocity in the mean of the
    time dt before; None where it has it now."""

    def __init__(self, cycle, item, w, stamp_ns, dt_ns=None):
        self.ego, parameters = cycle["ego"], cycle["parameters"]
        self.item = {**item, "x": item["x"] - self.ego["x"], "y": item["y"] - self.ego["y"]}
        self.age_ns, self.a_b = cycle["now_ns"] - stamp_ns, parameters["a_b"]
        self.a_tyre = a_tyre(parameters)
        self.age, self.source = self.age_ns / S, item
        self.w, velocity = w, [float(part) for part in w]
        self.speed = math.hypot(*velocity)
        self.u = [part / self.speed if self.speed else 0.0 for part in velocity]
        self.least = max(self.speed - self.a_tyre * (dt_ns or 0) / S / 2, 0.0)
        can_stop = parameters["t_yield"] + self.speed / (2 * parameters["a_yield"])
        self.yielded = parameters["tau"] + can_stop
        self.now = {"x": 0.0, "y": 0.0, "cos": self.ego["cos"], "sin": self.ego["sin"]}

    def braked(self, t):
        """How far the object goes in a time when it brakes as hard as tyres hold."""
        t = min(t, self.least / self.a_tyre)
        return self.least * t - self.a_tyre * t * t / 2

    def meets(self, cav, pose, t1, t2):
        """Whether it sweeps over the CAV, of some length and width, at a place from t1 to t2."""
        return sweeps(edges(pose, cav, EPS, self.item), *self.from_cav(pose), *self.u,
                      self.braked(self.age + t1), self.speed * (self.age + t2))

    def is_on(self, cav, pose):
        """Whether it is on the CAV, of some length and width, at a place, where it is now."""
        moved = self.speed * self.age
        return sweeps(edges(pose, cav, EPS, self.item), *self.from_cav(pose), *self.u, moved, moved)

    def from_cav(self, pose):
        return from_centre(pose, self.ego["center_offset"], self.item, 0.0, 0.0)

    @cached_property
    def comes_across(self):
        """Whether it comes across the inner rectangle of the CAV where that is now."""
        b = 0.0 if self.is_behind else min(0.3, self.ego["speed"]**2 / (2 * self.a_b))
        inner = {"length": self.ego["length"] - 0.3 - b, "width": self.ego["width"] - 2 * b}
        if not self.speed or min(inner.values()) / 2 < EPS:
            return False
        sides = edges(self.now, inner, -EPS, self.item)
        dx, dy = self.from_cav(self.now)
        dx, dy = dx + (0.3 - b) / 2 * self.now["cos"], dy + (0.3 - b) / 2 * self.now["sin"]
        # Farther than this it is past the CAV.
        far = self.speed * self.age + math.hypot(dx, dy) + 2 * sum(h for _, _, h in sides)
        return sweeps(sides, dx, dy, *self.u, self.speed * self.age, far)

    @property
    def centre(self):
        """Where it is now, in fractions."""
        age = Fraction(self.age_ns, S)
        return [at + w * age for at, w in zip(displacement(self.ego, self.source), self.w)]

    @cached_property
    def is_behind(self):
        """Whether it goes the CAV's way, and all of it is behind the CAV's rear now."""
        (dx, dy), c, s = self.from_cav(self.now), self.ego["cos"], self.ego["sin"]
        along = float(self.w[0]) * c + float(self.w[1]) * s
        rear = dx * c + dy * s + along * self.age
        half = reach(edges(self.now, self.ego, 0.0, self.item)[2:], c, s)
        return along > EPS and rear + half < -self.ego["length"] / 2 - EPS

    @cached_property
    def across(self):
        """How fast it goes across the CAV's heading, to either side."""
        return abs(float(self.w[0]) * self.ego["sin"] - float(self.w[1]) * self.ego["cos"])

    @property
    def goes_along(self):
        """Whether it goes the CAV's way or the opposite way, as far as a bend allows."""
        away = math.hypot(*map(float, self.centre))
        return self.across <= self.speed * (0.05 + away / 30) - EPS

    @property
    def follows(self):
        """Who follows keeps its own distance."""
        along = float(self.w[0]) * self.ego["cos"] + float(self.w[1]) * self.ego["sin"]
        return (self.is_behind and self.comes_across
                and self.goes_along and self.across <= along - EPS)


class FailSafe:
    """The rule, for a cycle with a trajectory."""

    def __init__(self, cycle):
        self.cycle, self.ego, self.stop = cycle, cycle["ego"], Stop(cycle)

    @cached_property
    def places(self):
        return path(self.cycle, self.stop.s_stop)

    def from_line(self, x, y):
        """How far a place is ahead on the line along the CAV's heading, and how far it is from that line."""
        return max(ahead(x, y, self.ego), 0), abs(float(x) * self.ego["sin"] - float(y) * self.ego["cos"])

    @cached_property
    def excess(self):
        """The greatest of the points that are no nodes and of all places except p."""
        found = [excess(self.cycle, *displacement(self.ego, point)) for point in parted(self.cycle)[0]]
        found += [excess(self.cycle, place.x, place.y, place.heading) for place in self.places[1:]]
        return max(found, default=0.0)

    def goes_back(self):
        """Whether a point that is no node is behind one before it."""
        passed = [at(self.ego, point)[0] for point in parted(self.cycle)[0]]
        back = [before - x for before, x in zip(itertools.accumulate(passed, max), passed)]
        return max(back, default=0) > 0.125 - EPS

    def comes_back(self):
        """Whether the path leads back to where the CAV may be: behind an earlier node, or after it was far away."""
        near = self.stop.s_stop
        far = near + max(1, Fraction(self.cycle["parameters"]["lateral_tolerance"]))
        nodes = [displacement(self.ego, node) for node in [self.ego, *parted(self.cycle)[1]]]
        greatest, was_far = 0, False
        for a, b in zip(nodes, nodes[1:]):
            greatest = max(greatest, ahead(*a, self.ego))
            was_far = was_far or math.hypot(*a) > far - EPS
            way, part = [a, b], self.behind(a, b, greatest - Fraction(1, 8) + Fraction(EPS))
            if was_far and from_origin(way) < near + EPS or part and from_origin(part) < far + EPS:
                return True
        return False

    def behind(self, a, b, limit):
        """The part of the way from a to b whose progress is below the limit."""
        f, g = ahead(*a, self.ego), ahead(*b, self.ego)
        if (f < limit) == (g < limit):
            return [a, b] if f < limit else None
        edge = [x + (limit - f) / (g - f) * (to - x) for x, to in zip(a, b)]
        return [a, edge] if f < limit else [edge, b]

    def within_reach(self):
        """The CAV can drive the path, and what comes before it, up to lateral_tolerance; the path goes on,
        neither aside nor back for long; and the headings of the places go with it."""
        if self.goes_back() or self.comes_back():
            return False
        if self.excess > self.cycle["parameters"]["lateral_tolerance"] - EPS:
            return False
        if self.places[-1].length > greatest_length(self.stop.s_stop) - EPS:
            return False
        for place in self.places[1:]:
            f, far = self.from_line(place.x, place.y)
            f, turned = float(f), abs(cross(self.ego, place.heading))
            if dot(self.ego, place.heading) <= EPS or f * turned > 0.17 * f + 2 * far + 0.5 - EPS:
                return False
        return True

    def windows(self):
        """Of each place its pose and its window; no end where the CAV may stand."""
        befores, afters = [None, *self.places], [*self.places[1:], None]
        for before, place, after in zip(befores, self.places, afters):
            least = min(it.progress for it in (before, place, after) if it is not None)
            begins = self.stop.first(max(least, 0))
            moves_on = after is not None and after.length < self.stop.s_tyre
            yield place.pose, begins, self.stop.last(after.length) if moves_on else None

    @cached_property
    def a(self):
        """By how much half the CAV's width is greater: the trajectory may join the CAV anywhere."""
        return max(float(passing_distance(self.cycle)), self.excess)

    def motions(self, seen, tracks):
        for track in tracks:
            w = Fraction(track["vx"]), Fraction(track["vy"])
            yield Motion(self.cycle, track, w, self.cycle["tracks"]["stamp_ns"])
        for detection, item, age_ns in seen.motions():
            w = [part * S / age_ns for part in displacement(item, detection)]
            yield Motion(self.cycle, detection, w, self.cycle["detections"]["stamp_ns"], age_ns)

    def meets_nobody(self, seen, tracks):
        """Whether no object that is seen, or a current track, may meet the CAV before it stands,
        nor later when it cannot stop for it. No work is too much here (MARGIN-09 is the strict model's)."""
        cav = {**self.ego, "width": self.ego["width"] + 2 * self.a}
        beside = Beside(self.cycle, self.places, self.a, self.stop.T)
        windows = list(self.windows())
        for motion in self.motions(seen, tracks):
            latest = self.stop.T if motion.comes_across else max(self.stop.T, motion.yielded)
            if (any(motion.meets(cav, pose, begins, latest if ends is None else ends)
                    for pose, begins, ends in windows)
                    and not motion.follows and not beside.keeps_beside(motion)):
                return False
        return True
