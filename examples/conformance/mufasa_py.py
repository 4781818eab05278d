#!/usr/bin/env python3
"""A program under test: MUFASA in doubles (the norm of directions
exactly), from the text of spec/ alone.

It answers the records `cycle` (read by record.py, judged by paper.py or hardened.py), `offloading`
(offloading.py), `composition` (composition.py) and `monitor` (monitor.py) of
spec/5-interfaces.md, one line each. It is no part of the project: it shows how little a program
needs to be judged by `mufasa conform`.
"""
import json
import sys

import hardened
import paper
from composition import answer_composition
from monitor import answer_monitor
from offloading import answer_offloading
from record import Broken, Invalid, check_input, choice, read_cycle


def stage_of(cycle):
    return (hardened if cycle["profile"] == "hardened" else paper).failed_stage(cycle)


def failed_stage(cycle):
    if not check_input(cycle):
        return "input"
    return None if cycle["configuration"] == "Local" else stage_of(cycle)


def answer_cycle(record):
    try:
        stage = failed_stage(read_cycle(record))
    except Invalid:
        return {"verdict": "error", "failed_stage": None}
    return {"verdict": "unsafe" if stage else "safe", "failed_stage": stage}


# The line protocol: spec/5-interfaces.md.


def unique(pairs):
    return dict(pairs) if len(dict(pairs)) == len(pairs) else {**dict(pairs), "twice": None}


def no_constant(_):
    raise ValueError


def answer(line):
    name = None
    try:
        record = json.loads(
            line.decode("utf-8"), object_pairs_hook=unique, parse_constant=no_constant,
            parse_int=lambda text: int(text) if len(text) < 400 else float(text))
        if not isinstance(record, dict) or not isinstance(record.get("id"), str):
            raise Broken
        name = record["id"]
        kind = choice(record.get("kind"), ("cycle", "offloading", "composition", "monitor"))
        if kind == "cycle":
            return {"id": name, **answer_cycle(record)}
        if kind == "offloading":
            return {"id": name, **answer_offloading(record)}
        if kind == "monitor":
            return {"id": name, **answer_monitor(record, stage_of)}
        return {"id": name, **answer_composition(record)}
    except (Broken, ValueError, RecursionError):
        return {"id": name, "verdict": "error", "failed_stage": None}


def main():
    for line in sys.stdin.buffer:
        sys.stdout.write(json.dumps(answer(line)) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
