"""Reads the record `cycle`: its schema (spec/5-interfaces.md#cycle), then the domain of its values
(spec/3-stages.md#invalid-input, spec/4-arithmetic.md#domain).
"""
import base64
import binascii
import math
from fractions import Fraction

S60 = 60_000_000_000
I64_MAX = 2**63 - 1
POSITION, SPEED, VELOCITY = (-2.0**24, 2.0**24), (0.0, 150.0), (-150.0, 150.0)
SIZE, THRESHOLD, POSITIVE, ANY = (0.01, 100.0), (1e-3, 1e3), (5e-324, 1e3), (-2.0, 2.0)

# Name: (default, domain); an int default says that an integer is asked for.
PARAMETERS = {
    "theta_tr": (0.2, THRESHOLD), "theta_map": (0.3, THRESHOLD), "theta_obj": (5.0, THRESHOLD),
    "a_b": (8.0, (0.1, 100.0)), "safety_time": (1.8, (0.0, 60.0)),
    "max_age_ns": (100_000_000, (0, S60)), "n": (4, (1, 64)),
    "theta_track_max": (1.0, THRESHOLD), "miss_budget": (4, (0, 64)), "tau": (0.1, (0.0, 60.0)),
    "a_max": (3.0, (0.1, 100.0)), "start_tolerance": (2.0, THRESHOLD),
    "v_max": (150.0, POSITIVE),
    "step_max_ns": (200_000_000, (0, S60)), "theta_velocity": (2.0, POSITIVE),
    "lateral_tolerance": (0.5, THRESHOLD),
    "v_object": (70.0, POSITIVE), "t_yield": (2.0, (0.0, 60.0)), "a_yield": (3.0, (0.1, 100.0)),
    "work_limit": (700_000, (0, 2**63 - 1)),
    "delta": (1e-6, (1e-8, 1e-2))}
TIMES = {"t_wait_ns": 10_000_000_000, "request_timeout_ns": 500_000_000, "l_max_ns": 50_000_000,
         "dt_max_ns": 100_000_000}
POSE = {"x": POSITION, "y": POSITION, "cos": ANY, "sin": ANY}
BOX = {"length": SIZE, "width": SIZE}


class Broken(Exception):
    """The record breaks the schema."""


class Invalid(Exception):
    """A value is outside its domain."""


# Schema: what a record may look like, whatever its values are.


def fields(value, required, optional=()):
    if not isinstance(value, dict) or not set(required) <= set(value):
        raise Broken
    if not set(value) <= set(required) | set(optional):
        raise Broken
    return value


def number(value):
    if isinstance(value, str) and value in ("nan", "inf", "-inf"):
        return float(value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise Broken
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def integer(value):
    if isinstance(value, bool) or not isinstance(value, int) or not -(2**63) <= value <= I64_MAX:
        raise Broken
    return value


def listed(value, read):
    if not isinstance(value, list):
        raise Broken
    return [read(item) for item in value]


def choice(value, choices):
    if not isinstance(value, str) or value not in choices:
        raise Broken
    return value


def plain(value, numbers, integers=()):
    fields(value, [*numbers, *integers])
    return {**{key: number(value[key]) for key in numbers},
            **{key: integer(value[key]) for key in integers}}


def stamped(value, key, read):
    fields(value, ["stamp_ns", key])
    return {"stamp_ns": integer(value["stamp_ns"]), key: listed(value[key], read)}


def read_track(value):
    return plain(value, [*POSE, "vx", "vy", *BOX], ["id"])


def read_detections(value):
    return stamped(value, "items", lambda d: plain(d, [*POSE, *BOX]))


def read_pair(value):
    if len(pair := listed(value, number)) != 2:
        raise Broken
    return pair


def read_station(value):
    fields(value, ["x", "y", "left", "right"])
    return {"x": number(value["x"]), "y": number(value["y"]),
            "left": read_pair(value["left"]), "right": read_pair(value["right"])}


def read_route(value):
    fields(value, ["closed", "stations"])
    if not isinstance(value["closed"], bool):
        raise Broken
    return {"closed": value["closed"], "stations": listed(value["stations"], read_station)}


def read_base64(text):
    try:
        decoded = base64.b64decode(text, validate=True) if isinstance(text, str) else None
    except (binascii.Error, ValueError):
        raise Broken from None
    # What is written again must be the same: pad bits that are not zero are refused so.
    if decoded is None or base64.b64encode(decoded).decode() != text:
        raise Broken
    return decoded


def read_grid(value):
    numbers, integers = [*POSE, "resolution"], ["stamp_ns", "width", "height"]
    fields(value, [*numbers, *integers, "occupied"], ["unknown"])
    grid = plain({key: value[key] for key in numbers + integers}, numbers, integers)
    for key in ("occupied", "unknown"):
        grid[key] = value.get(key)
        if grid[key] is not None or key == "occupied":
            grid[key] = read_base64(grid[key])
    return grid


def read_parameters(value, defaults):
    fields(value, [], [*defaults, *TIMES])
    for key in set(TIMES) & set(value):
        if integer(value[key]) < 0:
            raise Broken
    return {key: default if key not in value else
            (integer if isinstance(default, int) else number)(value[key])
            for key, default in defaults.items()}


INPUTS = {
    "trajectory": lambda v: stamped(v, "points", lambda p: plain(p, POSE, ["t_ns"])),
    "tracks": lambda v: stamped(v, "items", read_track),
    "detections": read_detections,
    "lead": lambda v: plain(v, ["gap", "speed"], ["stamp_ns"]),
    "grid": read_grid,
    "detection_history": lambda v: listed(v, read_detections)}


def read_ego(value):
    return plain(value, [*POSE, "speed", *BOX, "center_offset"])


def read_cycle(record):
    need = ["kind", "id", "now_ns", "configuration", "ego", "route"]
    fields(record, need, ["profile", "parameters", *INPUTS])
    cycle = {key: None if record.get(key) is None else read(record[key])
             for key, read in INPUTS.items()}
    cycle["detection_history"] = cycle["detection_history"] or []
    cycle["profile"] = choice(record.get("profile", "hardened"), ("paper", "hardened"))
    defaults = {key: default for key, (default, _) in PARAMETERS.items()}
    cycle["parameters"] = read_parameters(record.get("parameters", {}), defaults)
    cycle["now_ns"] = integer(record["now_ns"])
    names = ("Local", "MotRemote", "AllRemote", "PlanRemote")
    cycle["configuration"] = choice(record["configuration"], names)
    cycle["ego"] = read_ego(record["ego"])
    cycle["route"] = read_route(record["route"])
    return cycle


# Domain: spec/3-stages.md#invalid-input.


def within(value, domain):
    if not domain[0] <= value <= domain[1]:
        raise Invalid


def check_item(item, domains):
    for key, domain in domains.items():
        within(item[key], domain)
    if "cos" in domains and item["cos"] == item["cos"] and item["sin"] == item["sin"]:
        norm = Fraction(item["cos"])**2 + Fraction(item["sin"])**2
        if abs(norm - 1) > Fraction(1e-6):
            raise Invalid


def check_stamp(stamp_ns, now_ns, remote):
    """Whether it is not too old to be used."""
    if now_ns - stamp_ns < -S60 or (remote and now_ns - stamp_ns > S60):
        raise Invalid
    return now_ns - stamp_ns <= S60


def check_list(value, now_ns, remote, limit, domains):
    if value is None:
        return
    check_stamp(value["stamp_ns"], now_ns, remote)
    within(len(value["items"]), (0, limit))
    for item in value["items"]:
        check_item(item, domains)
    ids = [item["id"] for item in value["items"] if "id" in item]
    if len(set(ids)) != len(ids):
        raise Invalid


def check_history(lists, now_ns):
    within(len(lists), (0, 4))
    for younger, value in zip([None, *lists], lists):
        check_list(value, now_ns, False, 2048, {**POSE, **BOX})
        if younger and younger["stamp_ns"] <= value["stamp_ns"]:
            raise Invalid


def check_trajectory(cycle, remote):
    if (trajectory := cycle["trajectory"]) is None:
        return
    # An old local trajectory counts as missing: then its points may be old, too.
    usable = check_stamp(trajectory["stamp_ns"], cycle["now_ns"], remote)
    points = trajectory["points"]
    within(len(points), (1, 1024))
    for before, point in zip([None, *points], points):
        check_stamp(point["t_ns"], cycle["now_ns"], usable)
        check_item(point, POSE)
        if before and before["t_ns"] >= point["t_ns"]:
            raise Invalid
    if not usable:
        cycle["trajectory"] = None


def check_route(stations):
    within(len(stations), (2, 8192))
    for before, station in zip([None, *stations], stations):
        for value in (station["x"], station["y"], *station["left"], *station["right"]):
            within(value, POSITION)
        if before and (before["x"], before["y"]) == (station["x"], station["y"]):
            raise Invalid


def check_grid(grid):
    check_item(grid, {**POSE, "resolution": (0.01, 10.0), "width": (1, 2**15),
                      "height": (1, 2**15)})
    within(grid["width"] * grid["height"], (1, 2**24))
    for bitmap in (grid["occupied"], grid["unknown"]):
        if bitmap is not None and len(bitmap) != (grid["width"] * grid["height"] + 7) // 8:
            raise Invalid


def check_local(cycle):
    check_item(cycle["parameters"], {key: domain for key, (_, domain) in PARAMETERS.items()})
    check_item(cycle["ego"], {**POSE, **BOX, "speed": SPEED, "center_offset": (-100.0, 100.0)})
    now_ns = cycle["now_ns"]
    if lead := cycle["lead"]:
        check_stamp(lead["stamp_ns"], now_ns, False)
        check_item(lead, {"gap": (0.0, 1e6), "speed": SPEED})
    check_route(cycle["route"]["stations"])
    if cycle["grid"]:
        check_stamp(cycle["grid"]["stamp_ns"], now_ns, False)
        check_grid(cycle["grid"])
    check_list(cycle["detections"], now_ns, False, 2048, {**POSE, **BOX})
    check_history(cycle["detection_history"], now_ns)


def check_input(cycle):
    """Whether remote data are valid; raises Invalid for local data."""
    tracks = {**POSE, **BOX, "vx": VELOCITY, "vy": VELOCITY}
    check_local(cycle)
    checks = [
        (cycle["configuration"] in ("MotRemote", "AllRemote"),
         lambda remote: check_list(cycle["tracks"], cycle["now_ns"], remote, 1024, tracks)),
        (cycle["configuration"] in ("AllRemote", "PlanRemote"),
         lambda remote: check_trajectory(cycle, remote))]
    for remote, check in sorted(checks, key=lambda pair: pair[0]):
        try:
            check(remote)
        except Invalid:
            if not remote:
                raise
            return False
    return True
