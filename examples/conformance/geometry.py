"""Geometry and assignment, for both profiles, in plain doubles.

Every comparison that could accept is made cautious by EPS: coordinates reach 2^24 m, where doubles
are 2e-9 m apart, and spec/4-arithmetic.md lets a program reject within delta of a threshold.
"""
import math

EPS = 4e-9  # m; above what rounding did so far, below the smallest margin delta of the text (1e-8)


def distance(a, b):
    return math.hypot(a["x"] - b["x"], a["y"] - b["y"])


def assignment_cost(costs):
    """The least sum of one entry per row, no column twice; infinite when an infinite entry has to
    be taken. Not more rows than columns. (The Hungarian method: u and v are its potentials.)"""
    columns = len(costs[0])
    row_of, u, v = [-1] * (columns + 1), [0.0] * len(costs), [0.0] * (columns + 1)
    for start in range(len(costs)):
        row_of[columns], j = start, columns
        shortest, before, done = [math.inf] * (columns + 1), [columns] * columns, set()
        while row_of[j] >= 0:
            done.add(j)
            i, best, step = row_of[j], -1, math.inf
            for k in range(columns):
                if k not in done:
                    cost = costs[i][k] - u[i] - v[k]
                    if cost < shortest[k]:
                        shortest[k], before[k] = cost, j
                    if shortest[k] < step or best < 0:
                        best, step = k, shortest[k]
            if step == math.inf:
                return math.inf
            for k in range(columns + 1):
                if k in done:
                    u[row_of[k]] += step
                    v[k] -= step
                else:
                    shortest[k] -= step
            j = best
        while j != columns:
            row_of[j], j = row_of[before[j]], before[j]
    return math.fsum(costs[row_of[k]][k] for k in range(columns) if row_of[k] >= 0)


def segment_distance(p, a, b):
    ax, ay, dx, dy = a["x"] - p["x"], a["y"] - p["y"], b["x"] - a["x"], b["y"] - a["y"]
    square = dx * dx + dy * dy
    t = min(max(-(ax * dx + ay * dy) / square, 0.0), 1.0) if square else 0.0
    if 0.0 < t < 1.0:
        return abs(ax * dy - ay * dx) / math.sqrt(square)
    return min(math.hypot(ax, ay), math.hypot(b["x"] - p["x"], b["y"] - p["y"]))


def clip(polygon, a, b):
    """The parts of a convex polygon to the left and to the right of the line from a to b."""
    sides = [(b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) for x, y in polygon]
    parts = [], []
    for i, (p, s) in enumerate(zip(polygon, sides)):
        q, t = polygon[i - 1], sides[i - 1]
        if (s > 0 > t) or (s < 0 < t):
            cut = t / (t - s)
            both = (q[0] + cut * (p[0] - q[0]), q[1] + cut * (p[1] - q[1]))
            parts[0].append(both)
            parts[1].append(both)
        if s >= 0:
            parts[0].append(p)
        if s <= 0:
            parts[1].append(p)
    return parts


def area(polygon):
    return abs(sum(q[0] * p[1] - q[1] * p[0] for p, q in zip(polygon, polygon[-1:] + polygon))) / 2


def in_corridor(p, pairs):
    """Whether the triangles cover a small square around p, so that rounding opens no gap."""
    rest = [[(-EPS, -EPS), (EPS, -EPS), (EPS, EPS), (-EPS, EPS)]]
    for first, second in pairs:
        local = [(q[0] - p["x"], q[1] - p["y"])
                 for q in (first["left"], first["right"], second["right"], second["left"])]
        for corners in ((local[0], local[1], local[2]), (local[0], local[2], local[3])):
            if any(all(sign * corner[axis] > EPS for corner in corners)
                   for axis in (0, 1) for sign in (-1, 1)):
                continue
            (ax, ay), (bx, by), (cx, cy) = corners
            turn = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            if turn == 0:
                continue
            a, b, c = corners if turn > 0 else corners[::-1]
            outside = []
            for piece in rest:
                for start, end in ((a, b), (b, c), (c, a)):
                    piece, beyond = clip(piece, start, end)
                    outside.append(beyond)
            rest = [piece for piece in outside if len(piece) > 2]
    return sum(map(area, rest)) < 0.01 * EPS * EPS


def edges(pose, ego, more, item):
    """The sides of the CAV's rectangle at a pose, longer by more, and of an object: of each pair the
    direction of its normal and half the distance."""
    sides = []
    for turned, box, longer in ((pose, ego, more), (item, item, 0.0)):
        c, s = turned["cos"], turned["sin"]
        sides.append((c, s, box["length"] / 2 + longer))
        sides.append((-s, c, box["width"] / 2 + longer))
    return sides


def from_centre(pose, offset, item, dx, dy):
    """From the CAV's centre at a pose to that of an object that has moved by (dx, dy)."""
    return (dx + (item["x"] - pose["x"]) - offset * pose["cos"],
            dy + (item["y"] - pose["y"]) - offset * pose["sin"])


def reach(sides, ux, uy):
    return sum(h * abs(vx * ux + vy * uy) for vx, vy, h in sides)


def rectangles_meet(ego, pose, offset, item, dx, dy, near):
    """The low-level collision check: the CAV at a pose, its rectangle shifted forward by offset,
    and an object that has moved by (dx, dy), examined when the centres are nearer than near."""
    dx, dy = from_centre(pose, offset, item, dx, dy)
    if not math.hypot(dx, dy) < near + EPS:
        return False
    sides = edges(pose, ego, EPS, item)
    return all(abs(dx * ux + dy * uy) <= reach(sides, ux, uy) for ux, uy, _ in sides)
