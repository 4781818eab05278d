"""The hardened profile: the schedule and the stages of spec/3-stages.md with the rules H-nn, but
for stage ii (hardened_ii.py) and H-08 (offloading.py)."""
import math

from closed_cells import stage_v
from detection_history import S, Seen, gap
from geometry import EPS, assignment_cost, distance, rectangles_meet, stays_apart
from hardened_ii import stage_ii
from paper import current, gated, s_cav, s_follow, s_valid, too_much_work
from stopping import places, s_stop


def failed_stage(cycle):
    """The first stage that fails, in the order of spec/3-stages.md#schedule."""
    configuration, now = cycle["configuration"], current(cycle)
    if not now["lead"]:
        cycle["lead"] = None
    seen = Seen(cycle, now)
    checked = configuration != "PlanRemote" and cycle["tracks"] is not None and now["detections"]
    if checked and not stage_i(cycle, seen):
        return "i"
    if not now["trajectory"]:
        return None
    if not stage_ii(cycle):
        return "ii"
    ran_iii = now["tracks"] and configuration != "MotRemote"
    if ran_iii and not stage_iii(cycle, seen):
        return "iii"
    # The gap counts where stage iv does not run, too (H-04).
    if cycle["lead"] and cycle["lead"]["gap"] <= s_follow(cycle) + EPS:
        return "iv"
    ran_iv = now["detections"] and (configuration == "AllRemote" or not ran_iii)  # H-10
    if ran_iv and not stage_iv(cycle, seen, ran_iii):
        return "iv"
    if now["grid"] and not stage_v(cycle, ran_iv):  # in MotRemote always, else H-10
        return "v"
    # What nothing has checked is no obstacle check (H-02).
    counts_iii = ran_iii and (configuration == "PlanRemote" or checked)
    return None if counts_iii or ran_iv or now["grid"] else "no_obstacle_check"  # H-05


def stage_i(cycle, seen):
    """H-01; and what is too close to call."""
    if seen.unclear:
        return False
    ego, tracks = cycle["ego"], seen.tracks
    r = max((distance(item, ego) for item in seen.detections), default=0.0)
    far = [gap(ego, track, seen.shift) for track in tracks]
    choices = gated(range(len(tracks)), far, r)
    return choices is not None and all(assigned(cycle, seen, choice) for choice in choices)


def assigned(cycle, seen, choice):
    """Whether the tracks can be assigned, some backed ones left out.

    A mean is below theta_tr when the sum of what each distance is above theta_tr is negative. So
    the tracks that are left out can be assigned, too: at cost 0, to columns that only backed
    tracks can take.
    """
    parameters = cycle["parameters"]
    backed = sum(seen.backed[i] for i in choice)
    if backed == len(choice) <= parameters["miss_budget"]:
        return True
    spare = min(parameters["miss_budget"], backed)
    columns = len(seen.detections) + spare
    if len(choice) > columns or too_much_work(cycle, len(choice), columns):
        return False
    costs = []
    for i in choice:
        gaps = [gap(item, seen.tracks[i], seen.shift) for item in seen.detections]
        costs.append([d - (parameters["theta_tr"] - EPS)
                      if d < parameters["theta_track_max"] - EPS else math.inf for d in gaps]
                     + spare * [0.0 if seen.backed[i] else math.inf])
    return assignment_cost(costs) < 0


def circumradius(box):
    return math.hypot(box["length"], box["width"]) / 2 * (1 + 1e-6)


def collides(cycle, place, item, dx, dy):
    """H-03: however large the object is."""
    near = max(cycle["parameters"]["theta_obj"], circumradius(cycle["ego"]) + circumradius(item))
    return rectangles_meet(cycle["ego"], *place, item, dx, dy, near)


def stage_iii(cycle, seen):
    stamp_ns = cycle["tracks"]["stamp_ns"]
    for place in places(cycle, max(s_cav(cycle), s_stop(cycle))):
        t = (place[0]["t_ns"] - stamp_ns) / S
        for i, item in enumerate(cycle["tracks"]["items"]):
            times = [t]
            if cycle["configuration"] == "AllRemote" and not seen.backed[i]:
                times.append(seen.shift)  # standing at its place (H-09)
            if any(collides(cycle, place, item, item["vx"] * at, item["vy"] * at) for at in times):
                return False
    return True


def stage_iv(cycle, seen, ran_iii):
    s_valid_or_stop = max(s_valid(cycle), s_stop(cycle))
    # Beside stage iii what is explained stands still only as far as the CAV needs to stop (H-10).
    explained = seen.explained if ran_iii else set()
    near = [item for i, item in enumerate(seen.detections) if i in explained]
    far = [item for i, item in enumerate(seen.detections) if i not in explained]
    for horizon, items in ((s_stop(cycle), near), (s_valid_or_stop, far)):
        for place in places(cycle, horizon):
            if any(collides(cycle, place, item, 0.0, 0.0) for item in items):
                return False
    return not seen.lists or stage_iv_moving(cycle, seen)


def stage_iv_moving(cycle, seen):
    """H-13: the motions that the CAV may have seen itself."""
    horizon = s_stop(cycle) + cycle["parameters"]["tau_motion"] * cycle["ego"]["speed"]
    examined, points = list(places(cycle, horizon, horizon)), cycle["trajectory"]["points"]
    if seen.work(max(len(examined), len(points))) > cycle["parameters"]["work_limit"]:
        return False
    motions = list(seen.moving())
    if any(meets(cycle, place, motion) for place in examined for motion in motions):
        return False
    # (c): farther on what the CAV may not wait for, unless it stands in its way already.
    motions = [motion for motion in motions if may_wait(cycle, points[0], motion, -EPS)]
    for before, point in zip(points[len(examined) - 1:], points[len(examined):]):
        motions = [motion for motion in motions if not may_wait(cycle, before, motion, EPS)]
        place = point, cycle["ego"]["center_offset"]
        if any(meets(cycle, place, motion) for motion in motions):
            return False
    return True


def moved(cycle, point, motion):
    """How far an object has moved when the CAV is at a point."""
    t = (point["t_ns"] - cycle["detections"]["stamp_ns"]) / S
    return [speed * t for speed in motion[1]]


def meets(cycle, place, motion):
    return collides(cycle, place, motion[0], *moved(cycle, place[0], motion))


def may_wait(cycle, point, motion, more):
    """The CAV may wait at a point for an object that moves."""
    item, velocity = motion
    return stays_apart(cycle["ego"], point, more, item, *moved(cycle, point, motion), velocity)
