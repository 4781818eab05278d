"""What is shown: words, help, arrays, tables, pictures."""

from __future__ import annotations

import ast
import inspect
from datetime import timedelta
from pathlib import Path
from typing import Any

import mufasa
import numpy as np
import pytest
from conftest import Scene, at
from mufasa import Gap, Lead, Time
from test_drives import DEMO

ATTACK = "ghost-tracks@5..6"


def test_everything_says_what_it_is(scene: Scene) -> None:
    monitor = scene.offloading()
    decision = scene.safe(monitor, 100)
    tracks, trajectory = decision.tracks, decision.trajectory
    assert repr(monitor) == 'Monitor(configuration="AllRemote", sessions=2)'
    assert repr(tracks) == "VerifiedTracks(1 items, station=1)"
    assert repr(trajectory) == "VerifiedTrajectory(1 points, station=1)"
    list(monitor.tick(at(110)))
    assert repr(tracks) == "VerifiedTracks(expired)"
    [drive] = mufasa.read_drives(*DEMO)
    assert repr(drive) == "Drive('urban.solution', 188 cycles)"
    html = drive._repr_html_()
    assert "188 cycles" in html and html.count("<li>") == len(drive.notes)


def test_help_has_the_text_of_the_stub() -> None:
    stub = Path(mufasa.__file__).with_name("_native.pyi").read_text()
    seen = 0
    for node in ast.parse(stub).body:
        if not isinstance(node, ast.ClassDef) or not ast.get_docstring(node):
            continue
        told = getattr(mufasa, node.name)
        functions = [it for it in node.body if isinstance(it, ast.FunctionDef)]
        # What an operator says is Python's own.
        plain = [it for it in functions if it.name in ("__array__", it.name.strip("_"))]
        documented: list[ast.ClassDef | ast.FunctionDef] = [node, *plain]
        for it in documented:
            wanted = ast.get_docstring(it)
            if wanted is not None:
                have = inspect.getdoc(told if it is node else getattr(told, it.name))
                assert (have or "").split() == wanted.split(), (node.name, it.name)
                seen += 1
    assert seen > 35


def test_times_differ_by_a_duration() -> None:
    assert Time.from_milliseconds(7) - Time.from_milliseconds(5) == timedelta(milliseconds=2)
    assert Time.from_nanoseconds(0) - Time.from_microseconds(1) == timedelta(microseconds=-1)
    edges = [Time.from_nanoseconds(ns) for ns in (2**63 - 1, -(2**63))]
    assert edges[0] - edges[1] == timedelta(microseconds=2**64 // 1000 + 1)
    with pytest.raises(TypeError):
        at(5) - 5  # type: ignore[operator]


def test_verified_data_are_arrays(scene: Scene) -> None:
    monitor = scene.offloading()
    decision = scene.safe(monitor, 100)
    tracks, trajectory = decision.tracks, decision.trajectory
    assert tracks is not None and trajectory is not None
    points: Any = np.asarray(trajectory)
    assert points["t_ns"].dtype == np.int64 and points["t_ns"][0] == 100_000_000
    assert points.tolist() == [tuple(it) for it in trajectory.points]
    assert np.asarray(tracks, dtype=float).tolist() == [list(it) for it in tracks.items]
    list(monitor.tick(at(110)))
    with pytest.raises(mufasa.Expired):
        np.asarray(trajectory)


def test_a_lead_of_bare_numbers_is_none() -> None:
    lead = Lead(at(0), Gap.between_bumpers(25.0), 8.0)
    assert lead == (at(0), Gap.between_bumpers(25.0), 8.0) and lead._replace(speed=1.0).speed == 1.0
    with pytest.raises(TypeError, match=r"lead.gap must be a mufasa.Gap, not 25.0"):
        Lead(at(0), 25.0, 8.0)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"lead.stamp must be a mufasa.Time, not 0"):
        Lead(0, Gap.between_bumpers(25.0), 8.0)  # type: ignore[arg-type]


def test_attacks_are_listed_by_the_names_that_drives_take() -> None:
    [drive] = mufasa.read_drives(*DEMO)
    assert "ghost-tracks" in mufasa.ATTACKS and len(set(mufasa.ATTACKS)) == len(mufasa.ATTACKS)
    refused = []
    for name in mufasa.ATTACKS:
        try:
            drive.attacked(f"{name}@5..6")
        except mufasa.InvalidInput as error:
            refused.append((name, str(error)))
    assert all("is no attack" not in said for _, said in refused), refused
    assert len(refused) < len(mufasa.ATTACKS) / 2


def test_a_verdict_has_a_picture(scene: Scene) -> None:
    [drive] = mufasa.read_drives(*DEMO)
    unsafe = next(it for it in map(mufasa.check, drive.attacked(ATTACK)) if not it)
    picture = unsafe.to_svg()
    assert picture.startswith("<svg") and "stage i" in picture and unsafe.id in picture
    assert unsafe._repr_svg_() == picture and unsafe == mufasa.check(drive.attacked(ATTACK)[50])
    report = scene.safe(scene.offloading(), 100).report
    assert report is not None and report._repr_svg_() is None
    with pytest.raises(ValueError, match="keeps no inputs"):
        report.to_svg()


def test_a_drive_is_a_table() -> None:
    pytest.importorskip("pandas")
    [drive] = mufasa.read_drives(*DEMO)
    frame = drive.attacked(ATTACK).to_frame()
    assert list(frame["id"]) == [it["id"] for it in drive.attacked(ATTACK)]
    assert not frame["safe"].all() and set(frame["failed_stage"].dropna()) == {"i"}
    assert frame["t_s"].diff().dropna().round(9).eq(0.1).all()
    assert frame["detections"].max() > 0


def test_a_drive_is_drawn() -> None:
    pytest.importorskip("matplotlib").use("agg")
    [drive] = mufasa.read_drives(*DEMO)
    axes = drive.plot()
    assert [len(line.get_xdata()) for line in axes.lines][2] == 188
    assert drive.plot(axes) is axes and len(axes.lines) == 6
