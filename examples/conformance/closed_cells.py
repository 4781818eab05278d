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
    theirs = set()
    if ran_iv and cycle["configuration"] != "MotRemote":
        theirs = set(cells_of_detections(cycle, filled))
    for cell in theirs:
        filled &= ~(1 << cell)
    rows = [filled >> (k * grid["width"]) & ((1 << grid["width"]) - 1)
            for k in range(grid["height"])]
    for place in places(cycle, max(s_b(cycle, cycle["ego"]["speed"]), s_stop(cycle))):
        for u, v in disk_centres(cycle, *place):
            if not ran_iv and not (r < u < high_u - r and r < v < high_v - r):
                return False
            if meets_cell(grid, rows, u, v, r):
                return False
        if any(rectangle_meets(cycle, place, cell) for cell in theirs):
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
    of a detection. Against these stands the CAV's rectangle, not its disks."""
    grid = cycle["grid"]
    for item in cycle["detections"]["items"]:
        half = item["length"] / 2 - EPS, item["width"] / 2 - EPS
        if min(half) < 0.0:
            continue
        middle, along = in_grid(grid, item["x"], item["y"], item)
        reach = math.hypot(*half) + grid["resolution"]
        for k in near(middle[1], reach, grid["resolution"], grid["height"]):
            for i in near(middle[0], reach, grid["resolution"], grid["width"]):
                cell = k * grid["width"] + i
                if filled >> cell & 1 and square_meets(grid, cell, middle, along, half):
                    yield cell


def rectangle_meets(cycle, place, cell):
    """Whether the CAV's rectangle at a place may share a point with the closed square of a cell."""
    (pose, offset), ego = place, cycle["ego"]
    x, y = pose["x"] + offset * pose["cos"], pose["y"] + offset * pose["sin"]
    half = ego["length"] / 2 + EPS, ego["width"] / 2 + EPS
    return square_meets(cycle["grid"], cell, *in_grid(cycle["grid"], x, y, pose), half)


def in_grid(grid, x, y, heading):
    """A place and a heading in the frame of the grid."""
    norm = grid["cos"]**2 + grid["sin"]**2
    c, s = grid["cos"] / norm, grid["sin"] / norm
    x, y = x - grid["x"], y - grid["y"]
    return ((x * c + y * s, y * c - x * s),
            (heading["cos"] * c + heading["sin"] * s, heading["sin"] * c - heading["cos"] * s))


def near(middle, reach, res, count):
    low, high = math.floor((middle - reach) / res), math.floor((middle + reach) / res)
    return range(max(low, 0), min(high + 1, count))


def square_meets(grid, cell, middle, along, half):
    """Whether the closed square of a cell and a rectangle, all in the frame of the grid, share a
    point: no axis of either separates them."""
    (half_length, half_width), (c, s), res = half, along, grid["resolution"]
    k, i = divmod(cell, grid["width"])
    du, dv = middle[0] - (i + 0.5) * res, middle[1] - (k + 0.5) * res
    turned, square = res / 2 * (abs(c) + abs(s)), c * c + s * s
    return (abs(du) <= res / 2 + half_length * abs(c) + half_width * abs(s)
            and abs(dv) <= res / 2 + half_length * abs(s) + half_width * abs(c)
            and abs(du * c + dv * s) <= turned + half_length * square
            and abs(dv * c - du * s) <= turned + half_width * square)
