"""Stage ii of the hardened profile: is the trajectory one that the CAV can drive, on the route?"""
from fractions import Fraction

import paper
from detection_history import S
from geometry import EPS, distance, in_corridor, segment_distance
from stopping import between, cross, dot, s_stop, ways


def stage_ii(cycle):
    return (starts_at_the_cav(cycle) and on_the_route(cycle) and steps_are_driven(cycle)
            and way_aside_is_driven(cycle) and turns_are_driven(cycle) and times_are_driven(cycle))


def starts_at_the_cav(cycle):
    """H-07, the first point."""
    ego, first, parameters = cycle["ego"], cycle["trajectory"]["points"][0], cycle["parameters"]
    late_ns = cycle["now_ns"] - first["t_ns"]
    limit = parameters["start_tolerance"] + ego["speed"] * max(late_ns, 0) / S
    return (abs(late_ns) <= parameters["max_age_ns"]
            and distance(first, ego) <= limit - EPS
            and dot(first, ego) > EPS
            and abs(cross(first, ego)) <= 0.17 - EPS
            and abs(between(first, ego, first)[1]) <= parameters["lateral_tolerance"] - EPS)


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


def turns_are_driven(cycle):
    """H-11, each point against its mark: no turn back, on the spot, or harder than tyres hold."""
    points = cycle["trajectory"]["points"]
    mark, mark_way = points[0], 0.0
    for point, way in zip(points[1:], ways(points)[1:]):
        t, w, turn = (point["t_ns"] - mark["t_ns"]) / S, way - mark_way, abs(cross(mark, point))
        if dot(mark, point) < EPS or turn > 0.05 + 0.1 * t + 0.5 * w - EPS:
            return False
        if turn > 0.1 - EPS and turn * w > 0.1 * w + 11.5 * t * t - EPS:
            return False
        if 2 * (point["t_ns"] - mark["t_ns"]) >= S:
            mark, mark_way = point, way
    return True


def times_are_driven(cycle):
    """H-12: neither faster nor slower than the CAV can, and up to where it can stand."""
    points, parameters = cycle["trajectory"]["points"], cycle["parameters"]
    v_now, a_b, a_max = cycle["ego"]["speed"], parameters["a_b"], parameters["a_max"]
    late_ns = cycle["now_ns"] - points[0]["t_ns"]
    d = abs(late_ns) / S
    brakes, gains = (a_max, a_b) if late_ns >= 0 else (a_b, a_max)
    v_lo, v_hi = max(v_now - brakes * d, 0.0), v_now + gains * d
    way, arc = ways(points), 0.0
    for k, point in enumerate(points):
        t = (point["t_ns"] - points[0]["t_ns"]) / S
        arc += distance(points[k - 1], point) if k else 0.0
        # A CAV that brakes stands from v_lo / a_b on.
        t_b = min(t, v_lo / a_b)
        if way[k] < v_lo * t_b - a_b * t_b * t_b / 2 - parameters["lag_tolerance"] + EPS:
            return False
        if arc > v_hi * t + a_max * t * t / 2 + parameters["start_tolerance"] - EPS:
            return False
    if way[-1] < s_stop(cycle) - cycle["ego"]["length"] + EPS:
        return False
    # No margin here, so exactly: t >= min(v_lo / a_b, 50 s).
    t = Fraction(points[-1]["t_ns"] - points[0]["t_ns"], S)
    slowest = max(Fraction(v_now) - Fraction(brakes) * Fraction(abs(late_ns), S), 0)
    return t >= min(slowest / Fraction(a_b), 50)
