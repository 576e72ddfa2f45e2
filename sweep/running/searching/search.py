"""A search for the best design: a Sobol sequence, then differential evolution, resumed by replay.

Differential evolution (Storn & Price 1997, as in scipy) proposes whole generations of designs. The
new designs of a generation run as a sweep and are rows of the results file. The same seed proposes
the same designs again, so that a search that was stopped continues where it ended: results in the
file are looked up. If a population converges before all evaluations are used up, the search starts
again from other points.

Requirements are compared by the three rules of K. Deb (Comput. Methods Appl. Mech. Eng. 186,
311-338, 2000), which scipy applies as J. Lampinen (2002) describes for differential evolution:

- A design that fulfils all requirements is better than one that does not.
- Of two designs that do, the one with the better value is better.
- Of two designs that do not, the one with the smaller violation is better. The violation is the
  greatest share by which a limit is missed, as in `rank` (`ranking.requirements`); Deb takes the
  sum.
"""

import os
from dataclasses import dataclass, field, replace
from itertools import count
from math import inf
from typing import NamedTuple

import numpy as np
from pandas import DataFrame
from scipy.optimize import NonlinearConstraint, differential_evolution
from scipy.stats import qmc

from sweep.columns import in_words, less_is_better
from sweep.config.case import Case
from sweep.numbers import text_in, three_digits
from sweep.ranking.assessment import Assessment, assess
from sweep.ranking.curves import Cache, with_allowed
from sweep.ranking.question import Question
from sweep.running.child_process import Simulate
from sweep.running.cluster import Scheduler
from sweep.running.progress import announce
from sweep.running.searching.design_space import DesignSpace
from sweep.running.sweep import run_sweep
from sweep.store.read import Rerun, finished_ids, read_summary

START = 4  # binary logarithm of the number of designs of a Sobol start
MOST_TRIED = 1024  # most points of the cube that are tried for a first design
POPULATION = 6  # number of the best of these that evolve
MUTATION = 0.2, 0.6  # below scipy's value, which suits thousands of evaluations; `make search`
IDLE = 20  # generations without a new design that end a population
CLOSE = 1e-3  # relative scatter of the values at which a population has converged
RENEW = Rerun(older=True)  # a search does not compare versions of the model
NONE_YET = Assessment("", {}, {}, doubtful=0)


class Settings(NamedTuple):
    """How to search: number of designs, seed, threads or a place as in `open_place`."""

    evaluations: int = 150
    seed: int = 1
    workers: int = 2
    scheduler: Scheduler = None


@dataclass
class Search:
    """A search into the results file `out`; question: of its ranking.

    cases: the designs so far by id. assessment: their values and misses.
    """

    space: DesignSpace
    question: Question
    out: str | os.PathLike[str]
    settings: Settings
    simulate: Simulate | None = None
    cases: dict[str, Case] = field(default_factory=dict)
    assessment: Assessment = NONE_YET
    _cache: Cache = field(default_factory=dict)
    _idle: int = 0
    _before: int = 0  # designs before the present generation

    @property
    def start(self) -> list[Case]:
        """The existing designs among the first points."""
        points = self._start(self.settings.seed * 1000)
        return [case for point in points if (case := self.space.case(point))]

    @property
    def left(self) -> int:
        """Number of evaluations left."""
        return self.settings.evaluations - len(self.cases)

    def run(self) -> Assessment:
        """Search until all evaluations are used up, or nothing new is found."""
        for seed in count(self.settings.seed * 1000):
            before = len(self.cases)
            self._evolve(seed)
            if self.left <= 0 or len(self.cases) == before:
                break
        if self.cases:
            self._simulate()
        return self.assessment

    def _evolve(self, seed: int) -> None:
        """One population, from its Sobol start until it has converged or is stopped."""
        start = self._start(seed)
        best = np.lexsort([self.costs(start.T), self.violations(start.T)[0]])[:POPULATION]
        self._idle, self._before = 1, len(self.cases)
        required = any(value is not None for value in (self.question.require or {}).values())
        if self.left > 0:
            differential_evolution(
                self.costs,
                [(0.0, 1.0)] * self.space.dimension,
                init=start[best],
                maxiter=10_000,
                tol=CLOSE,
                mutation=MUTATION,
                seed=seed,
                polish=False,
                updating="deferred",
                vectorized=True,
                constraints=NonlinearConstraint(self.violations, -inf, 0.0) if required else (),
                callback=self._is_over,
            )

    def _start(self, seed: int) -> np.ndarray:
        """The first points of a scrambled Sobol sequence (n, dimension): 2^START of them, or as
        many more, up to `MOST_TRIED`, as are needed to find one that is a design.
        """
        sobol = qmc.Sobol(self.space.dimension, scramble=True, seed=seed)
        points = candidates = sobol.random_base2(START)
        while len(points) < MOST_TRIED and not any(map(self.space.case, candidates)):
            candidates = sobol.random(len(points))
            points = np.concatenate([points, candidates])
        return points

    def _is_over(self, *_: object, **__: object) -> bool:
        """Whether a population ends after this generation."""
        self._idle = 0 if len(self.cases) > self._before else self._idle + 1
        self._before = len(self.cases)
        return self.left <= 0 or self._idle >= IDLE

    def costs(self, points: np.ndarray) -> np.ndarray:
        """The values to be minimised, (n,), for the columns of `points` (dimension, n).

        A design without a value, or one that misses a requirement, costs inf.
        """
        ids = self._assessed(points)
        values, sign = self.assessment.by_id, self.assessment.sign
        return np.array([sign * values.get(case_id, sign * inf) for case_id in ids])

    def violations(self, points: np.ndarray) -> np.ndarray:
        """The violations of one point (dimension,), or of the columns of `points`: (1,) or (1, n).

        The violation of a design without a value is inf.
        """
        ids = self._assessed(points.reshape(self.space.dimension, -1))
        fulfil, missed = self.assessment.by_id, self.assessment.missed
        values = [0.0 if case_id in fulfil else missed.get(case_id, inf) for case_id in ids]
        return np.array(values if points.ndim == 1 else [values])

    def _assessed(self, points: np.ndarray) -> list[str]:
        """The ids of the designs at ``points``, "" where there is none; `assessment` has them all.

        Simulates no more designs than there are evaluations left; further ones have no value.
        """
        designs = [self.space.case(point) for point in points.T]
        new = {d.case_id: d for d in designs if d is not None and d.case_id not in self.cases}
        chosen = dict(list(new.items())[: self.left])
        self.cases |= chosen
        if chosen:
            if chosen.keys() - finished_ids(self.out, RENEW):
                self._simulate()
            self._assess()
        return [design.case_id if design else "" for design in designs]

    def _simulate(self) -> None:
        """Run the designs so far that the file does not contain."""
        chosen = tuple(self.cases.values())
        designs = replace(self.space.config, cases=chosen, seed=self.settings.seed)
        how = self.settings.workers, self.settings.scheduler, RENEW, self.simulate
        run_sweep(designs, self.out, *how, part=True)

    def _assess(self) -> None:
        """Evaluate the designs so far, and report the best."""
        self.assessment = assess(self.rows(), self.question)
        counted = f"{len(self.cases)} of at most {self.settings.evaluations} designs"
        announce(f"{counted}: {_best(self.assessment)}")

    def rows(self) -> DataFrame:
        """The rows of the designs so far, with energies up to an allowed force of the panel."""
        summary = read_summary(self.out)
        mine = summary[summary["case_id"].isin(self.cases)].reset_index(drop=True)
        return with_allowed(self.out, mine, self.question, self._cache)


def _best(assessment: Assessment) -> str:
    """The value of the best design so far, in words."""
    if assessment.by_id:
        value = three_digits(next(iter(assessment.by_id.values())))
        column = in_words(assessment.column)
        noun, _, unit = column.partition(", in ")
        most = "least" if less_is_better(assessment.column) else "most"
        return f"the {most} {noun} is {value} {unit}".rstrip()
    least = min(assessment.missed.values(), default=inf)
    if least < inf:
        return f"none fulfils all requirements; the nearest misses them by {text_in(least, '%', 3)}"
    return "none can be ranked"
