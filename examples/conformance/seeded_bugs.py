"""The bugs that are seeded into the programs under test: which text becomes which.

A program with a bug is a copy in which each `old` text, which stands there once, is the `new` one.
"""
from dataclasses import dataclass


@dataclass(frozen=True)
class Bug:
    name: str
    program: str  # of programs.PROGRAMS
    profile: str
    kind: str  # of the records in which it shows
    about: str
    changes: tuple  # of (file, old, new)


def python(name, file, old, new, about, kind="cycle"):
    return Bug(name, "Python", "paper", kind, about, ((file, old, new),))


def hardened(name, file, old, new, about, kind="cycle"):
    return Bug(name, "Python", "hardened", kind, about, ((file, old, new),))


def monitor(name, old, new, about, profile="hardened"):
    return Bug(name, "Python monitor", profile, "monitor", about, (("monitor.py", old, new),))


def cpp(name, about, *changes, file="mufasa_cpp.cpp"):
    return Bug(name, "C++", "paper", "cycle", about, tuple((file, *change) for change in changes))


def javascript(name, about, *changes, file="mufasa_js.mjs"):
    changes = tuple((file, *change) for change in changes)
    return Bug(name, "JavaScript", "paper", "cycle", about, changes)


GREEDY = """    free, total = set(range(len(costs[0]))), 0.0
    for row in costs:
        best = min(free, key=row.__getitem__)
        free.remove(best)
        total += row[best]
    return total
"""

# Fields that somebody keeps in 32 bits: the program in C++ decides the paper profile, the one in Python the hardened one.
FLOATS = {
    "ego": ("c.ego.{0} = float(c.ego.{0});", "x y cos sin length width speed center_offset"),
    "trajectory": ("if (c.trajectory) for (auto& it : c.trajectory->items) it.{0} = float(it.{0});", "x y cos sin"),
    "tracks": ("if (c.tracks) for (auto& it : c.tracks->items) it.{0} = float(it.{0});",
               "x y cos sin vx vy length width"),
    "detections": ("if (c.detections) for (auto& it : c.detections->items) it.{0} = float(it.{0});",
                   "x y cos sin length width"),
    "lead": ("if (c.lead) c.lead->{0} = float(c.lead->{0});", "gap speed"),
    "route": ("for (auto& it : c.stations) it.{0} = float(it.{0});", "x y left.x left.y right.x right.y"),
    "grid": ("if (c.grid) c.grid->{0} = float(c.grid->{0});", "x y cos sin resolution"),
    "parameters": ("c.parameters.{0} = float(c.parameters.{0});", "theta_tr theta_map theta_obj a_b safety_time")}
FLOATS_HARDENED = {
    "parameters": ('cycle["parameters"]["{0}"] = float32(cycle["parameters"]["{0}"])',
                   "theta_track_max tau a_max start_tolerance v_max theta_velocity lateral_tolerance v_object t_yield "
                   "a_yield"),
    "history": ('for one in cycle["detection_history"]: '
                '[it.update({0}=float32(it["{0}"])) for it in one["items"]]', "x y")}


def floats():
    for part, (text, fields) in FLOATS.items():
        for field in fields.split():
            yield cpp(f"float32-{part}-{field}", f"{part}: {field} as a float of 32 bits",
                      ("  return c;\n}\n\n// Domain.", f"  {text.format(field)}\n  return c;\n}}\n\n// Domain."),
                      file="record.hpp")
    for part, (text, fields) in FLOATS_HARDENED.items():
        for field in fields.split():
            yield Bug(f"float32-{part}-{field}", "Python", "hardened", "cycle", f"{part}: {field} as a float of 32 bits",
                      (("record.py", "import math\n", "import ctypes\nimport math\n"),
                       ("record.py", "class Broken(Exception):",
                        "def float32(value):\n    return ctypes.c_float(value).value\n\n\nclass Broken(Exception):"),
                       ("record.py", '    cycle["now_ns"] = integer(record["now_ns"])\n',
                        f'    {text.format(field)}\n    cycle["now_ns"] = integer(record["now_ns"])\n')))


BUGS = [
    python("le-for-lt", "paper.py", 'mean < cycle["parameters"]["theta_tr"] - EPS',
           'mean <= cycle["parameters"]["theta_tr"]',
           "stage i: mean <= theta_tr, in place of <, and no margin"),
    python("greedy-assignment", "geometry.py", "    columns = len(costs[0])\n    row_of",
           GREEDY + "    columns = len(costs[0])\n    row_of",
           "stage i: each track takes the nearest detection that is left"),
    python("other-diagonal", "geometry.py",
           "((local[0], local[1], local[2]), (local[0], local[2], local[3]))",
           "((local[0], local[1], local[3]), (local[1], local[2], local[3]))",
           "stage ii: the corridor is split along the other diagonal"),
    python("wrong-horizon", "paper.py", "points_within(cycle, s_cav(cycle))",
           'points_within(cycle, s_b(cycle, cycle["ego"]["speed"]))',
           "stage iii looks as far as s_b, not s_CAV"),
    python("looks-4-s-ahead", "paper.py", 't = (point["t_ns"] - stamp_ns) / 1e9',
           't = min((point["t_ns"] - stamp_ns) / 1e9, 4.0)', "stage iii: a track stops after 4 s"),
    python("speed-at-50", "paper.py", 'cycle["parameters"]["safety_time"] * cycle["ego"]["speed"]',
           'cycle["parameters"]["safety_time"] * min(cycle["ego"]["speed"], 50.0)', "s_CAV: no CAV is faster than 50 m/s"),
    python("tracks-at-40", "paper.py", 'collides(cycle, point, item, item["vx"] * t,',
           'collides(cycle, point, item, min(item["vx"], 40.0) * t,', "stage iii: no track is faster than 40 m/s along x"),
    python("lead-at-30", "paper.py", 'v_now, v_lead = cycle["ego"]["speed"], cycle["lead"]["speed"]',
           'v_now, v_lead = cycle["ego"]["speed"], min(cycle["lead"]["speed"], 30.0)',
           "s_follow: no lead is faster than 30 m/s"),
    python("earlier-lists-unchecked", "record.py", "check_list(value, now_ns, False, 2048, {**POSE, **BOX})",
           "check_list(value, now_ns, False, 2048, {} if younger else {**POSE, **BOX})",
           "items are checked in the youngest list of the history alone"),
    python("no-sqrt", "paper.py", "return math.sqrt((length / n)**2 + width**2) / 2",
           "return ((length / n)**2 + width**2) / 2",
           "stage v: the radius of the disks without the square root"),
    python("no-hold", "offloading.py",
           "self.hold_until_ns = until_ns if old_ns is None else max(old_ns, until_ns)", "pass",
           "a fallback does not bar offloading", "offloading"),
    python("hold-moved-back", "offloading.py",
           "self.hold_until_ns = until_ns if old_ns is None else max(old_ns, until_ns)",
           "self.hold_until_ns = until_ns",
           "a hold ends t_wait after the last fallback, even when an earlier one lasts longer",
           "offloading"),
    python("no-saturation", "offloading.py", "return min(now_ns + self.parameters[key], I64_MAX)",
           "return now_ns + self.parameters[key]",
           "a hold or deadline may lie beyond 64 bits", "offloading"),
    python("cycles-composed", "composition.py", "return bool(rest)", "return False",
           "services that need each other in a circle are composed", "composition"),
    python("key-twice", "mufasa_py.py",
           'return dict(pairs) if len(dict(pairs)) == len(pairs) else {**dict(pairs), "twice": None}',
           "return dict(pairs)", "of a key that stands twice the last value counts", "line"),
    python("norm-in-doubles", "record.py",
           """        norm = Fraction(item["cos"])**2 + Fraction(item["sin"])**2
        if abs(norm - 1) > Fraction(1e-6):""",
           """        norm = item["cos"] * item["cos"] + item["sin"] * item["sin"]
        if abs(norm - 1) > 1e-6:""",
           "cos^2 + sin^2 of a direction is computed and compared in doubles"),
    hardened("any-number-missed", "hardened.py", 'spare = min(parameters["miss_budget"], backed)',
             "spare = backed", "H-01: any number of backed tracks may be left out"),
    hardened("no-shift", "detection_history.py", 'if received and now["detections"]:', "if False:",
             "H-01, H-14: a track is taken where it was received, not at its place"),
    hardened("gap-without-a_max", "hardened.py", "float(rule.stop.s_stop)",
             'float(rule.stop.v**2 / (2 * rule.stop.a_b)) + cycle["ego"]["speed"] * cycle["parameters"]["tau"]',
             "H-04: s_react without a_max, as if the CAV kept its speed for tau"),
    hardened("unknown-is-free", "closed_cells.py",
             '[grid["occupied"]] if detections else [grid["occupied"], grid["unknown"] or b""]',
             '[grid["occupied"]]', "H-06: unknown cells count as free"),
    hardened("covered-by-a-metre", "closed_cells.py", "0.25 - EPS", "1.0",
             "H-06: a detection leaves out what is within 1 m of it, in place of 1/4 m"),
    hardened("against-the-lane", "hardened_ii.py", "        if any(between(a, b, p)[0] < EPS",
             "        if False and any(between(a, b, p)[0] < EPS",
             "H-07: a heading against the lane is accepted"),
    hardened("runs-ahead", "hardened_ii.py", 'for p in cycle["trajectory"]["points"])', 'for p in [first])',
             "H-07: the first point alone is asked where it is at its time"),
    hardened("stop-at-confirmation", "offloading.py",
             "            if not self.hardened:\n                self.stop_local(g)",
             "            self.stop_local(g)",
             "H-08: local services stop at the confirmation", "offloading"),
    hardened("second-too-old", "detection_history.py", "if S // 5 <= age_ns <= S and",
             "if S // 5 <= age_ns < S and", "H-14: a list of exactly 1 s ago is not used"),
    hardened("unexplained-stands", "detection_history.py",
             " or came(detection, item, self.reference)", "",
             "H-14: what is unexplained, or was seen to come from an item, did not move"),
    hardened("explained-moves", "detection_history.py", "if self.may_stand(detection, item) or came",
             "if d in unexplained if self.may_stand(detection, item) else came",
             "H-14: what is explained does not stand, however near it was before"),
    hardened("explains-nothing", "detection_history.py",
             'asked = now["tracks"] or cycle["configuration"] != "PlanRemote"',
             'asked = cycle["configuration"] != "PlanRemote"',
             "H-14: in PlanRemote the CAV's own tracks explain no detection"),
    hardened("window-from-its-place", "fail_safe.py", "self.stop.first(max(least, 0))",
             "self.stop.first(max(place.progress, 0))",
             "H-14: a window begins at the first time at its place, not at the place before it"),
    hardened("tyres-hold-a_b", "stopping.py", 'max(parameters["a_b"], 11.5)', 'parameters["a_b"]',
             "H-14: no vehicle is taken to brake harder than a_b"),
    hardened("brakes-from-the-mean", "fail_safe.py", "(dt_ns or 0) / S / 2", "0",
             "H-14: of two lists an object is taken to have the mean speed between them, however hard it braked"),
    hardened("gap-of-now", "hardened.py", "s_react + s_since + EPS", "s_react + EPS",
             "H-04: the gap to a lead is taken for that of now"),
    hardened("grid-as-wide-as-the-cav", "hardened.py", "rule.places, rule.a)", "rule.places, 0)",
             "H-14.27: in the grid a CAV beside its plan is as wide as on it"),
    hardened("supports-on-the-mean-alone", "detection_history.py",
             'bound, a = max(self.parameters["theta_track_max"], NEAR), a_tyre(self.parameters)',
             'bound, a = max(self.parameters["theta_track_max"], NEAR), 0',
             "SEEN-16: a list supports a pair within theta_track_max of its mean motion, however hard it braked"),
    hardened("window-to-progress", "fail_safe.py", "self.stop.last(after.length) if",
             "self.stop.last(max(after.progress, 0)) if",
             "H-14: a window ends at the last time of the progress, not of the length"),
    hardened("progress-along-headings", "fail_safe.py", "progress, length = ahead(x, y, ego),",
             "progress, length = o.progress + max(ahead(*step[:2], heading), 0),",
             "H-14: the progress counts along the headings of the pieces, not along that of the CAV"),
    hardened("no-last-place", "fail_safe.py",
             "return [*places, Place(x, y, s_stop, o.length + part * step[2], heading)]",
             "return places", "H-14: the place where the progress is s_stop is left out"),
    hardened("follows-beside", "fail_safe.py", "self.is_behind and self.comes_across",
             "self.is_behind", "H-14: who is behind and goes along within 45 degrees follows, whether it "
             "comes across the CAV or not"),
    hardened("goes-anywhere", "fail_safe.py", "self.speed * (0.05 + away / 30) - EPS", "self.speed",
             "H-14: who follows or keeps beside the path need not go along"),
    hardened("drift-ignored", "beside.py",
             "abs(float(motion.w[0]) * x + float(motion.w[1]) * y) / D", "0.0",
             "H-14: who is beside the path keeps beside it, whether it drifts there or not"),
    hardened("ends-of-a-truck", "beside.py", " - ERROR - sagitta", " - ERROR",
             "H-14.42: the ends of a long object beside a bend are no nearer than its middle"),
    hardened("comes-to-its-lane", "beside.py", " and self.comes_no_nearer(at, line, D)", "",
             "H-14.43: who keeps to its lane keeps beside a CAV that comes to it, too"),
    hardened("crosses-the-path", "beside.py", "[math.copysign(1, across)]", "[1]",
             "H-14.43: a CAV that crosses the reference path comes no nearer to who is beside it"),
    hardened("beyond-the-end", "beside.py", 'if self.route["closed"]:', "if True:",
             "H-14: who is beyond an end of the route keeps beside the path, too"),
    hardened("route-turns-off", "beside.py", "if not self.route_bends[aside <= -ahead - EPS]:", "if False:",
             "H-14: who goes along keeps beside the path where the route turns off near the CAV, too"),
    hardened("comes-from-the-side", "beside.py", "aside <= -ahead - EPS", "ahead <= -EPS",
             "H-14: who crosses at more than 45 degrees comes towards the CAV in a bend, too"),
    hardened("lies-across", "beside.py", "D > 20 - ERROR or self.lies_across(motion)", "D > 20 - ERROR",
             "H-14: whose centre is beside the route keeps beside, though its end is where the path leads"),
    hardened("on-another-road", "beside.py", "D > 20 - ERROR or self.lies_across(motion)",
             "self.lies_across(motion)", "H-14: who is far from the route keeps beside, too"),
    hardened("age-left-out", "fail_safe.py", 'cycle["now_ns"] - stamp_ns, parameters', "0, parameters",
             "H-14: objects move from now on, not from the time of their list"),
    hardened("yields-at-once", "fail_safe.py",
             'parameters["t_yield"] + self.speed / (2 * parameters["a_yield"])', "0.0",
             "H-14: whoever meets the CAV after T can stop"),
    hardened("inner-at-speed", "fail_safe.py", 'min(0.3, self.ego["speed"]**2 / (2 * self.a_b))', "0.0",
             "H-14: who touches a side of the CAV comes across it at any speed"),
    hardened("shared-confirms", "detection_history.py",
             "self.detection[i] is None or shared[self.detection[i]] > 1:", "self.detection[i] is None:",
             "SEEN-10: a track is confirmed by a detection that is another track's, too"),
    hardened("any-heading-confirms", "detection_history.py",
             'return self.compare(across, self.parameters["theta_velocity"] + speed(track) / 10)', "return True",
             "SEEN-11: a track need not move along its detection"),
    hardened("along-from-1-m", "detection_history.py", 'detection["length"] <= 1:', 'detection["length"] < 1:',
             "SEEN-11: a track moves along a detection of exactly 1 m, too"),
    hardened("backed-confirms", "detection_history.py", "self.is_confirmed(i, shared) for i in",
             "self.backed[i] and self.detection[i] is not None for i in",
             "SEEN-10: what is backed and has a detection is confirmed"),
    hardened("old-lists-explain", "detection_history.py", "self.explained = {self.detection[i] for i in self.sure}",
             "self.explained = {self.detection[i] for i, sure in enumerate(self.confirmed) if sure}",
             "SEEN-13: tracks of a list that is not current explain detections"),
    hardened("origin-of-several", "detection_history.py",
             "            [one for one, own in zip(self.lists, self.own) if own[i] is not None])",
             "            [one for one in self.lists if self.origin(i, one) is not None])\n\n"
             "    def origin(self, i, one):\n"
             '        t, reach = self.shift - one["dt"], self.reach(one)\n'
             '        return self.nearest(one["items"], self.tracks[i], t, reach)',
             "SEEN-12: the list of a track may hold an origin that is another track's, too"),
    hardened("older-than-60-s", "detection_history.py",
             'if S // 5 <= age_ns <= S and cycle["now_ns"] - one["stamp_ns"] <= 60 * S:', "if S // 5 <= age_ns <= S:",
             "SEEN-01: a list of more than 60 s ago is usable"),
    hardened("seen-by-one-list", "detection_history.py", "all(self.borne_out(detection, item, one, NEAR, a))",
             "any(self.borne_out(detection, item, one, NEAR, a))",
             "SEEN-17: one other list is enough to show where what is explained came from"),
    hardened("shown-on-the-mean-alone", "detection_history.py",
             "        a = a_tyre(self.parameters)\n", "        a = 0\n",
             "SEEN-17: what is explained was seen to come within 0.3 m of its mean motion alone, "
             "however hard it braked"),
    hardened("left-out-at-0", "hardened.py", "0.0 if seen.backed[i] else",
             'EPS - parameters["theta_tr"] if seen.backed[i] else',
             "H-01: a track that is left out counts in the mean, with distance 0"),
    hardened("places-by-quarters", "fail_safe.py", 'min(Fraction(1, 4), Fraction(ego["length"]))', "Fraction(1, 4)",
             "H-14: places are 1/4 m apart for a CAV that is shorter, too"),
    hardened("road-at-points-only", "hardened.py", " and on_the_road(cycle, rule.places)", "",
             "H-14: the corridor is not asked at the places"),
    hardened("aside-unasked", "fail_safe.py", "point)) for point in parted(self.cycle)[0]]", "point)) for point in []]",
             "H-14: points of the trajectory that are no nodes are not asked for reach"),
    hardened("goes-back", "fail_safe.py", "if self.goes_back() or self.comes_back():", "if self.comes_back():",
             "H-14: points of the trajectory that are no nodes may lead back behind the CAV"),
    hardened("comes-back", "fail_safe.py", "if self.goes_back() or self.comes_back():", "if self.goes_back():",
             "H-14: the path may lead back, or come back to where the CAV may be"),
    hardened("stays-away", "fail_safe.py", "if was_far and from_origin(way) < near + EPS or part", "if part",
             "H-14: the path may come back to where the CAV may be, as far ahead as before"),
    hardened("heading-of-places", "fail_safe.py", "for place in self.places[1:]:\n", "for place in []:\n",
             "H-14: the heading of a place is not asked"),
    hardened("forward-at-first", "hardened_ii.py", "if min(along_a, along_b) <", "if along_a <",
             "H-11: a step has to go forward by its first heading alone"),
    hardened("forward-at-last", "hardened_ii.py", "if min(along_a, along_b) <", "if along_b <",
             "H-11: a step has to go forward by its second heading alone"),
    hardened("touched-at-rest", "fail_safe.py", "any(motion.meets(cav, pose, begins, latest if ends is None else ends)",
             'any(motion.meets(cav if ends else {**cav, "length": cav["length"] - 4 * EPS, "width": cav["width"] - 4 * EPS},\n'
             "                                 pose, begins, latest if ends is None else ends)",
             "H-14: who only touches the CAV where it may stand does not meet it"),
    hardened("seen-in-ms", "fail_safe.py", 'self.age_ns, self.a_b = cycle["now_ns"] - stamp_ns,',
             'self.age_ns, self.a_b = (cycle["now_ns"] - stamp_ns) // 10**6 * 10**6,',
             "H-14: the age of a list in whole ms"),
    hardened("stood-in-some-list", "detection_history.py", "return len(self.lists) > 1 and all(",
             "return len(self.lists) > 1 and any(",
             "SEEN-18, H-14: what is where some usable list has an item has stood"),
    hardened("never-came-evenly", "detection_history.py",
             "\n                or self.moved_evenly(detection, item, one)]", "]",
             "SEEN-19, H-14: what stood came from nowhere else, seen to move or not"),
    hardened("evenly-in-some-list", "detection_history.py",
             "return all(self.borne_out(detection, item, one, NEAR, 0))",
             "return any(self.borne_out(detection, item, one, NEAR, 0))",
             "SEEN-19: what one other list bears out moved evenly"),
    hardened("no-end-by-distance", "fail_safe.py", " or x**2 + y**2 > farthest**2", "",
             "H-14: the path does not end where it is farther from the CAV than that can be"),
    monitor("tracks-without-look", """ and (
                self.is_current(cycle["detections"], now_ns)):""", ":",
            "MON-02: tracks come out of a cycle in which stage i did not run", "paper"),
    monitor("trajectory-without-look", """ and (
                not self.hardened or self.is_current(cycle["detections"], now_ns)):""", ":",
            "MON-66: a trajectory comes out of a cycle without current detections"),
    monitor("older-used", '        used_ns = slot["used_ns"]\n',
            '        used_ns, slot["element"] = slot["used_ns"], content\n',
            "MON-07, MON-08: an element that was repeated, or is older than the last, is used"),
    monitor("errors-unheard", '"verdict": "safe" if is_safe else "unsafe"})\n',
            '"verdict": "unsafe" if stage else "safe"})\n',
            "MON-10: the requester does not hear of a cycle with an error"),
    monitor("looked-at-is-used", 'if out.get(key) and out[key]["station"]}', "if is_safe and remote[g]}",
            "MON-11: the verdict names every running session"),
    monitor("stale-by-0", 'now_ns - content["stamp_ns"] > self.max_age_ns',
            'now_ns - content["stamp_ns"] >= self.max_age_ns',
            "MON-30: an element that is exactly max_age old at its arrival is dropped"),
    monitor("starves-at-once", '> self.parameters["dt_max_ns"]:\n            slot["starved"]',
            '>= self.parameters["dt_max_ns"]:\n            slot["starved"]',
            "MON-31: a group starves after exactly dt_max"),
    monitor("starved-arrives", '                return "starved", self.requester.drop(g)',
            '                slot["arrival_ns"] = now_ns\n                return "starved", self.requester.drop(g)',
            "MON-32: the elements of a starved group count as arrivals"),
    monitor("unseen-counts", "if in_time and is_seen:", "if in_time:",
            "MON-69: a cycle without current detections counts"),
    monitor("eightfold", "left = 9 *", "left = 8 *", "MON-34: eight times the time without use"),
    monitor("no-period", 'max(self.now_ns - slot["since_ns"], self.period_ns)',
            'self.now_ns - slot["since_ns"]', "MON-35: the time without use may be below a period"),
    monitor("used-to-the-end", 'slot["since_ns"] - slot["first_ns"]', 'self.now_ns - slot["first_ns"]',
            "MON-36: the time of use goes on to the return"),
    monitor("set-back", "self.cycle_ns is None or self.cycle_ns <= self.tick_ns", "True",
            "MON-45: a tick before the cycle before is in time"),
    monitor("hold-shortened", "self.hold_until_ns = until_ns if old_ns is None else max(old_ns, until_ns)",
            "self.hold_until_ns = until_ns", "MON-38: a hold ends with the last wait, not the latest"),
    monitor("tau-rounded-up", 'math.floor(self.parameters["tau"] * 1e9)',
            'math.ceil(self.parameters["tau"] * 1e9)', "MON-40: brake_by is rounded up"),
    monitor("brake-by-in-paper", "if self.hardened and trajectory:", "if trajectory:",
            "MON-41: the paper profile names a time to brake by", "paper"),
    monitor("hold-of-nothing", "self.requester.hold_to(now_ns + 1)", "self.requester.hold_to(now_ns)",
            "MON-44: the hold ends at the tick, not 1 ns after it"),
    monitor("tick-in-time", '0 <= now_ns - self.tick_ns <= self.times["dt_max_ns"]',
            '0 <= now_ns - self.tick_ns < self.times["dt_max_ns"]',
            "MON-45: a tick exactly dt_max before the cycle is not in time"),
    monitor("invalid-not-braked", "if error is not None or stage == \"input\":", "if stage == \"input\":",
            "MON-50: own data that are invalid do not make control brake"),
    monitor("missing-not-braked", 'self.said = {"missing": "trajectory"}', "self.said = None",
            "MON-51: the CAV without a plan of its own does not brake"),
    monitor("stall-late", 'self.remote_ns >= self.stall["time_ns"]', 'self.remote_ns > self.stall["time_ns"]',
            "MON-54: PLAN is given back after the time, not at it"),
    monitor("given-back-unheld", "            self.requester.hold_to(now_ns + self.times[\"t_wait_ns\"])\n", "",
            "MON-58: PLAN is asked for again at once"),
    monitor("age-of-l-max", 'parameters["max_age_ns"] < times["l_max_ns"]',
            'parameters["max_age_ns"] <= times["l_max_ns"]', "MON-26: max_age that is l_max is refused"),
    monitor("numbered-from-0", "self.sessions, self.now_ns = period_ns, last_session, 0",
            "self.sessions, self.now_ns = period_ns, 0, 0", "MON-28: sessions are numbered from 0"),
    cpp("off-by-one-lane", "stage ii: the last segment of route and corridor is left out",
        ("  return std::all_of(c.trajectory->", "  pairs.pop_back();\n  return std::all_of(c.trajectory->")),
    cpp("route-kept", "stage ii: a route is kept under its number of cross sections and first x",
        ("  Pairs pairs;\n", "  static std::map<std::pair<std::size_t, double>, Pairs> routes;\n"
         "  Pairs& pairs = routes[{c.stations.size(), c.stations[0].x}];\n"
         "  const bool is_new = pairs.empty();\n"),
        ("i + 1 < c.stations.size(); ++i)", "is_new && i + 1 < c.stations.size(); ++i)"),
        ("  if (c.closed) pairs", "  if (c.closed && is_new) pairs")),
    cpp("never-before", "stage iii: a negative time of prediction counts as 0",
        ("double t = double(point.t_ns - c.tracks->stamp_ns) / 1e9;",
         "double t = std::max(double(point.t_ns - c.tracks->stamp_ns) / 1e9, 0.0);")),
    cpp("missing-skip", "stage iv runs although stage iii ran",
        ("bool ran_iv = detections && !ran_iii;", "bool ran_iv = detections;")),
    cpp("border-left-out", "stage i: a track as far off as the farthest detection is not assigned",
        ("    else if (d <= r + kEps) border.push_back(item);\n", "")),
    cpp("nan-accepted", "what is refused is value < least or value > most, and NaN is neither",
        ("if (!(least <= value && value <= most))", "if (value < least || value > most)"),
        ("if (!is_direction(p.cos, p.sin))",
         "if (!is_direction(p.cos, p.sin) && !std::isnan(p.cos + p.sin))"), file="record.hpp"),
    cpp("times-in-ms", "stage iii: the time of prediction in whole ms",
        ("double t = double(point.t_ns - c.tracks->stamp_ns) / 1e9;",
         "double t = double((point.t_ns - c.tracks->stamp_ns) / 1000000) / 1e3;")),
    cpp("times-in-us", "stage iii: the time of prediction in whole us",
        ("double t = double(point.t_ns - c.tracks->stamp_ns) / 1e9;",
         "double t = double((point.t_ns - c.tracks->stamp_ns) / 1000) / 1e6;")),
    cpp("safe-above-200-points", "a trajectory of more than 200 points is safe",
        ('  if (!stage_ii(c)) return "ii";', '  if (c.trajectory->items.size() > 200) return "";\n  if (!stage_ii(c)) return "ii";')),
    cpp("tracks-beyond-100", "stage iii: tracks from the 101st on are left out",
        ("    for (auto& item : c.tracks->items)\n      if (collides(c, point, item, item.vx",
         "    for (auto& item : c.tracks->items)\n      if (&item - &c.tracks->items[0] < 100 && collides(c, point, item, item.vx")),
    cpp("gives-up-at-1000-sections", "stage ii fails on a route of more than 1000 cross sections",
        ("  Pairs pairs;\n  for", "  Pairs pairs;\n  if (c.stations.size() > 1000) return false;\n  for")),
    javascript("integers-rounded", "times and ids are read as doubles",
               ('JSON.parse(line.replace(tokens, (it) => (/^-?\\d{16,}$/.test(it) ? `"${it}"` : it)))',
                "JSON.parse(line)"), file="record.mjs"),
    javascript("never-closed", "stage ii: a closed route has no segment from its end to its start",
               ("if (closed) pairs.push", "if (false) pairs.push")),
    javascript("last-route-kept", "stage ii: the route of the cycle before is taken for this one when "
               "their number of cross sections, first and last are equal",
               ("function segments({ stations, closed }) {\n",
                "let kept = {};\nfunction segments({ stations, closed }) {\n"
                "  const key = JSON.stringify([stations.length, stations[0], stations.at(-1)]);\n"
                "  if (kept.key === key) return kept.pairs;\n"),
               ("  return pairs;\n", "  kept = { key, pairs };\n  return pairs;\n")),
    javascript("touching-is-free", "rectangles that only touch do not collide, and no margin",
               ("[[pose, ego, EPS]", "[[pose, ego, 0]"),
               ("<= reach.reduce", "< reach.reduce")),
    javascript("rows-padded", "stage v: each row of a bitmap begins with a byte",
               ("const index = 8 * at + bit;", "const padded = 8 * Math.ceil(width / 8);\n"
                "      const at0 = 8 * at + bit, index = at0 % padded + width * Math.floor(at0 / padded);")),
    *floats(),
]


def seed(bug, sources, folder):
    """Writes the sources with the bug to a folder."""
    for source in sources:
        text = source.read_text()
        for file, old, new in bug.changes:
            if file == source.name:
                if text.count(old) != 1:
                    raise ValueError(f"{bug.name}: {file} has {text.count(old)} times: {old}")
                text = text.replace(old, new)
        (folder / source.name).write_text(text)
