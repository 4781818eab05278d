"""Answers the record `monitor`: spec/monitor.md, on the requester of offloading.py.

A sequence whose settings are refused is an error. Places in invalid input and witnesses are not
named.
"""
import math
from fractions import Fraction

from offloading import EVENTS, GROUPS, Requester, read_event
from record import (I64_MAX, INPUTS, PARAMETERS, TIMES, Broken, Invalid, check_input, check_item,
                    check_route, choice, fields, integer, listed, number, read_ego,
                    read_parameters, read_route)

MS, S = 10**6, 10**9
LISTS, APART = 12, 83_333_334  # of the history of detections
TARGETS = (300 * MS, 500 * MS, 800 * MS)
MEMORY = {"tracks": 1024, "detections": 2048, "cross_sections": 8192}
CONTENTS = {"tracks": "mot", "trajectory": "plan"}


class Waiting(Requester):
    """The requester, with the wait after a session (MON-34 to MON-39)."""

    def __init__(self, parameters, hardened, period_ns, last_session):
        super().__init__(parameters, hardened)
        self.period_ns, self.sessions, self.now_ns = period_ns, last_session, 0

    def hold_to(self, until_ns):
        until_ns, old_ns = min(until_ns, I64_MAX), self.hold_until_ns
        self.hold_until_ns = until_ns if old_ns is None else max(old_ns, until_ns)

    def leave(self, g, release=True):
        slot = self.group[g]
        if slot["state"] == "remote":
            use = 0 if slot["first_ns"] is None else slot["since_ns"] - slot["first_ns"]
            left = 9 * max(self.now_ns - slot["since_ns"], self.period_ns) - use
            if left > 0:
                self.hold_to(self.now_ns + left)
        super().leave(g, release)

    def confirm(self, now_ns, event, named):
        slot = self.group[event["group"]]
        old = slot["state"]
        super().confirm(now_ns, event, named)
        if old == "requested" and slot["state"] == "remote":
            slot.update(since_ns=now_ns, first_ns=None, starved=False, element=None)

    def looked_at(self, g, now_ns, is_current):
        """The table of the waits, for a cycle that counts. When starving ends, elements count as
        arrivals again; the last arrival stays the one before it starved."""
        slot = self.group[g]
        if is_current:
            first_ns = now_ns if slot["first_ns"] is None else slot["first_ns"]
            slot.update(since_ns=now_ns, first_ns=first_ns, starved=False)
        elif now_ns - slot["since_ns"] > self.parameters["dt_max_ns"]:
            slot["starved"] = True


class Monitor:
    def __init__(self, settings, failed_stage):
        self.__dict__.update(settings)
        self.failed_stage, self.hardened = failed_stage, self.profile == "hardened"
        self.max_age_ns = self.parameters["max_age_ns"]
        self.requester = Waiting(self.times, self.hardened, self.period_ns, self.last_session)
        self.group = self.requester.group
        self.kept, self.tick_ns, self.cycle_ns, self.said = [], None, None, None
        self.given_back_ns, self.mark, self.remote_ns = None, (0.0, 0.0), 0
        self.planned_ns = None  # the last cycle, where PLAN was remote after it

    def is_remote(self, g):
        return self.group[g]["state"] == "remote"

    def is_current(self, element, now_ns):
        return element is not None and 0 <= now_ns - element["stamp_ns"] <= self.max_age_ns

    def step(self, event):
        now_ns, kind = event["t_ns"], event["type"]
        self.requester.now_ns, dropped, decision = now_ns, None, None
        if kind in CONTENTS:
            dropped, state = self.data(now_ns, event)
        elif kind == "tick":
            state = self.tick(now_ns, event)
        elif kind == "cycle":
            decision, state = self.cycle(now_ns, event["measured"])
        else:
            state = self.requester.step(event)
        return {**state, "dropped": dropped, "given_back_ns": self.given_back_ns,
                "decision": decision}

    # Data: MON-07 to MON-09, MON-20, MON-30, MON-32.

    def data(self, now_ns, event):
        g, content = CONTENTS[event["type"]], event[event["type"]]
        slot, times = self.group[g], self.times
        if not self.is_remote(g) or (
                (slot["station"], slot["session"]) != (event["station"], event["session"])):
            return "other_session", self.requester.drop(g)
        if g == "mot" and len(content["items"]) > self.memory["tracks"]:
            return "does_not_fit", self.requester.drop(g)
        if 0 <= now_ns - event["generated_ns"] <= times["l_max_ns"]:
            if now_ns - content["stamp_ns"] > self.max_age_ns:
                return "stale", self.requester.drop(g)
            if slot["starved"]:
                return "starved", self.requester.drop(g)
        used_ns = slot["used_ns"]
        state = self.requester.step({**event, "type": "data", "group": g})
        if not self.is_remote(g):
            return "late", state
        if used_ns is not None and event["generated_ns"] <= used_ns:
            return "repeated" if event["generated_ns"] == used_ns else "older", state
        slot["element"] = content
        return None, state

    # Ticks: MON-43 to MON-45, MON-54 to MON-59.

    def tick(self, now_ns, event):
        self.tick_ns = now_ns
        seen = any(S // 2 <= now_ns - one["stamp_ns"] <= S for one in self.kept)
        if self.hardened and not seen:
            self.requester.hold_to(now_ns + 1)
        stalls = self.stall and self.is_remote("plan") and self.remote_ns >= self.stall["time_ns"]
        if stalls:
            self.given_back_ns, self.remote_ns = now_ns, 0
            self.requester.hold_to(now_ns + self.times["t_wait_ns"])
        return self.requester.step({**event, "give_back": ["plan"] if stalls else []})

    def gets_nowhere(self, now_ns, ego, was_ns):
        """The remote time of a cycle, after it (MON-55, MON-56)."""
        if ego is not None:
            way = [Fraction(ego[key]) - Fraction(at) for key, at in zip(("x", "y"), self.mark)]
            if way[0]**2 + way[1]**2 > Fraction(self.stall["way"])**2:
                self.mark, self.remote_ns = (ego["x"], ego["y"]), 0
        self.planned_ns = now_ns if self.is_remote("plan") else None
        if was_ns is not None and self.planned_ns is not None:
            self.remote_ns += max(now_ns - was_ns, 0)

    # Cycles.

    def cycle(self, now_ns, measured):
        remote = {g: self.is_remote(g) for g in GROUPS}
        elements = {g: self.group[g]["element"] for g in GROUPS if remote[g]}
        in_time = self.tick_ns is not None and (
            0 <= now_ns - self.tick_ns <= self.times["dt_max_ns"]
            and (self.cycle_ns is None or self.cycle_ns <= self.tick_ns))
        self.tick_ns, self.cycle_ns = None, now_ns
        is_seen = not self.hardened or self.is_current(measured["detections"], now_ns)
        for g in elements:
            if in_time and is_seen:  # MON-69
                self.requester.looked_at(g, now_ns, self.is_current(elements[g], now_ns))
        cycle = {**measured, "profile": self.profile, "parameters": self.parameters,
                 "now_ns": now_ns, "route": self.route,
                 "configuration": {(False, False): "Local", (True, False): "MotRemote",
                                   (True, True): "AllRemote",
                                   (False, True): "PlanRemote"}[remote["mot"], remote["plan"]],
                 "detection_history": self.history(measured["detections"])}
        for key, g in CONTENTS.items():
            if remote[g]:
                cycle[key] = elements[g]
        stage, error = self.judged(cycle)
        if error is None:
            self.keep(now_ns, measured["detections"])
            if elements and not in_time:
                stage, error = None, {"field": "tick", "index": None}
        is_safe = stage is None and error is None
        out = self.outcome(cycle, remote, elements) if is_safe else {}
        sessions = {g: self.group[g]["session"] for key, g in CONTENTS.items()
                    if out.get(key) and out[key]["station"]}
        was_ns, is_valid = self.planned_ns, error is None or error.get("field") == "tick"
        state = self.requester.step({"type": "verdict", "t_ns": now_ns, "sessions": sessions,
                                     "verdict": "safe" if is_safe else "unsafe"})
        if self.stall:
            self.gets_nowhere(now_ns, measured["ego"] if is_valid else None, was_ns)
        decision = {"verdict": "safe" if is_safe else "unsafe", "failed_stage": stage}
        if error is not None:
            decision["error"] = error
        trajectory = out.get("trajectory")
        brake_by_ns = None
        if self.hardened and trajectory:
            brake_by_ns = min(now_ns + math.floor(self.parameters["tau"] * 1e9), I64_MAX)
        return {**decision, "tracks": out.get("tracks"), "trajectory": trajectory,
                "brake_by_ns": brake_by_ns, "brake": self.brake(cycle, measured, trajectory)}, state

    def judged(self, cycle):
        """The failed stage and the error of a cycle."""
        cycle, detections = dict(cycle), cycle["detections"]
        try:
            own = cycle["tracks"] if cycle["configuration"] in ("Local", "PlanRemote") else None
            kept = detections if self.hardened else None
            for it, places in ((kept, "detections"), (own, "tracks")):  # MON-19, MON-65
                if it and len(it["items"]) > self.memory[places]:
                    raise Invalid
            if not check_input(cycle):
                return "input", None
        except Invalid:
            return None, {}
        return None if cycle["configuration"] == "Local" else self.failed_stage(cycle), None

    def outcome(self, cycle, remote, elements):
        """What comes out of a safe cycle (MON-01 to MON-05, MON-66)."""
        def verified(element, g):
            slot = self.group[g] if remote[g] else {"station": 0, "session": None}
            return {"stamp_ns": element["stamp_ns"], "station": slot["station"],
                    "session": slot["session"]}
        now_ns, out = cycle["now_ns"], {}
        if not elements:
            return out
        # Stage i runs where tracks are there and the detections are current.
        if remote["mot"] and self.is_current(cycle["tracks"], now_ns) and (
                self.is_current(cycle["detections"], now_ns)):
            out["tracks"] = verified(cycle["tracks"], "mot")
        if self.is_current(cycle["trajectory"], now_ns) and (
                not self.hardened or self.is_current(cycle["detections"], now_ns)):
            out["trajectory"] = verified(cycle["trajectory"], "plan")
        return out

    def brake(self, cycle, measured, trajectory):
        """MON-47 to MON-52."""
        if not self.supervise_local:
            return None
        if self.is_remote("mot") or self.is_remote("plan"):
            self.said = None if trajectory else self.said
            return self.said
        self.said, own = None, measured["trajectory"]
        history = self.history(measured["detections"])
        stage, error = self.judged({**cycle, **measured, "configuration": "PlanRemote",
                                    "detection_history": history})
        if error is not None or stage == "input":
            self.said = {"input": {}}
        elif stage is not None:
            self.said = {"failed_stage": stage}
        elif not self.is_current(own, cycle["now_ns"]):
            self.said = {"missing": "trajectory"}
        return self.said

    # The history of detections: MON-12 to MON-17.

    def history(self, detections):
        if detections is None:
            return []
        usable = [one for one in self.kept
                  if S // 5 <= detections["stamp_ns"] - one["stamp_ns"] <= S]
        chosen = {}
        for target in TARGETS if usable else ():
            best = min(usable, key=lambda one: (
                abs(detections["stamp_ns"] - one["stamp_ns"] - target), -one["stamp_ns"]))
            chosen[best["stamp_ns"]] = best
        return [chosen[stamp_ns] for stamp_ns in sorted(chosen, reverse=True)]

    def keep(self, now_ns, detections):
        if not self.hardened or not self.is_current(detections, now_ns):
            return
        younger = detections["stamp_ns"] - self.kept[0]["stamp_ns"] if self.kept else APART
        if younger < -S:
            self.kept = [detections]
        elif younger >= APART:
            self.kept = [detections, *self.kept][:LISTS]


# The record: spec/5-interfaces.md#monitor.


def read_measured(value):
    fields(value, ["ego"], ["trajectory", "tracks", "detections", "lead", "grid"])
    return {"ego": read_ego(value["ego"]), **{
        key: None if value.get(key) is None else INPUTS[key](value[key])
        for key in ("trajectory", "tracks", "detections", "lead", "grid")}}


def read_monitor_event(value):
    if not isinstance(value, dict):
        raise Broken
    kind = choice(value.get("type"), (*(set(EVENTS) - {"data", "verdict"}), *CONTENTS, "cycle"))
    if kind == "cycle":
        fields(value, ["t_ns", "type", "measured"])
        integer(value["t_ns"])
        return {**value, "measured": read_measured(value["measured"])}
    if kind in CONTENTS:
        fields(value, ["t_ns", "type", "station", "session", "generated_ns", kind])
        for key in ("t_ns", "station", "session", "generated_ns"):
            integer(value[key])
        if value["station"] < 1:
            raise Broken
        return {**value, kind: INPUTS[kind](value[kind])}
    return read_event(value)


def read_settings(record):
    given = record.get("parameters", {})
    fields(given, [], [*PARAMETERS, *TIMES, "qos_hold"])
    qos_hold = given.get("qos_hold", False)
    defaults = {key: default for key, (default, _) in PARAMETERS.items()}
    parameters = read_parameters(
        {key: value for key, value in given.items() if key != "qos_hold"}, defaults)
    times = {**TIMES, **{key: given[key] for key in TIMES if key in given}, "qos_hold": qos_hold}
    if not isinstance(qos_hold, bool) or not isinstance(record.get("supervise_local", False), bool):
        raise Broken
    stall, memory = record.get("stall"), record.get("memory", MEMORY)
    if stall is not None:
        fields(stall, ["way", "time_ns"])
        stall = {"way": number(stall["way"]), "time_ns": integer(stall["time_ns"])}
    if any(integer(places) < 0 for places in fields(memory, list(MEMORY)).values()):
        raise Broken
    return {"profile": choice(record.get("profile", "hardened"), ("paper", "hardened")),
            "parameters": parameters, "times": times, "period_ns": integer(record["period_ns"]),
            "last_session": integer(record.get("last_session", 0)), "stall": stall,
            "supervise_local": record.get("supervise_local", False), "memory": memory,
            "route": read_route(record["route"])}


def check_settings(settings):
    """MON-18, MON-21 to MON-29, MON-60, MON-62."""
    parameters, times, stall = settings["parameters"], settings["times"], settings["stall"]
    period_ns, last = settings["period_ns"], settings["last_session"]
    check_item(parameters, {key: domain for key, (_, domain) in PARAMETERS.items()})
    cross_sections = settings["route"]["stations"]
    check_route(cross_sections)
    short = (period_ns, parameters["max_age_ns"], parameters["step_max_ns"],
             *(times[key] for key in TIMES))
    refused = [
        times["dt_max_ns"] <= period_ns,
        period_ns <= 0,
        any(0 < it < MS for it in short),
        0 < times["t_wait_ns"] < S,
        parameters["max_age_ns"] < times["l_max_ns"],
        settings["profile"] == "hardened" and parameters["tau"] <= period_ns / 1e9,
        not 0 <= last < I64_MAX,
        stall is not None and not (0 <= stall["way"] < math.inf and stall["time_ns"] >= S),
        settings["memory"]["tracks"] == 0,
        settings["profile"] == "hardened" and settings["memory"]["detections"] == 0,
        len(cross_sections) > settings["memory"]["cross_sections"]]
    if any(refused):
        raise Invalid


def answer_monitor(record, failed_stage):
    fields(record, ["kind", "id", "period_ns", "route", "events"],
           ["profile", "parameters", "last_session", "supervise_local", "stall", "memory"])
    settings, events = read_settings(record), listed(record["events"], read_monitor_event)
    if len(events) > 10_000:
        raise Broken
    try:
        check_settings(settings)
    except Invalid:
        return {"verdict": "error", "failed_stage": None}
    monitor = Monitor(settings, failed_stage)
    return {"states": [monitor.step(event) for event in events]}
