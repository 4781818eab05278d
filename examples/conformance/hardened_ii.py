"""Stage ii of the hardened profile: is the trajectory one that the CAV can drive, on the route?"""
import paper
from detection_history import S
from fail_safe import passing_distance
from geometry import EPS, distance, in_corridor, segment_distance
from stopping import between, cross, dot


def stage_ii(cycle):
    """But for what H-14 asks of it: reach (fail_safe.py) and road (road.py)."""
    return (starts_at_the_cav(cycle) and on_the_route(cycle) and steps_are_driven(cycle)
            and way_aside_is_driven(cycle))


def starts_at_the_cav(cycle):
    """H-07 but for the route: the start, and no point farther than the CAV can drive by then."""
    ego, first, parameters = cycle["ego"], cycle["trajectory"]["points"][0], cycle["parameters"]
    late_ns = cycle["now_ns"] - first["t_ns"]
    return (abs(late_ns) <= parameters["max_age_ns"]
            and all(distance(p, ego) <= parameters["start_tolerance"]
                    + way(cycle, (p["t_ns"] - cycle["now_ns"]) / S) - EPS
                    for p in cycle["trajectory"]["points"])
            and dot(first, ego) > EPS
            and abs(cross(first, ego)) <= 0.17 - EPS
            and float(passing_distance(cycle)) <= parameters["lateral_tolerance"] - EPS)


def way(cycle, t):
    """How far the CAV drives from now to t, or drove from t to now."""
    v = cycle["ego"]["speed"]
    return -v * t if t < 0 else v * t + cycle["parameters"]["a_max"] * t**2 / 2


def on_the_route(cycle):
    """H-07, every point: inside the corridor, and along the nearest segments."""
    pairs = paper.segments(cycle["route"])
    lines = [(a, b) for a, b in pairs if distance(a, b) > 0]
    for p in cycle["trajectory"]["points"]:
        if not in_corridor(p, pairs):
            return False
        far = [segment_distance(p, a, b) for a, b in lines]
        if any(between(a, b, p)[0] < EPS for d, (a, b) in zip(far, lines) if d <= min(far) + EPS):
            return False
    return True


def steps_are_driven(cycle):
    """H-11, each step: not too long, forward, and without a turn on the spot."""
    points, parameters = cycle["trajectory"]["points"], cycle["parameters"]
    length, width = cycle["ego"]["length"], cycle["ego"]["width"]
    for a, b in zip(points, points[1:]):
        dt_ns = b["t_ns"] - a["t_ns"]
        dt, step = dt_ns / S, distance(a, b)
        if dt_ns > parameters["step_max_ns"] or dot(a, b) < 0.866 + EPS:
            return False
        if abs(cross(a, b)) > 0.1 + 0.1 * dt + 0.5 * step - EPS:
            return False
        if step > min(length, parameters["v_max"] * dt) - EPS:
            return False
        if step == 0:
            continue
        (along_a, across_a), (along_b, across_b) = between(a, b, a), between(a, b, b)
        if min(along_a, along_b) < -0.1 * dt + EPS:
            return False
        if max(abs(across_a), abs(across_b)) > width / 2 - EPS:
            return False
    return True


def way_aside_is_driven(cycle):
    """H-11, each point: where the headings lead a vehicle with any reference in its front half."""
    points, half = cycle["trajectory"]["points"], cycle["ego"]["length"] / 2
    aside = turned = way = 0.0
    for a, b in zip(points, points[1:]):
        (along_a, across_a), (along_b, across_b) = between(a, b, a), between(a, b, b)
        # u x h = -across
        aside -= across_a + across_b
        turned += half * cross(a, b)
        way += along_a + along_b
        t = (b["t_ns"] - points[0]["t_ns"]) / S
        if abs(aside + turned) > abs(turned) + 0.1 * way + 0.1 + 0.02 * t - EPS:
            return False
    return True
