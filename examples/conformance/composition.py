"""Answers the record `composition`: the orchestrator of spec/1-services.md#composition."""
from record import Broken, fields, integer, listed

RULES = ("same_station", "local_only", "acyclic")
MOST = 10_000  # closed choices


def word(value):
    if not isinstance(value, str):
        raise Broken
    return value


def words(value):
    return listed(value, word)


def read_service(value):
    fields(value, ["id", "requires", "guarantees", "station"])
    requires, guarantees = words(value["requires"]), words(value["guarantees"])
    if len(set(requires)) < len(requires) or len(set(guarantees)) < len(guarantees):
        raise Broken
    if integer(value["station"]) < 0:
        raise Broken
    return {"id": word(value["id"]), "requires": requires, "guarantees": guarantees,
            "station": value["station"]}


def providers(services, interface):
    return [name for name, service in services.items() if interface in service["guarantees"]]


def closed_choices(services, goal):
    """Every choice of one provider for each requirement, from the goal back, as a set of links."""
    def go(members, links, open_ends):
        if not open_ends:
            yield links
            return
        (interface, consumer), *rest = open_ends
        for provider in providers(services, interface):
            new = [] if provider in members else [
                (needed, provider) for needed in services[provider]["requires"]]
            yield from go(members | {provider}, links | {(provider, interface, consumer)},
                          rest + new)
    yield from go({goal}, frozenset(), [(it, goal) for it in services[goal]["requires"]])


def is_cyclic(members, links):
    rest = set(members)
    while free := {m for m in rest if not any(j in rest and k == m for j, _, k in links)}:
        rest -= free
    return bool(rest)


def broken(services, members, links, same_station, local_only):
    """The rules that a closed choice breaks."""
    stations = [{services[m]["station"] for m in members if m in names} for names in same_station]
    return [rule for rule, breaks in zip(RULES, (
        any(len(it) > 1 for it in stations),
        any(services[m]["station"] != 0 for m in members if m in local_only),
        is_cyclic(members, links))) if breaks]


def unprovided(services, goal):
    """The first requirement of a service within reach that nobody guarantees."""
    reached, missing, new = set(), [], {goal}
    while new:
        reached |= new
        needed = {(it, name) for name in new for it in services[name]["requires"]}
        missing += [pair for pair in needed if not providers(services, pair[0])]
        new = {j for interface, _ in needed for j in providers(services, interface)} - reached
    return min(missing, default=None)


def reason(services, goal, breaks):
    if pair := unprovided(services, goal):
        return {"requirement": pair[0], "service": pair[1]}
    alone = [rule for rule in RULES if [rule] in breaks]
    some = [rule for rule in RULES if any(rule in it for it in breaks)]
    return {"rule": (alone or some)[0]}


def composition(services, members, links):
    switches = {(j, k) for j, _, k in links if services[j]["station"] != services[k]["station"]}
    return {"members": sorted(members), "links": sorted(map(list, links)),
            "switches": sorted(map(list, switches)), "distributed": bool(switches)}


def answer_composition(record):
    fields(record, ["kind", "id", "services", "goal"], ["same_station", "local_only"])
    items, goal = listed(record["services"], read_service), word(record["goal"])
    same_station = listed(record.get("same_station", []), words)
    local_only = words(record.get("local_only", []))
    services = {service["id"]: service for service in items}
    if not items or len(services) < len(items) or goal not in services:
        raise Broken
    found, breaks = [], []
    for count, links in enumerate(closed_choices(services, goal)):
        if count == MOST:
            raise Broken
        members = {goal} | {j for j, _, _ in links}
        rules = broken(services, members, links, same_station, local_only)
        breaks.append(rules)
        if not rules:
            found.append(composition(services, members, links))
    found.sort(key=lambda it: (it["members"], it["links"]))
    return {"compositions": found, "none": None if found else reason(services, goal, breaks)}
