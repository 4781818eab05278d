"""The paper profile: the stages and the schedule of spec/3-stages.md without the rules H-nn."""
import itertools
import math

from geometry import (EPS, assignment_cost, distance, in_corridor, rectangles_meet,
                      segment_distance)


def current(cycle):
    """Which inputs are there and not older than max_age."""
    return {key: cycle[key] is not None
            and 0 <= cycle["now_ns"] - cycle[key]["stamp_ns"] <= cycle["parameters"]["max_age_ns"]
            for key in ("trajectory", "tracks", "detections", "lead", "grid")}


# The stages: each says whether it passes.


def gated(tracks, distances, r):
    """The possible choices of tracks in the field of view: one at its border, where rounding
    decides, is tried both ways. None when these are too many."""
    inside = [track for track, d in zip(tracks, distances) if d < r - EPS]
    border = [track for track, d in zip(tracks, distances) if abs(d - r) <= EPS]
    if len(border) > 6:
        return None
    return [inside + list(some) for count in range(len(border) + 1)
            for some in itertools.combinations(border, count)]


def too_much_work(cycle, rows, columns):
    few, many = sorted((rows, columns))
    return few * few * many > cycle["parameters"]["work_limit"]


def mean_is_small(cycle, tracks):
    rows, columns = tracks, cycle["detections"]["items"]
    if not (k := min(len(rows), len(columns))):
        return True
    if too_much_work(cycle, len(rows), len(columns)):
        return False
    if len(rows) > len(columns):
        rows, columns = columns, rows
    mean = assignment_cost([[distance(a, b) for b in columns] for a in rows]) / k
    return mean < cycle["parameters"]["theta_tr"] - EPS


def stage_i(cycle):
    tracks, ego = cycle["tracks"]["items"], cycle["ego"]
    r = max((distance(item, ego) for item in cycle["detections"]["items"]), default=0.0)
    choices = gated(tracks, [distance(track, ego) for track in tracks], r)
    return choices is not None and all(mean_is_small(cycle, choice) for choice in choices)


def segments(route):
    """Pairs of consecutive cross sections."""
    stations = route["stations"]
    pairs = list(zip(stations, stations[1:]))
    if route["closed"]:
        pairs.append((stations[-1], stations[0]))
    return pairs


def stage_ii(cycle):
    pairs = segments(cycle["route"])
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


def s_b(cycle, v):
    return v * v / (2 * cycle["parameters"]["a_b"])


def s_cav(cycle):
    return cycle["parameters"]["safety_time"] * cycle["ego"]["speed"]


def collides(cycle, point, item, dx, dy):
    return rectangles_meet(cycle["ego"], point, cycle["ego"]["center_offset"], item, dx, dy,
                           cycle["parameters"]["theta_obj"])


def s_follow(cycle):
    v_now, v_lead = cycle["ego"]["speed"], cycle["lead"]["speed"]
    return max(s_b(cycle, v_now) - s_b(cycle, v_lead), 0.0) + s_cav(cycle)


def s_valid(cycle):
    return s_follow(cycle) if cycle["lead"] else s_b(cycle, cycle["ego"]["speed"])


def stage_iii(cycle):
    stamp_ns = cycle["tracks"]["stamp_ns"]
    for point in points_within(cycle, s_cav(cycle)):
        t = (point["t_ns"] - stamp_ns) / 1e9
        for item in cycle["tracks"]["items"]:
            if collides(cycle, point, item, item["vx"] * t, item["vy"] * t):
                return False
    return True


def stage_iv(cycle):
    if cycle["lead"] and cycle["lead"]["gap"] <= s_follow(cycle) + EPS:
        return False
    return not any(collides(cycle, point, item, 0.0, 0.0)
                   for point in points_within(cycle, s_valid(cycle))
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


def disk_radius(cycle):
    length, width, n = cycle["ego"]["length"], cycle["ego"]["width"], cycle["parameters"]["n"]
    return math.sqrt((length / n)**2 + width**2) / 2


def disk_centres(cycle, pose, offset):
    """The centres of the disks that cover the CAV at a pose, in the frame of the grid."""
    grid, length, n = cycle["grid"], cycle["ego"]["length"], cycle["parameters"]["n"]
    norm = grid["cos"]**2 + grid["sin"]**2
    for i in range(n):
        along = (2 * i + 1) * length / (2 * n) - length / 2 + offset
        x = (pose["x"] - grid["x"]) + along * pose["cos"]
        y = (pose["y"] - grid["y"]) + along * pose["sin"]
        yield ((x * grid["cos"] + y * grid["sin"]) / norm,
               (y * grid["cos"] - x * grid["sin"]) / norm)


def stage_v(cycle):
    grid, ego, res = cycle["grid"], cycle["ego"], cycle["grid"]["resolution"]
    r, known = disk_radius(cycle), {}
    for point in points_within(cycle, s_b(cycle, ego["speed"])):
        for u, v in disk_centres(cycle, point, ego["center_offset"]):
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
    received = cycle["tracks"] is not None
    now = current(cycle)
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
    ran_iv = now["detections"] and not ran_iii
    if ran_iv and not stage_iv(cycle):
        return "iv"
    always = configuration == "MotRemote"
    run_v = always or (configuration == "AllRemote" and not ran_iii and not ran_iv)
    if run_v and now["grid"] and not stage_v(cycle):
        return "v"
    return None
