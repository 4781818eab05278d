"""H-06: the disks of the CAV against the closed squares of the grid's cells."""
import math

from geometry import EPS
from paper import disk_centres, disk_radius, points_within, s_b


def poses(cycle, places):
    """The points that the paper names, then the places of H-14, from the CAV's reference point; which of
    them the paper does not ask to examine beside other stages; which are places."""
    ego = cycle["ego"]
    for point in points_within(cycle, s_b(cycle, ego["speed"])):
        pose = {**point, "x": point["x"] - ego["x"], "y": point["y"] - ego["y"]}
        yield pose, cycle["configuration"] != "MotRemote", False
    yield from ((place.pose, True, True) for place in places)


def stage_v(cycle, detections, places, a):
    """H-06: disks against the squares of cells; the unknown counts unless detections are current.
    Where there is one, an occupied one has to meet the CAV's rectangle, too, and none of theirs, whose
    half sizes are greater by 1/4 m; in MotRemote at the places alone. There the CAV's half width is
    greater by a."""
    ego, grid = cycle["ego"], cycle["grid"]
    items = cycle["detections"]["items"] if detections else []
    high_u, high_v = (grid[key] * grid["resolution"] for key in ("width", "height"))
    bitmaps = [grid["occupied"]] if detections else [grid["occupied"], grid["unknown"] or b""]
    bits = [int.from_bytes(bitmap, "little") for bitmap in bitmaps]
    filled = bits[0] | bits[-1]
    rows = [filled >> (k * grid["width"]) & ((1 << grid["width"]) - 1)
            for k in range(grid["height"])]
    cycle = {**cycle, "grid": {**grid, "x": grid["x"] - ego["x"], "y": grid["y"] - ego["y"]}}
    wide = {**cycle, "ego": {**ego, "width": ego["width"] + 2 * a}}
    offset = ego["center_offset"]
    seen = [rectangle(cycle["grid"], {**item, "x": item["x"] - ego["x"], "y": item["y"] - ego["y"]},
                      0.0, item, 0.25 - EPS)
            for item in items]
    for pose, is_exact, is_place in poses(cycle, places):
        there = wide if is_place else cycle
        r = disk_radius(there) + EPS
        if items and is_exact:
            if rectangle_meets_cell(there, rows, pose, offset, r, seen):
                return False
            continue
        for u, v in disk_centres(cycle, pose, offset):
            if not detections and not (r < u < high_u - r and r < v < high_v - r):
                return False
            if meets_cell(grid, rows, u, v, r):
                return False
    return True


def meets_cell(grid, rows, u, v, r):
    """Whether the closed square of a marked cell is at distance at most r from (u, v)."""
    res = grid["resolution"]
    # One row more on either side: a distance decides, not the rounding of a quotient.
    for k in range(max(math.floor((v - r) / res) - 1, 0),
                   min(math.floor((v + r) / res) + 2, grid["height"])):
        dv = max(k * res - v, v - (k + 1) * res, 0.0)
        if not rows[k] or dv > r:
            continue
        half = math.sqrt(r * r - dv * dv)
        low = max(math.ceil((u - half) / res) - 1, 0)
        high = min(math.floor((u + half) / res), grid["width"] - 1)
        if low <= high and rows[k] >> low & ((1 << (high - low + 1)) - 1):
            return True
    return False


def rectangle(grid, pose, offset, box, more):
    """A rectangle in the frame of the grid: its centre, its direction, its half sizes, greater by more."""
    norm = grid["cos"]**2 + grid["sin"]**2
    c, s = grid["cos"] / norm, grid["sin"] / norm
    x = (pose["x"] - grid["x"]) + offset * pose["cos"]
    y = (pose["y"] - grid["y"]) + offset * pose["sin"]
    along = pose["cos"] * c + pose["sin"] * s, pose["sin"] * c - pose["cos"] * s
    return x * c + y * s, y * c - x * s, along, (box["length"] / 2 + more, box["width"] / 2 + more)


def rectangle_meets_cell(cycle, rows, pose, offset, r, seen):
    """Whether the closed square of a marked cell may share a point with the CAV's rectangle and with
    a disk (where a direction is longer than 1 a corner is outside of them), and with none of seen."""
    disks = list(disk_centres(cycle, pose, offset))
    ego, grid, res = cycle["ego"], cycle["grid"], cycle["grid"]["resolution"]
    cav = u, v, along, half = rectangle(grid, pose, offset, ego, EPS)
    reach = math.hypot(*half) * math.hypot(*along) + EPS
    low, high = (max(math.floor((u + side) / res), 0) for side in (-reach, reach))
    for k in range(max(math.floor((v - reach) / res), 0),
                   min(math.floor((v + reach) / res) + 1, grid["height"])):
        row = rows[k] >> low
        for i in range(low, min(high + 1, grid["width"])) if row else ():
            x, y = (i + 0.5) * res, (k + 0.5) * res
            if (row >> (i - low) & 1 and square_meets(res / 2, x, y, cav)
                    and any(math.hypot(max(abs(x - disk[0]) - res / 2, 0.0),
                                       max(abs(y - disk[1]) - res / 2, 0.0)) <= r
                            for disk in disks)):
                if not any(square_meets(res / 2, x, y, detection) for detection in seen):
                    return True
                rows[k] &= ~(1 << i)  # It is left out at every place.
    return False


def square_meets(half, x, y, other):
    """Whether a square along the axes around (x, y) and a rectangle share a point: no axis of either
    separates them."""
    u, v, (c, s), (length, width) = other
    du, dv = u - x, v - y
    turned, square = half * (abs(c) + abs(s)), c * c + s * s
    return (abs(du) <= half + length * abs(c) + width * abs(s)
            and abs(dv) <= half + length * abs(s) + width * abs(c)
            and abs(du * c + dv * s) <= turned + length * square
            and abs(dv * c - du * s) <= turned + width * square)
