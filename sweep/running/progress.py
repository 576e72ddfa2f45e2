"""Progress of a sweep on stderr: a bar on a terminal, elsewhere a line every few seconds,
and in a notebook one line that is replaced.
"""

import time
from collections import defaultdict, deque
from collections.abc import Callable, Mapping, Sequence
from datetime import timedelta
from importlib import import_module
from math import isfinite
from typing import Any, Self

from rich.console import Console
from rich.progress import BarColumn, ProgressColumn, SpinnerColumn, Task, TimeElapsedColumn
from rich.progress import Progress as Bar
from rich.text import Text

from sweep.numbers import percent
from sweep.plain_text import plain
from sweep.result import Result, Status
from sweep.running.batches import Kind, cost, kind

PERIOD = 5.0  # seconds between plain lines
NOTEBOOK_PERIOD = 0.5
RECENT = 60.0  # last seconds, from which the pace is measured
FIRM = 4.0  # seconds of measurement before the time left is shown, since the first cases are short
SOON = 1.0  # seconds: a shorter time left is not shown, as the running cases may be long ones
SENTENCES = 5  # most different failures that are reported while the sweep runs


class Stderr(Console):
    """A console on stderr. A reader that has closed the pipe does not end the run."""

    def __init__(self) -> None:
        super().__init__(stderr=True)

    def on_broken_pipe(self) -> None:
        """Print nothing more, where rich would exit."""
        self.quiet = True


def announce(line: str) -> None:
    """Print one line on stderr before the progress starts."""
    Stderr().print(plain(line), markup=False, highlight=False, soft_wrap=True)


class Line(ProgressColumn):
    """A text that is made anew whenever it is drawn."""

    def __init__(self, text: Callable[[], str]) -> None:
        super().__init__()
        self._text = text

    def render(self, task: Task) -> Text:
        """The text now."""
        return Text(self._text())


class Progress:
    """Counts cases as they finish.

    The time left is the time of the waiting cases, each at the processor time per weight of the
    finished cases of its kind. It runs down with the clock until more cases end, and is not shown
    once it is over. waiting: number of waiting cases. work: total weight of the waiting cases, by
    their kind, as `cost` gives it. done: number of cases of the sweep that were
    finished before. part: these cases are a part of a search, which reports the end of each part
    itself: lines appear only if a part takes long. running: returns the share of its steps that
    each long case has done.
    """

    def __init__(
        self,
        waiting: int,
        work: Mapping[Kind, float],
        done: int = 0,
        console: Console | None = None,
        part: bool = False,
        running: Callable[[], Sequence[float]] = list,
    ) -> None:
        self.console = console or Stderr()
        self.part = part
        self.running = running
        self.total = done + waiting
        self.done, self.failed = done, 0
        self._left = dict(work)
        self._ended = defaultdict[Kind, float](float)  # weight of the cases that tell the pace
        self._cpu = defaultdict[Kind, float](float)  # and their processor time, s
        self._recent: deque[tuple[float, int, float]] = deque()  # time, cases done, processor time
        self._printed = time.monotonic() if part else 0.0  # time of the last plain line
        self._counts: tuple[int, int] | None = None  # cases done and failed in that line
        self._sentences: set[str] = set()
        self._shown: Any = None  # the line in a notebook
        self._period = NOTEBOOK_PERIOD if self.console.is_jupyter else PERIOD
        self._bar = Bar(
            SpinnerColumn(),
            BarColumn(),
            Line(lambda: self._line()),
            TimeElapsedColumn(),
            console=self.console,
            transient=part,
            disable=not self.console.is_terminal,
        )
        self._task = self._bar.add_task("", total=sum(work.values()))

    def __enter__(self) -> Self:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()
        if not (self.console.is_terminal or self.part) and self._counts != (self.done, self.failed):
            self._update(self._line())

    def advance(self, results: Sequence[Result]) -> None:
        """Count finished cases, and report the first failures."""
        self.done += len(results)
        ended = 0.0
        for result in results:
            alike, weight = kind(result.case), cost(result.case)
            cpu = float(result.summary["cpu_s"])
            self._left[alike] = self._left.get(alike, 0.0) - weight
            ended += weight
            if self._recent and isfinite(cpu):  # the first case loads the kernels too
                self._ended[alike] += weight
                self._cpu[alike] += cpu
            if result.status is not Status.CONVERGED:
                self._report_failure(result)
        self._measure(time.monotonic())
        self._bar.update(self._task, advance=ended)

    def _report_failure(self, result: Result) -> None:
        self.failed += 1
        if result.message not in self._sentences and len(self._sentences) < SENTENCES:
            self._sentences.add(result.message)
            self.say(f"case {result.case_id} {result.status}: {result.message}")

    def _measure(self, now: float) -> None:
        self._recent.append((now, self.done, sum(self._cpu.values())))
        while len(self._recent) > 2 and now - self._recent[0][0] > RECENT:
            self._recent.popleft()
        self._show(now)

    def tick(self) -> None:
        """Show how far long cases are, while none ends; a terminal's bar does so by itself."""
        if self.running():
            self._show(time.monotonic())

    def _show(self, now: float) -> None:
        """Print the state of the sweep, unless it was printed a moment ago."""
        if not self.console.is_terminal and now - self._printed > self._period:
            self._printed, self._counts = now, (self.done, self.failed)
            self._update(self._line())

    def _line(self) -> str:
        parts = [f"{self.done}/{self.total} cases", *self._pace()]
        if shares := self.running():
            parts.append(f"running: {' and '.join(f'{percent(share)} %' for share in shares)}")
        return ", ".join([*parts, f"{self.failed} failed"] if self.failed else parts)

    def _pace(self) -> list[str]:
        """Cases per second and time left, if two moments are known."""
        if len(self._recent) < 2:
            return []
        (begin, done_then, cpu_then), (now, done, cpu) = self._recent[0], self._recent[-1]
        if now == begin or done == done_then:
            return []
        pace = f"{(done - done_then) / (now - begin):.3g} a second"
        if self.done == self.total or now - begin < FIRM or cpu <= cpu_then:
            return [pace]
        seconds = self._time_waiting() * (now - begin) / (cpu - cpu_then) - (time.monotonic() - now)
        return [pace, f"{timedelta(seconds=round(seconds))} left"] if seconds >= SOON else [pace]

    def _time_waiting(self) -> float:
        """Processor time (s) of the waiting cases; a kind none of which ended has the mean pace."""
        cpu, ended, left = (dict(of_kind) for of_kind in (self._cpu, self._ended, self._left))
        of_all = sum(cpu.values()) / sum(ended.values())
        pace = {k: cpu[k] / weight for k, weight in ended.items() if k in cpu}
        return sum(weight * pace.get(k, of_all) for k, weight in left.items())

    def _update(self, line: str) -> None:
        """Show the state of the sweep; in a notebook it replaces the previous state."""
        data = {"text/plain": line}
        if not self.console.is_jupyter:
            self.say(line)
        elif self._shown is None:  # below what the cell has printed
            self._shown = import_module("IPython.display").display(data, raw=True, display_id=True)
        else:
            self._shown.update(data, raw=True)

    def say(self, line: str) -> None:
        """Print a line, above the bar if there is one."""
        self.console.print(plain(line), markup=False, highlight=False, soft_wrap=True)
