"""H-06: the disks of the CAV against the closed squares of the grid's cells."""
import math

from geometry import EPS
from paper import disk_centres, disk_radius, points_within, s_b


def poses(cycle, places):
    """The points that the paper names, then the places of H-14, from the CAV's reference point."""
    ego = cycle["ego"]
    for point in points_within(cycle, s_b(cycle, ego["speed"])):
        yield {**point, "x": point["x"] - ego["x"], "y": point["y"] - ego["y"]}
    yield from (place.pose for place in places)


def stage_v(cycle, detections, places):
    """H-06: disks against the squares of cells; the unknown counts unless detections are current.
    Where there is one, and not in MotRemote, an occupied one has to meet the CAV's rectangle, too."""
    ego, grid, r = cycle["ego"], cycle["grid"], disk_radius(cycle) + EPS
    is_exact = (detections and cycle["detections"]["items"]
                and cycle["configuration"] != "MotRemote")
    high_u, high_v = (grid[key] * grid["resolution"] for key in ("width", "height"))
    bitmaps = [grid["occupied"]] if detections else [grid["occupied"], grid["unknown"] or b""]
    bits = [int.from_bytes(bitmap, "little") for bitmap in bitmaps]
    filled = bits[0] | bits[-1]
    rows = [filled >> (k * grid["width"]) & ((1 << grid["width"]) - 1)
            for k in range(grid["height"])]
    cycle = {**cycle, "grid": {**grid, "x": grid["x"] - ego["x"], "y": grid["y"] - ego["y"]}}
    offset = ego["center_offset"]
    for pose in poses(cycle, places):
        if is_exact:
            if rectangle_meets_cell(cycle, rows, pose, offset, r):
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


def rectangle_meets_cell(cycle, rows, pose, offset, r):
    """Whether the closed square of a marked cell may share a point with the CAV's rectangle, and with
    a disk: where a direction is longer than 1 a corner is outside of them."""
    disks = list(disk_centres(cycle, pose, offset))
    ego, grid, res = cycle["ego"], cycle["grid"], cycle["grid"]["resolution"]
    norm = grid["cos"]**2 + grid["sin"]**2
    c, s = grid["cos"] / norm, grid["sin"] / norm
    x = (pose["x"] - grid["x"]) + offset * pose["cos"]
    y = (pose["y"] - grid["y"]) + offset * pose["sin"]
    u, v = x * c + y * s, y * c - x * s
    along = pose["cos"] * c + pose["sin"] * s, pose["sin"] * c - pose["cos"] * s
    half = ego["length"] / 2 + EPS, ego["width"] / 2 + EPS
    reach = math.hypot(*half) + EPS
    low, high = (max(math.floor((u + side) / res), 0) for side in (-reach, reach))
    for k in range(max(math.floor((v - reach) / res), 0),
                   min(math.floor((v + reach) / res) + 1, grid["height"])):
        row = rows[k] >> low
        for i in range(low, min(high + 1, grid["width"])) if row else ():
            x, y = (i + 0.5) * res, (k + 0.5) * res
            if (row >> (i - low) & 1 and square_meets(res / 2, u - x, v - y, along, half)
                    and any(math.hypot(max(abs(x - disk[0]) - res / 2, 0.0),
                                       max(abs(y - disk[1]) - res / 2, 0.0)) <= r
                            for disk in disks)):
                return True
    return False


def square_meets(half, du, dv, along, box):
    """Whether a square along the axes and a rectangle at (du, dv) along a direction share a point:
    no axis of either separates them."""
    (c, s), (length, width) = along, box
    turned, square = half * (abs(c) + abs(s)), c * c + s * s
    return (abs(du) <= half + length * abs(c) + width * abs(s)
            and abs(dv) <= half + length * abs(s) + width * abs(c)
            and abs(du * c + dv * s) <= turned + length * square
            and abs(dv * c - du * s) <= turned + width * square)
