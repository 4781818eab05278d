"""Answers the record `offloading`: the requester of spec/2-offloading.md.

In the paper profile the local services of a group stop at the confirmation, in the hardened profile
(H-08, make before break) at the first safe verdict on data of the session: until then they compute
as well, and leaving the session activates nothing.
"""
from record import I64_MAX, TIMES, Broken, choice, fields, integer, listed

GROUPS = ("mot", "plan")


class Requester:
    def __init__(self, parameters, hardened):
        self.hardened = hardened
        self.parameters, self.hold_until_ns, self.sessions = parameters, None, 0
        self.group = {g: {"state": "local"} for g in GROUPS}
        self.offers, self.asked, self.area = {}, {}, set(GROUPS)

    def later(self, now_ns, key):
        return min(now_ns + self.parameters[key], I64_MAX)

    def leave(self, g, release=True):
        old, self.group[g] = self.group[g], {"state": "local"}
        if old["state"] != "local" and release:
            self.release(g, old["station"], old["session"])
        if old.get("stopped"):
            self.do(2, g, {"activate": g})

    def stop_local(self, g):
        self.group[g]["stopped"] = True
        self.do(2, g, {"deactivate": g})

    def release(self, g, station, session):
        self.do(1, g, {"send": "release", "station": station, "group": g, "session": session})

    def do(self, order, g, action):
        self.actions.append((order, GROUPS.index(g), action))

    def hold(self, now_ns):
        until_ns, old_ns = self.later(now_ns, "t_wait_ns"), self.hold_until_ns
        self.hold_until_ns = until_ns if old_ns is None else max(old_ns, until_ns)

    def violate(self, g, now_ns):
        self.leave(g)
        if self.parameters["qos_hold"]:
            self.hold(now_ns)

    def offer(self, station, groups, release=True):
        self.offers[station] = groups
        for g in GROUPS:
            if self.group[g].get("station") == station and g not in groups:
                self.leave(g, release)

    def tick(self, now_ns, give_back=()):
        """A monitor gives groups back before a tick; a trace does not."""
        returned = set()
        for g in give_back:
            self.leave(g)
        for g in GROUPS:
            if self.group[g]["state"] == "requested" and now_ns >= self.group[g]["deadline_ns"]:
                self.leave(g)
                returned.add(g)
        for g in GROUPS:
            slot = self.group[g]
            if slot["state"] == "remote" and (
                    now_ns - slot["arrival_ns"] > self.parameters["dt_max_ns"]):
                self.violate(g, now_ns)
                returned.add(g)
        for g in GROUPS:
            held = self.hold_until_ns is not None and now_ns < self.hold_until_ns
            offering = [s for s, groups in self.offers.items() if g in groups]
            if self.group[g]["state"] != "local" or g in returned or g not in self.area:
                continue
            if held or not offering or self.sessions == I64_MAX:
                continue
            station = min(offering, key=lambda s: (self.asked.get((s, g), 0), s))
            self.sessions += 1
            self.asked[station, g] = self.sessions
            self.group[g] = {"state": "requested", "station": station, "session": self.sessions,
                             "deadline_ns": self.later(now_ns, "request_timeout_ns")}
            self.do(3, g, {"send": "request", "station": station, "group": g,
                           "session": self.sessions})

    def confirm(self, now_ns, event, named):
        g, slot = event["group"], self.group[event["group"]]
        if named and slot["state"] == "requested" and now_ns < slot["deadline_ns"]:
            slot.update(state="remote", arrival_ns=now_ns, used_ns=None)
            if not self.hardened:
                self.stop_local(g)
        elif not (named and slot["state"] == "remote"):
            self.release(g, event["station"], event["session"])

    def data(self, now_ns, event, named):
        g, slot = event["group"], self.group[event["group"]]
        if not (named and slot["state"] == "remote"):
            return self.do(0, g, {"drop": g})
        latency, silence = now_ns - event["generated_ns"], now_ns - slot["arrival_ns"]
        slot["arrival_ns"] = now_ns
        if not 0 <= latency <= self.parameters["l_max_ns"] or (
                silence > self.parameters["dt_max_ns"]):
            self.do(0, g, {"drop": g})
            return self.violate(g, now_ns)
        if slot["used_ns"] is not None and event["generated_ns"] <= slot["used_ns"]:
            return self.do(0, g, {"drop": g})
        slot["used_ns"] = event["generated_ns"]

    def verdict(self, now_ns, event):
        if event["verdict"] == "unsafe":
            for g in GROUPS:
                self.leave(g)
            return self.hold(now_ns)
        for g in GROUPS:
            slot = self.group[g]
            if slot["state"] == "remote" and not slot.get("stopped") and (
                    slot["used_ns"] is not None and event["sessions"].get(g) == slot["session"]):
                self.stop_local(g)

    def drop(self, g):
        """A monitor drops an element that does not count as an arrival."""
        return self.step({"type": "drop", "t_ns": 0, "group": g})

    def step(self, event):
        self.actions = []
        kind, now_ns, station = event["type"], event["t_ns"], event.get("station")
        slot = self.group.get(event.get("group"), {})
        named = (slot.get("station"), slot.get("session")) == (station, event.get("session"))
        if kind == "offer":
            self.offer(station, set(event["groups"]))
        elif kind in ("withdraw", "lost"):
            self.offer(station, set(), kind == "withdraw")
        elif kind == "area":
            self.area = set(event["groups"])
            for g in GROUPS:
                if g not in self.area:
                    self.leave(g)
        elif kind == "tick":
            self.tick(now_ns, event.get("give_back", ()))
        elif kind == "drop":
            self.do(0, event["group"], {"drop": event["group"]})
        elif kind == "confirm":
            self.confirm(now_ns, event, named)
        elif kind == "reject":
            if named and slot["state"] == "requested":
                self.leave(event["group"], False)
        elif kind == "data":
            self.data(now_ns, event, named)
        else:
            self.verdict(now_ns, event)
        states = {g: self.group[g]["state"] for g in GROUPS}
        for g in GROUPS:
            if states[g] != "local":
                states[g] += f":{self.group[g]['station']}"
        actions = [action for *_, action in sorted(self.actions, key=lambda a: a[:2])]
        return {**states, "hold_until_ns": self.hold_until_ns, "actions": actions}


EVENTS = {"offer": ("station", "groups"), "withdraw": ("station",), "lost": ("station",),
          "area": ("groups",), "tick": (), "confirm": ("station", "group", "session"),
          "reject": ("station", "group", "session"), "verdict": ("verdict", "sessions"),
          "data": ("station", "group", "session", "generated_ns")}


def read_event(value):
    if not isinstance(value, dict):
        raise Broken
    fields(value, ["t_ns", "type", *EVENTS[choice(value.get("type"), EVENTS)]])
    for key in {"t_ns", "station", "session", "generated_ns"} & set(value):
        integer(value[key])
    if value.get("station", 1) < 1:
        raise Broken
    choice(value.get("group", "mot"), GROUPS)
    choice(value.get("verdict", "safe"), ("safe", "unsafe"))
    listed(value.get("groups", []), lambda group: choice(group, GROUPS))
    for session in fields(value.get("sessions", {}), [], GROUPS).values():
        integer(session)
    return value


def answer_offloading(record):
    fields(record, ["kind", "id", "events"], ["profile", "parameters"])
    given = record.get("parameters", {})
    fields(given, [], [*TIMES, "qos_hold"])
    profile = choice(record.get("profile", "hardened"), ("paper", "hardened"))
    if not isinstance(given.get("qos_hold", False), bool):
        raise Broken
    if any(integer(given[key]) < 0 for key in set(TIMES) & set(given)):
        raise Broken
    events = listed(record["events"], read_event)
    if len(events) > 10_000:
        raise Broken
    requester = Requester({**TIMES, "qos_hold": False, **given}, profile == "hardened")
    return {"states": [requester.step(event) for event in events]}
