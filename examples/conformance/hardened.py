"""The hardened profile: the schedule and the stages of spec/3-stages.md with the rules H-nn, but
for stage ii (hardened_ii.py) and H-08 (offloading.py)."""
import math

from closed_cells import stage_v
from detection_history import S, Seen, gap
from fail_safe import FailSafe
from geometry import EPS, assignment_cost, distance
from hardened_ii import stage_ii
from paper import current, gated, stage_iii, stage_iv, too_much_work
from road import on_the_road


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
    rule = FailSafe(cycle)
    if not (stage_ii(cycle) and rule.within_reach() and on_the_road(cycle, rule.places)):
        return "ii"
    ran_iii = now["tracks"] and configuration != "MotRemote"
    if ran_iii and not stage_iii(cycle):
        return "iii"
    ran_iv = now["detections"] and not ran_iii
    if not (stage_iv(cycle) if ran_iv else gap_is_kept(cycle, rule)):
        return "iv"
    tracks = cycle["tracks"]["items"] if now["tracks"] else []
    # Elsewhere stage i fails for what is too close to call.
    unclear = configuration == "PlanRemote" and now["detections"] and seen.unclear
    if (tracks or seen.detections) and (unclear or not rule.meets_nobody(seen, tracks)):
        return "iv"
    if now["grid"] and not stage_v(cycle, now["detections"], rule.places, rule.a):  # always, or H-10
        return "v"
    # What nothing has checked is no obstacle check (H-02).
    counts_iii = ran_iii and (configuration == "PlanRemote" or checked)
    return None if counts_iii or ran_iv or now["grid"] else "no_obstacle_check"  # H-05


def gap_is_kept(cycle, rule):
    """H-04: the CAV can stop behind a lead that brakes."""
    if not (lead := cycle["lead"]):
        return True
    s_react = max(float(rule.stop.s_stop) - lead["speed"]**2 / (2 * float(rule.stop.a_tyre)), 0.0)
    age = (cycle["now_ns"] - lead["stamp_ns"]) / S
    s_since = cycle["ego"]["speed"] * age + float(rule.stop.a_tyre) * age**2 / 2
    return lead["gap"] > s_react + s_since + EPS


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
