"""H-06: the disks of the CAV against the closed squares of the grid's cells."""
import math

from geometry import EPS
from paper import disk_centres, disk_radius, s_b
from stopping import places, s_stop


def stage_v(cycle, ran_iv):
    """H-06: the disks against the squares of cells; the unknown counts unless stage iv ran."""
    grid, r = cycle["grid"], disk_radius(cycle) + EPS
    high_u, high_v = (grid[key] * grid["resolution"] for key in ("width", "height"))
    bitmaps = [grid["occupied"]] if ran_iv else [grid["occupied"], grid["unknown"] or b""]
    bits = [int.from_bytes(bitmap, "little") for bitmap in bitmaps]
    filled = bits[0] | bits[-1]
    if ran_iv:
        for cell in cells_of_detections(cycle, filled):
            filled &= ~(1 << cell)
    rows = [filled >> (k * grid["width"]) & ((1 << grid["width"]) - 1)
            for k in range(grid["height"])]
    for place in places(cycle, max(s_b(cycle, cycle["ego"]["speed"]), s_stop(cycle))):
        for u, v in disk_centres(cycle, *place):
            if not ran_iv and not (r < u < high_u - r and r < v < high_v - r):
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


def cells_of_detections(cycle, filled):
    """The numbers of the marked cells whose closed square surely shares a point with the rectangle
    of a detection: stage iv has examined that rectangle."""
    grid = cycle["grid"]
    res = grid["resolution"]
    norm = grid["cos"]**2 + grid["sin"]**2
    c, s = grid["cos"] / norm, grid["sin"] / norm
    for item in cycle["detections"]["items"]:
        half_length, half_width = item["length"] / 2 - EPS, item["width"] / 2 - EPS
        if min(half_length, half_width) < 0.0:
            continue
        x, y = item["x"] - grid["x"], item["y"] - grid["y"]
        u, v = x * c + y * s, y * c - x * s
        along = item["cos"] * c + item["sin"] * s, item["sin"] * c - item["cos"] * s
        reach = math.hypot(half_length, half_width) + res
        for k in near(v, reach, res, grid["height"]):
            for i in near(u, reach, res, grid["width"]):
                cell = k * grid["width"] + i
                du, dv = u - (i + 0.5) * res, v - (k + 0.5) * res
                if filled >> cell & 1 and square_meets(res / 2, du, dv, along, half_length,
                                                       half_width):
                    yield cell


def near(middle, reach, res, count):
    low, high = math.floor((middle - reach) / res), math.floor((middle + reach) / res)
    return range(max(low, 0), min(high + 1, count))


def square_meets(half, du, dv, along, half_length, half_width):
    """Whether a square along the axes and a rectangle at (du, dv) along a direction share a point."""
    c, s = along
    turned, square = abs(c) + abs(s), c * c + s * s
    return (abs(du) <= half + half_length * abs(c) + half_width * abs(s)
            and abs(dv) <= half + half_length * abs(s) + half_width * abs(c)
            and abs(du * c + dv * s) <= half * turned + half_length * square
            and abs(dv * c - du * s) <= half * turned + half_width * square)
