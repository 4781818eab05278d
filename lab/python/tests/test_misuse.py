"""What must not be done with a monitor, and what happens to who does it."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from datetime import timedelta
from types import SimpleNamespace
from typing import Any

import mufasa
import pytest
from conftest import PERIOD, Scene, at
from mufasa import (
    Detections,
    Drop,
    DropReason,
    Gap,
    InvalidInput,
    Monitor,
    Release,
    Time,
    Tracks,
)


def test_nothing_of_an_unsafe_cycle_can_be_had(scene: Scene) -> None:
    monitor = scene.offloading()
    scene.send(monitor, 10, tracks=scene.aside)
    decision = scene.decide(monitor, 10)
    assert not decision.safe and not decision
    assert decision.report is not None and decision.report.failed_stage == "i"
    for name in ("tracks", "trajectory"):
        with pytest.raises(mufasa.UnsafeCycle):
            getattr(decision, name)
    assert monitor.configuration == "Local"


def test_a_safe_cycle_gives_what_the_station_sent(scene: Scene) -> None:
    decision = scene.safe(scene.offloading(), 10)
    assert decision and decision.tracks is not None and decision.trajectory is not None
    assert decision.tracks.items == scene.tracks
    assert decision.trajectory.points == scene.plan(10)
    assert (decision.trajectory.station, decision.trajectory.stamp) == (1, at(10))


def test_a_verified_trajectory_says_by_when_to_brake(scene: Scene) -> None:
    decision = scene.safe(scene.offloading(), 10)
    assert decision.trajectory is not None
    assert decision.trajectory.brake_by == at(10 + 250)
    parameters = {"dt_max_ns": 150_000_000}
    decision = scene.safe(scene.offloading(profile="paper", parameters=parameters), 10)
    assert decision.trajectory is not None and decision.trajectory.brake_by is None


def test_local_cycles_verify_nothing(scene: Scene) -> None:
    decision = scene.decide(scene.monitor(), 10)
    assert decision.safe and decision.tracks is None and decision.trajectory is None


CALLS: dict[str, Callable[[Monitor], object]] = {
    "tick": lambda it: it.tick(at(20)),
    "offer": lambda it: it.offer(at(20), 2, ["mot"]),
    "withdraw": lambda it: it.withdraw(at(20), 2),
    "lost": lambda it: it.lost(at(20), 2),
    "confirm": lambda it: it.confirm(at(20), 2, "mot", 9),
    "reject": lambda it: it.reject(at(20), 2, "mot", 9),
    "area": lambda it: it.area(at(20), ["mot", "plan"]),
    "tracks": lambda it: Scene.send(it, 20),
    "set_route": lambda it: it.set_route(Scene.road),
    "cycle": lambda it: Scene.safe(it, 20),
    "a call that raises": lambda it: it.set_route([]),
    "a cycle that raises": lambda it: it.cycle(20, Scene.ego),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("name", CALLS)
def test_verified_data_expire_with_the_next_call(scene: Scene, name: str) -> None:
    monitor = scene.offloading()
    decision = scene.safe(monitor, 10)
    tracks, trajectory = decision.tracks, decision.trajectory
    assert tracks is not None and trajectory is not None
    # Looking is no call.
    assert monitor.configuration == "AllRemote" and monitor.source("plan") == 1
    assert trajectory.points and tracks.items
    try:
        CALLS[name](monitor)
    except InvalidInput:
        pass
    for data, names in (
        (trajectory, ("points", "stamp", "station")),
        (tracks, ("items", "stamp", "station")),
        (decision, ("tracks", "trajectory")),
    ):
        for part in names:
            with pytest.raises(mufasa.Expired):
                getattr(data, part)
        with pytest.raises(mufasa.Expired):
            monitor.own(data)
    assert decision.safe, "the verdict itself stays what it was"


def test_data_of_another_monitor_are_told_apart(scene: Scene) -> None:
    one, other = scene.offloading(), scene.offloading()
    decisions = [scene.safe(monitor, 10) for monitor in (one, other)]
    for name in ("tracks", "trajectory"):
        own, foreign = (getattr(decision, name) for decision in decisions)
        assert one.own(own) is own
        with pytest.raises(mufasa.OtherMonitor):
            one.own(foreign)
    with pytest.raises(mufasa.OtherMonitor):
        one.own(decisions[1])
    with pytest.raises(TypeError):
        one.own(scene.plan(10))  # type: ignore[type-var]


@pytest.mark.parametrize(
    "kind", [mufasa.VerifiedTracks, mufasa.VerifiedTrajectory, mufasa.Decision, mufasa.Actions]
)
def test_nobody_makes_verified_data(kind: Any) -> None:
    with pytest.raises(TypeError):
        kind()
    with pytest.raises(TypeError):
        kind.__new__(kind)
    with pytest.raises(TypeError):
        type("Forged", (kind,), {})


def test_verified_data_can_be_neither_changed_nor_copied(scene: Scene) -> None:
    trajectory = scene.safe(scene.offloading(), 10).trajectory
    assert trajectory is not None
    with pytest.raises(AttributeError):
        trajectory.points = []  # type: ignore[misc]
    trajectory.points.clear()
    assert trajectory.points == scene.plan(10)
    with pytest.raises(TypeError):
        copy.copy(trajectory)
    with pytest.raises(TypeError):
        pickle.dumps(trajectory)


def test_what_was_handed_in_is_out_of_reach(scene: Scene) -> None:
    monitor = scene.offloading()
    tracks, points = list(scene.tracks), scene.plan(10)
    scene.send(monitor, 10, tracks, points)
    tracks.clear()
    points[0] = points[0]._replace(x=40.0)
    shown = {name for name in dir(monitor) if not name.startswith("_")}
    calls = "set_route offer withdraw lost confirm reject area tick tracks trajectory cycle own"
    assert shown == {*calls.split(), *"configuration source session_of sessions hold_until advice".split()}
    decision = scene.decide(monitor, 10)
    assert decision.tracks is not None and decision.tracks.items == scene.tracks
    assert decision.trajectory is not None and decision.trajectory.points == scene.plan(10)


def test_a_fallback_cannot_be_thrown_away(scene: Scene) -> None:
    monitor = scene.offloading()
    scene.send(monitor, 10, tracks=scene.aside)
    monitor.cycle(at(10), scene.ego, detections=Detections(at(10), scene.parked))
    for call in (lambda: monitor.tick(at(20)), lambda: monitor.cycle(at(20), scene.ego)):
        with pytest.raises(mufasa.ActionsNotTaken) as left:
            call()
    # The monitor goes on with who takes them.
    released = [action for action in left.value.actions if isinstance(action, Release)]
    assert [action.group for action in released] == ["mot", "plan"]
    assert not monitor.tick(at(30))


def test_requests_and_drops_cannot_be_thrown_away(scene: Scene) -> None:
    monitor = scene.monitor()
    monitor.offer(at(0), 1, ["mot"])
    requests = monitor.tick(at(0))
    assert len(requests) == 1
    with pytest.raises(mufasa.ActionsNotTaken):
        monitor.tick(at(10))
    assert requests[0] == mufasa.Request(1, "mot", 1) and requests[-1:] == list(requests)
    now = at(20)
    late = monitor.tracks(now, station=1, session=7, generated=now, stamp=now, items=[])
    with pytest.raises(mufasa.ActionsNotTaken):
        monitor.tick(at(30))
    assert list(late) == [Drop("mot", "other_session")]
    assert not monitor.tick(at(30))


def test_neither_configuration_nor_history_is_an_argument(scene: Scene) -> None:
    monitor = scene.offloading()
    for name in ("configuration", "profile", "detection_history", "tracks", "trajectory"):
        with pytest.raises(TypeError, match=name):
            monitor.cycle(at(10), scene.ego, **{name: None})
    with pytest.raises(AttributeError):
        monitor.configuration = "Local"  # type: ignore[misc]


def lead(stamp: Any, gap: Any) -> Any:
    """What has the names of a ``Lead``, which itself refuses what is none."""
    return SimpleNamespace(stamp=stamp, gap=gap, speed=0.0)


@pytest.mark.parametrize("bare", [5_000_000, 0.1, None, timedelta(seconds=1), "now"])
def test_a_bare_number_is_no_time(scene: Scene, bare: Any) -> None:
    monitor = scene.offloading()
    calls: list[Callable[[], object]] = [
        lambda: monitor.tick(bare),
        lambda: monitor.offer(bare, 1, ["mot"]),
        lambda: monitor.lost(bare, 1),
        lambda: monitor.tracks(at(1), station=1, session=1, generated=bare, stamp=at(1), items=[]),
        lambda: monitor.trajectory(at(1), station=1, session=1, generated=at(1), stamp=bare, points=[]),
    ]
    for call in calls:
        with pytest.raises(TypeError):
            call()
    assert monitor.configuration == "AllRemote"
    wrong = {
        "now": {"now": bare},
        "detections.stamp": {"detections": Detections(bare, [])},
        "tracks.stamp": {"local_tracks": Tracks(bare, [])},
        "lead.stamp": {"lead": lead(bare, Gap.between_bumpers(20.0))},
    }
    for field, given in wrong.items():
        with pytest.raises(mufasa.UnreadableInputs) as error:
            scene.offloading().cycle(given.pop("now", at(1)), scene.ego, **given)
        assert error.value.field == field


@pytest.mark.parametrize("bare", [25.0, 25, "25"])
def test_a_bare_number_is_no_gap(scene: Scene, bare: Any) -> None:
    with pytest.raises(mufasa.UnreadableInputs, match=r"mufasa\.Gap") as error:
        scene.monitor().cycle(at(1), scene.ego, lead=lead(at(1), bare))
    assert error.value.field == "lead.gap"


def test_a_gap_says_from_where(scene: Scene) -> None:
    assert Gap.from_reference_point(13.65, scene.ego).metres == pytest.approx(10.0)
    assert Gap.from_reference_point(13.65, scene.ego._asdict()).metres == pytest.approx(10.0)
    assert Gap.between_bumpers(10.0).metres == 10.0


def test_inputs_that_cannot_be_read_end_in_the_fallback(scene: Scene) -> None:
    monitor = scene.offloading()
    scene.safe(monitor, 10)
    with pytest.raises(mufasa.UnreadableInputs) as error:
        monitor.cycle(at(20), {"x": 0.0})
    assert error.value.field == "ego.y"
    assert monitor.configuration == "Local"
    with pytest.raises(mufasa.ActionsNotTaken):
        monitor.tick(at(30))
    assert [it for it in error.value.actions if isinstance(it, Release)]
    assert not monitor.tick(at(30))


def test_a_cycle_that_cannot_be_read_falls_back_at_its_own_time(scene: Scene) -> None:
    for ms in (20, 500):
        monitor = scene.offloading()
        with pytest.raises(mufasa.UnreadableInputs) as error:
            monitor.cycle(at(ms), {"x": 0.0})
        assert list(error.value.actions)
        assert monitor.hold_until == at(ms + 10_000)
    # The time itself cannot be read: that of the last call.
    monitor = scene.offloading()
    list(monitor.tick(at(30)))
    with pytest.raises(mufasa.UnreadableInputs) as error:
        monitor.cycle(40, scene.ego)  # type: ignore[arg-type]
    assert error.value.field == "now" and list(error.value.actions)
    assert monitor.hold_until == at(30 + 10_000)


def test_actions_outlive_what_python_raises(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    """A signal handler may raise anywhere in Python: after a decision its actions are still there."""

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monitor = scene.offloading()
    scene.safe(monitor, 10)
    scene.send(monitor, 20, tracks=scene.aside)
    list(monitor.tick(at(20)))
    with monkeypatch.context() as patched, pytest.raises(KeyboardInterrupt):
        patched.setattr("mufasa._verdict.of_answer", interrupted)
        monitor.cycle(at(20), scene.ego, detections=Detections(at(20), scene.parked))
    assert monitor.configuration == "Local"
    with pytest.raises(mufasa.ActionsNotTaken) as left:
        monitor.tick(at(30))
    actions = left.value.actions
    # Nor are they taken when they cannot be made.
    with monkeypatch.context() as patched, pytest.raises(KeyboardInterrupt):
        patched.setattr("mufasa._types.Release", interrupted)
        list(actions)
    with pytest.raises(mufasa.ActionsNotTaken):
        monitor.tick(at(30))
    assert [it.group for it in actions if isinstance(it, Release)] == ["mot", "plan"]
    assert not monitor.tick(at(30))


HUGE: dict[str, tuple[Callable[[Monitor], object], str]] = {
    "confirm": (lambda it: it.confirm(at(1), 1, "mot", 2**70), "session"),
    "reject": (lambda it: it.reject(at(1), -(2**70), "mot", 1), "station"),
    "offer": (lambda it: it.offer(at(1), 2**63, ["mot"]), "station"),
    "group": (lambda it: it.confirm(at(1), 1, "\ud800", 1), "group"),  # type: ignore[arg-type]
    "groups": (lambda it: it.area(at(1), ["\ud800"]), "groups"),  # type: ignore[list-item]
    "tracks": (
        lambda it: it.tracks(at(1), station=1, session=2**70, generated=at(1), stamp=at(1), items=[]),
        "session",
    ),
    "trajectory": (
        lambda it: it.trajectory(at(1), station=2**70, session=1, generated=at(1), stamp=at(1), points=[]),
        "station",
    ),
    "nanoseconds": (lambda _: Time.from_nanoseconds(2**70), "nanoseconds"),
    "microseconds": (lambda _: Time.from_microseconds(2**70), "microseconds"),
    "milliseconds": (lambda _: Time.from_milliseconds(2**62), "milliseconds"),
    "seconds": (lambda _: Time.from_seconds(10**400), "seconds"),
    "gap": (lambda _: Gap.between_bumpers(10**400), "gap"),
    "record": (lambda _: mufasa.check("\ud800"), ""),
    "ego": (lambda _: mufasa.read_drives("x", ego=2**70), "ego"),
    "seed": (lambda _: mufasa.read_drives("x", seed=-1), "seed"),
}


@pytest.mark.parametrize("name", HUGE)
def test_numbers_of_any_size_are_invalid_input(scene: Scene, name: str) -> None:
    """Who decodes a forged number catches ``MufasaError`` as for any other."""
    call, field = HUGE[name]
    monitor = scene.offloading()
    with pytest.raises(InvalidInput) as error:
        call(monitor)
    assert error.value.field == field
    assert monitor.configuration == "AllRemote"


@pytest.mark.parametrize(
    ("settings", "field"),
    [
        ({"parameters": {"dt_max_ns": 100_000_000}}, "dt_max_ns"),
        ({"parameters": {"dt_max_ns": -1}}, "parameters.dt_max_ns"),
        ({"parameters": {"dt_max_ns": 150_000_000, "tau": 0.1}}, "tau"),
        ({"parameters": {"dt_max_ns": 150_000_000, "tau": 0.2}}, "tau"),
        ({"parameters": {"dt_max": 0.15}}, "dt_max"),
        ({"parameters": {"dt_max_ns": 150_000_000, "t_wait_ns": 10_000}}, "t_wait_ns"),
        ({"parameters": {"dt_max_ns": 150_000_000, "l_max_ns": 100_000_001}}, "max_age_ns"),
        ({"parameters": {"a_b": 0.0}}, "parameters.a_b"),
        ({"parameters": {"theta_tr": "wide"}}, "theta_tr"),
        ({"sessions_before": -1}, "sessions_before"),
        ({"sessions_before": 2**70}, "sessions_before"),
        ({"most_stations": 0}, "most_stations"),
        ({"most_stations": -1}, "most_stations"),
        ({"most_stations": 2**40}, "most_stations"),
        ({"stall": (-1.0, timedelta(seconds=1))}, "stall"),
        ({"stall": (1.0, timedelta(milliseconds=999))}, "stall"),
        ({"stall": (1.0, timedelta(seconds=-1))}, "stall"),
        ({"check_time": timedelta(milliseconds=10)}, "check_time"),
        ({"check_time": timedelta(hours=1), "step_ps": 2**64 - 1}, "check_time"),
        ({"check_time": timedelta(milliseconds=-1)}, "check_time"),
        ({"profile": "lax"}, "profile"),
        ({"parameters": {"dt_max_ns": 150_000_000, "tau": 0.25, "a_b": 80}}, "a_b"),
    ],
)
def test_settings_that_no_monitor_can_keep(settings: dict[str, Any], field: str) -> None:
    with pytest.raises(InvalidInput) as error:
        Scene.monitor(**settings)
    assert error.value.field == field


def test_a_parameter_without_its_unit_is_told_with_it() -> None:
    with pytest.raises(InvalidInput) as error:
        Scene.monitor(parameters={"dt_max": 0.15})
    assert "dt_max_ns" in str(error.value)


def test_a_period_is_a_time_above_0() -> None:
    with pytest.raises(InvalidInput) as error:
        mufasa.Monitor(timedelta(0))
    assert error.value.field == "period"
    with pytest.raises(InvalidInput) as error:
        mufasa.Monitor(-PERIOD)
    assert error.value.field == "period"
    with pytest.raises(TypeError):
        mufasa.Monitor(0.1)  # type: ignore[arg-type]
    assert mufasa.Monitor(PERIOD / 2).configuration == "Local"


def test_no_message_of_an_earlier_life_fits(scene: Scene) -> None:
    first = scene.offloading()
    assert first.sessions == 2
    second = scene.offloading(sessions_before=first.sessions)
    now = at(10)
    dropped = second.tracks(
        now, station=1, session=1, generated=now, stamp=now, items=scene.tracks
    )
    assert list(dropped) == [Drop("mot", "other_session")]
    running = second.session_of("mot")
    assert running is not None and running == (1, 3)


@pytest.mark.parametrize(
    ("why", "ms", "generated", "stamp", "session"),
    [
        ("other_session", 10, 10, 10, 2),
        ("from_the_future", 10, 11, 10, 1),
        ("late", 10, -50, 10, 1),
        ("too_old", 10, 10, -500, 1),
        ("after_silence", 400, 400, 400, 1),
        ("not_newer", 10, 5, 10, 1),
    ],
)
def test_late_foreign_and_repeated_data_are_not_used(
    scene: Scene, why: DropReason, ms: int, generated: int, stamp: int, session: int
) -> None:
    monitor = scene.offloading()
    scene.safe(monitor, 5)
    actions = monitor.tracks(
        at(ms),
        station=1,
        session=session,
        generated=at(generated),
        stamp=at(stamp),
        items=scene.aside,
    )
    answer = list(actions)
    assert [it for it in answer if isinstance(it, Drop)] == [Drop("mot", why)]
    has_ended = why in ("from_the_future", "late", "after_silence")
    assert (monitor.session_of("mot") is None) == has_ended
    # The last element that was used still decides, or none after a violation of quality of service.
    assert scene.decide(monitor, ms).report is not None


def test_results_that_no_cycle_can_use_end_their_session(scene: Scene) -> None:
    """Stamped ahead of every cycle: left 2 dt_max and two periods after the last good one at the latest."""
    monitor = scene.offloading()
    scene.safe(monitor, 100)
    left = None
    for ms in range(200, 1000, 100):
        now = at(ms)
        list(monitor.tick(now))
        [mot, plan] = monitor.session_of("mot"), monitor.session_of("plan")
        if mot is None or plan is None:
            assert mot is None and plan is None and monitor.configuration == "Local"
            left = ms
            break
        of: dict[str, Any] = {"station": 1, "generated": now, "stamp": at(ms + 5000)}
        list(monitor.tracks(now, session=mot.session, items=scene.tracks, **of))
        list(monitor.trajectory(now, session=plan.session, points=scene.plan(ms), **of))
        decision = scene.decide(monitor, ms)
        assert decision.safe and decision.tracks is None and decision.trajectory is None
    assert left is not None and 100 + 150 < left <= 100 + 2 * 150 + 2 * 100


def test_a_station_below_1_is_refused_and_nothing_has_changed(scene: Scene) -> None:
    monitor = scene.offloading(most_stations=1)
    calls: list[Callable[[], object]] = [
        lambda: monitor.lost(at(1), 0),
        lambda: monitor.offer(at(1), 2, ["mot"]),
    ]
    for call in calls:
        with pytest.raises(InvalidInput) as error:
            call()
        assert error.value.field == "station"
    with pytest.raises(InvalidInput) as error:
        monitor.offer(at(1), 1, ["tracking"])  # type: ignore[list-item]
    assert error.value.field == "groups"
    with pytest.raises(TypeError):
        monitor.offer(at(1), 1, "mot")  # type: ignore[arg-type]
    assert monitor.configuration == "AllRemote"


def test_inputs_that_call_the_monitor_get_an_error(scene: Scene) -> None:
    monitor = scene.offloading()

    class Meddling:
        x = y = sin = 0.0
        cos = length = width = 1.0

        @property
        def speed(self) -> float:
            list(monitor.tick(at(999)))
            return 0.0

    with pytest.raises(mufasa.UnreadableInputs) as error:
        monitor.cycle(at(10), Meddling())  # type: ignore[arg-type]
    assert error.value.field == "ego.speed" and monitor.configuration == "Local"


def test_ticks_that_are_forgotten_are_told(scene: Scene) -> None:
    """Only a tick notices silence."""
    monitor = scene.offloading()
    assert scene.safe(monitor, 10)
    decision = monitor.cycle(at(20), Scene.ego, detections=Detections(at(20), Scene.parked))
    assert decision.error is not None and decision.error.field == "tick"
    assert monitor.configuration == "Local"


def test_a_speed_that_the_gap_contradicts_is_told_once(scene: Scene) -> None:
    monitor, told = scene.monitor(), []
    for ms in range(0, 5000, 100):
        lead = mufasa.Lead(at(ms), Gap.between_bumpers(30.0), 18.0)
        scene.decide(monitor, ms, lead=lead)
        told.append(monitor.advice())
    assert len([it for it in told if it and "m/s" in it]) == 1
