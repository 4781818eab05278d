"""What the CAV saw itself: the terms of spec/hardened/what-the-cav-saw.md.

Which item is nearest decides what follows, and no margin makes that cautious. So the comparisons
are made as they are written, and `unclear` says that one was too close to call: stage i fails then.
Distances are computed from differences of positions, never from a shifted position: differences
stay small where coordinates are large.
"""
import math
from collections import Counter

from geometry import EPS, distance
from stopping import a_tyre

S = 10**9  # ns
NEAR = 0.3  # m; an item no farther from where a detection was shows that it was there


def gap(item, track, t):
    """The distance of an item to where a track is t seconds after its stamp."""
    return math.hypot((item["x"] - track["x"]) - track["vx"] * t,
                      (item["y"] - track["y"]) - track["vy"] * t)


def speed(track):
    return math.hypot(track["vx"], track["vy"])


def usable(cycle, now):
    """The usable lists of the history, each with its age dt in s and in ns."""
    if not now["detections"]:
        return []
    lists = []
    for one in cycle["detection_history"]:
        age_ns = cycle["detections"]["stamp_ns"] - one["stamp_ns"]
        if S // 5 <= age_ns <= S and cycle["now_ns"] - one["stamp_ns"] <= 60 * S:
            lists.append({"items": one["items"], "age_ns": age_ns, "dt": age_ns / S})
    return lists


def nearest_to_half_a_second(lists):
    """The list whose age is nearest to 500 ms, the younger of two; None when there is none."""
    return min(lists, key=lambda one: (abs(one["age_ns"] - S // 2), one["age_ns"]), default=None)


class Seen:
    """The terms, for a cycle. Tracks and items are named by their index."""

    def __init__(self, cycle, now):
        self.parameters, self.unclear = cycle["parameters"], False
        # Own tracks are compared with nothing when they are not current.
        asked = now["tracks"] or cycle["configuration"] != "PlanRemote"
        received = cycle["tracks"] if asked else None
        self.tracks = received["items"] if received else []
        self.detections = cycle["detections"]["items"] if now["detections"] else []
        self.lists = usable(cycle, now)
        self.reference = nearest_to_half_a_second(self.lists)
        # The place of a track is where it is t_D - t_T after its stamp.
        self.shift = 0.0
        if received and now["detections"]:
            self.shift = (cycle["detections"]["stamp_ns"] - received["stamp_ns"]) / S
        self.own = [self.own_origins(one) for one in self.lists]
        self.backed = [self.is_backed(i) for i in range(len(self.tracks))]
        self.detection = [
            self.nearest(self.detections, track, self.shift, self.parameters["theta_track_max"])
            for track in self.tracks]
        shared = Counter(self.detection)
        self.confirmed = [self.is_confirmed(i, shared) for i in range(len(self.tracks))]
        # Confirmed tracks of a current list; what they explain.
        self.sure = [i for i, sure in enumerate(self.confirmed) if sure and now["tracks"]]
        self.explained = {self.detection[i] for i in self.sure}

    def reach(self, one):
        """How far from its past a track may have been seen in a list of the history."""
        return self.parameters["theta_track_max"] + self.parameters["theta_velocity"] * one["dt"]

    def past_gap(self, item, track, one):
        """The distance of an item of a usable list to the past of a track."""
        return gap(item, track, self.shift - one["dt"])

    def compare(self, value, bound):
        """value <= bound, as written."""
        self.unclear |= abs(value - bound) <= EPS
        return value <= bound

    def nearest(self, items, track, t, bound):
        """The first of the nearest items to where the track is at t, if it is near enough."""
        gaps = [gap(item, track, t) for item in items]
        if not gaps or not self.compare(least := min(gaps), bound):
            return None
        best = gaps.index(least)
        self.unclear |= any(one <= least + EPS and distance(item, items[best]) > 0
                            for one, item in zip(gaps, items))
        return best

    def own_origins(self, one):
        """Of each track its own origin in a list, or None."""
        origins = [self.nearest(one["items"], track, self.shift - one["dt"], self.reach(one))
                   for track in self.tracks]
        shared = Counter(origins)
        return [None if shared[origin] > 1 else origin for origin in origins]

    def is_backed(self, i):
        known = sum(own[i] is not None for own in self.own)
        return self.compare(speed(self.tracks[i]), self.parameters["v_object"]) and known >= 2

    def is_confirmed(self, i, shared):
        if not self.backed[i] or self.detection[i] is None or shared[self.detection[i]] > 1:
            return False
        track, detection = self.tracks[i], self.detections[self.detection[i]]
        if detection["length"] <= 1:
            return True
        across = abs(track["vx"] * detection["sin"] - track["vy"] * detection["cos"])
        return self.compare(across, self.parameters["theta_velocity"] + speed(track) / 10)

    def seen_as(self, i):
        """The list of a confirmed track: that which says best how it moved."""
        return nearest_to_half_a_second(
            [one for one, own in zip(self.lists, self.own) if own[i] is not None])

    def may_stand(self, detection, item):
        """Whether a detection may be what was at an item, and stands."""
        return distance(item, detection) <= self.parameters["theta_track_max"] + EPS

    def borne_out(self, detection, item, one, bound, a):
        """Of each other usable list whether it has an item where the detection then was, when it came from that
        item: at most the bound away from its mean motion, and what an acceleration of at most a adds."""
        w = velocity(item, detection, one)
        moving = {**detection, "vx": w[0], "vy": w[1]}
        for other in self.lists:
            if other is not one:
                off = bound + a * other["dt"] * abs(other["dt"] - one["dt"]) / 2
                yield any(gap(it, moving, -other["dt"]) <= off + EPS for it in other["items"])

    def is_in_range(self, detection, item, one):
        """Whether a detection may have come from an item of a list no faster than v_object."""
        return distance(item, detection) <= self.parameters["v_object"] * one["dt"] + EPS

    def may_come_from(self, detection, item, one):
        """Whether a detection may come from an item of a usable list: when there are other lists, one of them
        supports it."""
        bound, a = max(self.parameters["theta_track_max"], NEAR), a_tyre(self.parameters)
        return self.is_in_range(detection, item, one) and (
            len(self.lists) == 1 or any(self.borne_out(detection, item, one, bound, a)))

    def was_seen_to_come_from(self, detection, item, one):
        """Whether a detection was seen to come from an item of a usable list: each other list shows it."""
        a = a_tyre(self.parameters)
        return self.is_in_range(detection, item, one) and all(self.borne_out(detection, item, one, NEAR, a))

    def has_stood(self, detection):
        """Whether it is where each of at least two usable lists has an item."""
        return len(self.lists) > 1 and all(
            any(distance(item, detection) <= NEAR - EPS for item in one["items"])
            for one in self.lists)

    def moved_evenly(self, detection, item, one):
        """Whether each other list has an item where it was when it came from that item with one velocity."""
        return all(self.borne_out(detection, item, one, NEAR, 0))

    def pasts(self, detection, one):
        """The items of a list to ask for where a detection was: of what stood, only those near it and those
        from which it was seen to come in every list."""
        if not self.has_stood(detection):
            return one["items"]
        return [item for item in one["items"] if distance(item, detection) <= NEAR + EPS
                or self.moved_evenly(detection, item, one)]

    def motions(self):
        """The motions of detections that H-14 examines: each with where it was how long ago, in ns."""
        taken = set()
        for i in self.sure:
            one, d = self.seen_as(i), self.detection[i]
            for item in self.pasts(self.detections[d], one):
                if self.past_gap(item, self.tracks[i], one) <= self.reach(one) + EPS:
                    taken.add((d, id(item)))
                    yield self.detections[d], item, one["age_ns"]
        unexplained = [d for d in range(len(self.detections)) if d not in self.explained]
        if self.reference is not None:
            for d, detection in enumerate(self.detections):
                came = self.was_seen_to_come_from if d in self.explained else self.may_come_from
                for item in self.pasts(detection, self.reference):
                    if (d, id(item)) in taken:
                        continue
                    if self.may_stand(detection, item) or came(detection, item, self.reference):
                        yield detection, item, self.reference["age_ns"]
        for d in unexplained:
            yield self.detections[d], self.detections[d], 1


def velocity(item, detection, one):
    """The velocity of what was at the item of a list and is at the detection now."""
    return ((detection["x"] - item["x"]) / one["dt"], (detection["y"] - item["y"]) / one["dt"])
