"""Output for the user while a sweep runs."""

import io
import sys
from types import SimpleNamespace

import pytest
from rich.console import Console

from sweep.running import progress
from sweep.running.batches import kind
from sweep.running.progress import Progress
from tests.support.results.standin import cases, simulate


@pytest.fixture
def clock(monkeypatch):
    """Time that passes only on request."""
    clock = SimpleNamespace(now=100.0)
    clock.monotonic = lambda: clock.now
    monkeypatch.setattr(progress, "time", clock)
    return clock


ONE = {kind(cases(1)[0]): 1.0}


def ended(case, cpu):
    """Its result, which took so much processor time (s)."""
    result = simulate(case)
    result.summary["cpu_s"] = cpu
    return result


def test_time_left_is_weighed_by_cost(clock, monkeypatch):
    """The short half of the cases is done, at two a second; the other half is ten times as long."""
    batch, out = cases(40), io.StringIO()
    costs = {case.case_id: 1.0 if number < 20 else 10.0 for number, case in enumerate(batch)}
    monkeypatch.setattr(progress, "cost", lambda case: costs[case.case_id])
    work = {kind(batch[0]): 220.0}
    with Progress(40, work, console=Console(file=out)) as told:
        for begin in range(0, 20, 4):
            clock.now += 2.0
            told.advance([ended(case, 0.5) for case in batch[begin : begin + 4]])
            if begin == 4:  # two seconds after the first
                assert told._line() == "8/40 cases, 2 a second, 1 failed"
    assert "20/40 cases, 2 a second, 0:01:40 left, 1 failed" in out.getvalue().splitlines()


def test_time_left_is_that_of_the_kinds_that_wait(clock, monkeypatch):
    """Impacts whose steps are chosen by an error take 30 times as long as their cost says. Two of
    ten have ended when all crushes have.
    """
    crushes = cases(20)
    impacts = [case.changed(loading={"mode": "impact"}) for case in cases(10)]
    work = {kind(crushes[0]): 20.0, kind(impacts[0]): 10.0}
    monkeypatch.setattr(progress, "cost", lambda _: 1.0)
    with Progress(30, work, console=Console(file=io.StringIO())) as told:
        for number, case in enumerate(crushes):
            clock.now += 0.5
            told.advance([ended(case, 0.5 if number else 30.0)])  # the first one loads the kernels
        for case in impacts[:2]:
            clock.now += 15.0
            told.advance([ended(case, 15.0)])
        assert "0:02:00 left" in told._line()
        clock.now += 30.0  # nothing ends
        assert "0:01:30 left" in told._line()
        clock.now += 100.0
        assert "left" not in told._line()


def test_long_cases_show_how_far_they_are(clock):
    """While none ends, a line every few seconds; a terminal's bar draws itself."""
    shares, out = [], io.StringIO()
    with Progress(8, ONE, console=Console(file=out), running=lambda: shares) as told:
        told.tick()
        assert out.getvalue() == ""  # no case is long yet
        shares += [0.345, 0.02]
        for _ in range(60):
            clock.now += 0.2
            told.tick()
        lines = out.getvalue().splitlines()
        shares.clear()
        clock.now += 1.0
        told.advance([ended(cases(8)[0], 13.0)])
        clock.now += 1.0
        told.advance([])
    assert lines == ["0/8 cases, running: 34 % and 2 %"] * 3
    assert out.getvalue().splitlines()[-1].startswith("1/8 cases")
    assert "a second" not in out.getvalue()


def test_plain_lines_are_few(clock):
    """The last one is not repeated if time passes after it."""
    batch, out = cases(100), io.StringIO()
    with Progress(len(batch), ONE, console=Console(file=out)) as told:
        for case in batch:
            clock.now += 0.1
            told.advance([simulate(case)])
        clock.now += 9.0
    lines = out.getvalue().splitlines()
    assert len(lines) <= 5
    failure = f"case {batch[7].case_id} stopped: No step was short enough: try a smaller time_step."
    assert lines.count(failure) == 1
    assert [line for line in lines if "100/100 cases" in line] == lines[-1:]
    assert lines[-1].endswith("1 failed")


def test_notebook_has_one_line_that_is_replaced(clock, monkeypatch):
    """With a stand-in of IPython, which every notebook has."""
    shown = []

    class Handle:
        def update(self, data, raw):
            shown[-1] = data["text/plain"]

    def display(data, raw, display_id):
        shown.append(data["text/plain"])
        return Handle()

    stand_in = SimpleNamespace(display=display)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(display=stand_in))
    monkeypatch.setitem(sys.modules, "IPython.display", stand_in)
    batch = cases(6)
    console = Console(file=io.StringIO(), force_jupyter=True)
    with Progress(6, ONE, 0, console) as told:
        for case in batch:
            clock.now += 1.0
            told.advance([simulate(case)])
            assert shown[0].startswith(f"{told.done}/6 cases")
    assert len(shown) == 1
    assert shown[0].startswith("6/6 cases")


def test_terminal_has_a_bar_with_failures():
    batch, out = cases(9), io.StringIO()
    console = Console(file=out, force_terminal=True, width=100)
    with Progress(9, ONE, 3, console) as told:
        told.advance([simulate(case) for case in batch])
    assert "12/12 cases" in out.getvalue()
    assert "1 failed" in out.getvalue()
    assert "stopped: No step was short enough" in out.getvalue()


def test_part_of_a_search_is_told_only_if_it_takes_long(clock):
    batch = cases(6)
    for pause, lines in {0.1: 0, 6.0: 6}.items():
        out = io.StringIO()
        with Progress(6, ONE, console=Console(file=out), part=True) as told:
            for case in batch:
                clock.now += pause
                told.advance([simulate(case)])
        assert sum("/6 cases" in line for line in out.getvalue().splitlines()) == lines
