#!/usr/bin/env python3
"""A program under test: the paper profile of MUFASA in plain doubles, from the text of spec/ alone.

It answers the records `cycle` (read by record.py), `offloading` (offloading.py) and `composition`
(composition.py) of spec/5-interfaces.md, one line each. It is no part of the project: it shows how little a program
needs to be judged by `mufasa conform`, and with `--bug NAME` that `mufasa conform` finds what it
has to find.

Every comparison that could accept is made cautious by EPS: coordinates reach 2^24 m, where doubles
are 2e-9 m apart, and spec/4-arithmetic.md lets a program reject within delta of a threshold.
"""
import itertools
import json
import math
import sys

import record as records
from composition import answer_composition
from offloading import answer_offloading
from record import Broken, Invalid, check_input, choice, read_cycle

EPS = 4e-9  # m; above what rounding did so far, below the smallest margin delta of the text (1e-8)
BUGS = ("le-for-lt", "no-sqrt", "missing-skip", "wrong-horizon", "off-by-one-lane", "no-hold",
        "nan-accepted")
BUG = None  # the bug that is switched on


# The stages: each says whether it passes.


def distance(a, b):
    return math.hypot(a["x"] - b["x"], a["y"] - b["y"])


def assignment_cost(costs):
    """The least sum of one entry per row, no column twice; not more rows than columns."""
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


def stage_i(cycle):
    tracks, detections = cycle["tracks"]["items"], cycle["detections"]["items"]
    r = max((distance(item, cycle["ego"]) for item in detections), default=0.0)
    inside = [item for item in tracks if distance(item, cycle["ego"]) < r - EPS]
    border = [item for item in tracks if abs(distance(item, cycle["ego"]) - r) <= EPS]
    if len(border) > 6:
        return False
    for count in range(len(border) + 1):
        for some in itertools.combinations(border, count):
            rows, columns = inside + list(some), detections
            if not (k := min(len(rows), len(columns))):
                continue
            if len(rows) > len(columns):
                rows, columns = columns, rows
            mean = assignment_cost([[distance(a, b) for b in columns] for a in rows]) / k
            theta_tr = cycle["parameters"]["theta_tr"]
            if not (mean <= theta_tr if BUG == "le-for-lt" else mean < theta_tr - EPS):
                return False
    return True


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


def stage_ii(cycle):
    stations = cycle["route"]["stations"]
    pairs = list(zip(stations, stations[1:]))
    if cycle["route"]["closed"]:
        pairs.append((stations[-1], stations[0]))
    if BUG == "off-by-one-lane":
        pairs.pop()
    theta_map = cycle["parameters"]["theta_map"]
    return all(
        any(segment_distance(p, a, b) <= theta_map - EPS for a, b in pairs) or in_corridor(p, pairs)
        for p in cycle["trajectory"]["points"])


def points_within(cycle, horizon):
    points, arc = cycle["trajectory"]["points"], 0.0
    for before, point in zip(points[:1] + points, points):
        arc += distance(before, point)
        if arc > horizon + EPS:
            return
        yield point


def collides(cycle, point, item, dx, dy):
    """The low-level collision check with an object that has moved by (dx, dy)."""
    ego = cycle["ego"]
    c, s, offset = point["cos"], point["sin"], ego["center_offset"]
    dx += (item["x"] - point["x"]) - offset * c
    dy += (item["y"] - point["y"]) - offset * s
    if not math.hypot(dx, dy) < cycle["parameters"]["theta_obj"] + EPS:
        return False
    edges = []
    for (c, s), box, more in (((c, s), ego, EPS), ((item["cos"], item["sin"]), item, 0.0)):
        edges.append((c, s, box["length"] / 2 + more))
        edges.append((-s, c, box["width"] / 2 + more))
    return all(abs(dx * ux + dy * uy) <= sum(h * abs(vx * ux + vy * uy) for vx, vy, h in edges)
               for ux, uy, _ in edges)


def s_b(cycle, v):
    return v * v / (2 * cycle["parameters"]["a_b"])


def s_cav(cycle):
    return cycle["parameters"]["safety_time"] * cycle["ego"]["speed"]


def stage_iii(cycle):
    stamp_ns, v_now = cycle["tracks"]["stamp_ns"], cycle["ego"]["speed"]
    horizon = s_b(cycle, v_now) if BUG == "wrong-horizon" else s_cav(cycle)
    for point in points_within(cycle, horizon):
        t = (point["t_ns"] - stamp_ns) / 1e9
        for item in cycle["tracks"]["items"]:
            if collides(cycle, point, item, item["vx"] * t, item["vy"] * t):
                return False
    return True


def stage_iv(cycle):
    v_now, lead = cycle["ego"]["speed"], cycle["lead"]
    horizon = s_b(cycle, v_now)
    if lead:
        horizon = max(horizon - s_b(cycle, lead["speed"]), 0.0) + s_cav(cycle)
        if lead["gap"] <= horizon + EPS:
            return False
    return not any(collides(cycle, point, item, 0.0, 0.0)
                   for point in points_within(cycle, horizon)
                   for item in cycle["detections"]["items"])


def marked(grid, column, row, r):
    """Whether an occupied cell is within r of this one, centre to centre."""
    width, res = grid["width"], grid["resolution"]
    reach = int(r / res)
    for k in range(max(row - reach, 0), min(row + reach, grid["height"] - 1) + 1):
        side = int(math.sqrt(max(r * r - ((k - row) * res)**2, 0.0)) / res)
        low, high = max(column - side, 0), min(column + side, width - 1)
        first, last = k * width + low, k * width + high
        bits = int.from_bytes(grid["occupied"][first // 8:last // 8 + 1], "little")
        if bits >> (first % 8) & ((1 << (last - first + 1)) - 1):
            return True
    return False


def stage_v(cycle):
    grid, ego, n = cycle["grid"], cycle["ego"], cycle["parameters"]["n"]
    length, width, res = ego["length"], ego["width"], grid["resolution"]
    r = ((length / n)**2 + width**2) / 2
    if BUG != "no-sqrt":
        r = math.sqrt((length / n)**2 + width**2) / 2
    norm = grid["cos"]**2 + grid["sin"]**2
    known = {}
    for point in points_within(cycle, s_b(cycle, ego["speed"])):
        for i in range(n):
            along = (2 * i + 1) * length / (2 * n) - length / 2 + ego["center_offset"]
            x = (point["x"] - grid["x"]) + along * point["cos"]
            y = (point["y"] - grid["y"]) + along * point["sin"]
            u = (x * grid["cos"] + y * grid["sin"]) / norm
            v = (y * grid["cos"] - x * grid["sin"]) / norm
            # A centre on the border of cells lies in each of them.
            cells = {(math.floor((u + a) / res), math.floor((v + b) / res))
                     for a in (-EPS, EPS) for b in (-EPS, EPS)}
            for cell in cells:
                if 0 <= cell[0] < grid["width"] and 0 <= cell[1] < grid["height"]:
                    if cell not in known:
                        known[cell] = marked(grid, *cell, r + EPS)
                    if known[cell]:
                        return False
    return True


def failed_stage(cycle):
    """The first stage that fails, in the order of spec/3-stages.md#schedule."""
    configuration = cycle["configuration"]
    if not check_input(cycle):
        return "input"
    if configuration == "Local":
        return None
    received = cycle["tracks"] is not None
    now = {key: cycle[key] is not None
           and 0 <= cycle["now_ns"] - cycle[key]["stamp_ns"] <= cycle["parameters"]["max_age_ns"]
           for key in ("trajectory", "tracks", "detections", "lead", "grid")}
    if not now["lead"]:
        cycle["lead"] = None
    remote_mot = configuration != "PlanRemote"
    if remote_mot and received and now["detections"] and not stage_i(cycle):
        return "i"
    if not now["trajectory"]:
        return None
    if not stage_ii(cycle):
        return "ii"
    ran_iii = now["tracks"] and configuration != "MotRemote"
    if ran_iii and not stage_iii(cycle):
        return "iii"
    ran_iv = now["detections"] and (not ran_iii or BUG == "missing-skip")
    if ran_iv and not stage_iv(cycle):
        return "iv"
    always = configuration == "MotRemote"
    run_v = always or (configuration == "AllRemote" and not ran_iii and not ran_iv)
    if run_v and now["grid"] and not stage_v(cycle):
        return "v"
    return None


def answer_cycle(record):
    try:
        stage = failed_stage(read_cycle(record))
    except Invalid:
        return {"verdict": "error", "failed_stage": None}
    return {"verdict": "unsafe" if stage else "safe", "failed_stage": stage}


# The line protocol: spec/5-interfaces.md.


def unique(pairs):
    return dict(pairs) if len(dict(pairs)) == len(pairs) else {**dict(pairs), "twice": None}


def no_constant(_):
    raise ValueError


def answer(line):
    name = None
    try:
        record = json.loads(
            line.decode("utf-8"), object_pairs_hook=unique, parse_constant=no_constant,
            parse_int=lambda text: int(text) if len(text) < 400 else float(text))
        if not isinstance(record, dict) or not isinstance(record.get("id"), str):
            raise Broken
        name = record["id"]
        kind = choice(record.get("kind"), ("cycle", "offloading", "composition"))
        if kind == "cycle":
            return {"id": name, **answer_cycle(record)}
        if kind == "offloading":
            return {"id": name, **answer_offloading(record, BUG)}
        return {"id": name, **answer_composition(record)}
    except (Broken, ValueError, RecursionError):
        return {"id": name, "verdict": "error", "failed_stage": None}


def main():
    global BUG
    if len(sys.argv) not in (1, 3) or (sys.argv[1:] and sys.argv[1] != "--bug"):
        sys.exit(f"usage: mufasa_py.py [--bug {'|'.join(BUGS)}]")
    BUG = sys.argv[2] if sys.argv[1:] else None
    if BUG not in (None, *BUGS):
        sys.exit(f"no such bug: {BUG}; give one of {', '.join(BUGS)}")
    records.ACCEPT_NAN = BUG == "nan-accepted"
    for line in sys.stdin.buffer:
        sys.stdout.write(json.dumps(answer(line)) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
