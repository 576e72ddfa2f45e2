"""A search for the best design: a Sobol sequence, then differential evolution, resumed by replay.

Differential evolution (Storn & Price 1997, as in scipy) asks for whole generations of designs. The
new ones of a generation run as a sweep does and are rows of the results file. The same seed asks
for the same designs again, so that a search that was stopped continues where it ended: what the
file holds is looked up. When a population has converged before all evaluations are used up, the
search starts again from other points.
"""

import os
from dataclasses import dataclass, field
from itertools import count
from math import inf
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import differential_evolution
from scipy.stats import qmc

from sweep.config.case import Case
from sweep.config.grid import designs_of
from sweep.numbers import three_digits
from sweep.ranking.worth import Worths, worths
from sweep.running.dask_graph import Simulate
from sweep.running.design_space import DesignSpace
from sweep.running.progress import tell
from sweep.running.sweep import run_sweep
from sweep.store.read import Rerun, finished_ids, read_summary

START = 4  # binary logarithm of the number of designs of a Sobol start
POPULATION = 6  # of the best of them evolve
MUTATION = 0.2, 0.6  # below scipy's, which suits searches of thousands; `make search`
IDLE = 20  # generations without a new design that end a population
CLOSE = 1e-3  # relative scatter of the values at which a population has converged
RENEW = Rerun(older=True)  # a search does not compare versions of the model


class Settings(NamedTuple):
    """How to search: number of designs, seed, threads or the address of a Dask scheduler."""

    evaluations: int = 150
    seed: int = 1
    workers: int = 2
    scheduler: str | None = None


@dataclass
class Search:
    """A search into the results file `out`; question: the arguments of `rank`.

    cases: the designs so far by id. found: their worths.
    """

    space: DesignSpace
    question: dict[str, Any]
    out: str | os.PathLike[str]
    settings: Settings
    simulate: Simulate | None = None
    cases: dict[str, Case] = field(default_factory=dict)
    found: Worths | None = None
    _idle: int = 0

    @property
    def left(self) -> int:
        """Number of evaluations left."""
        return self.settings.evaluations - len(self.cases)

    def run(self) -> Worths | None:
        """Search until all evaluations are used up, or nothing new is found."""
        for seed in count(self.settings.seed * 1000):
            before = len(self.cases)
            self._evolve(seed)
            if self.left <= 0 or len(self.cases) == before:
                break
        if self.cases:
            self._simulate()
        return self.found

    def _evolve(self, seed: int) -> None:
        """One population, from its Sobol start until it has converged or is stopped."""
        start = _start(self.space.dimension, seed)
        costs = np.array(self.evaluate(None, start))
        best = np.argsort(costs, kind="stable")[:POPULATION]
        self._idle = 0
        if self.left > 0:
            differential_evolution(
                lambda _: inf,
                [(0.0, 1.0)] * self.space.dimension,
                init=start[best],
                maxiter=10_000,
                tol=CLOSE,
                mutation=MUTATION,
                seed=seed,
                polish=False,
                updating="deferred",
                workers=self.evaluate,
                callback=self._is_over,
            )

    def _is_over(self, *_: object, **__: object) -> bool:
        return self.left <= 0 or self._idle >= IDLE

    def evaluate(self, _: object, points: np.ndarray) -> list[float]:
        """The costs of points (n, dimension): the value to be minimised, inf of what is worthless.

        No more designs are simulated than are left; further ones are worthless.
        """
        designs = [self.space.case(point) for point in points]
        new = {d.case_id: d for d in designs if d is not None and d.case_id not in self.cases}
        chosen = dict(list(new.items())[: self.left])
        self._idle = 0 if chosen else self._idle + 1
        self.cases |= chosen
        if chosen:
            if chosen.keys() - finished_ids(self.out, RENEW):
                self._simulate()
            self._assess()
        values = self.found.by_id if self.found else {}
        sign = self.found.sign if self.found else 1.0
        return [sign * values.get(d.case_id, sign * inf) if d else inf for d in designs]

    def _simulate(self) -> None:
        """Run the designs so far that the file does not hold."""
        designs = designs_of(self.space.config, self.cases.values(), self.settings.seed)
        how = self.settings.workers, self.settings.scheduler, RENEW, self.simulate
        run_sweep(designs, self.out, *how)

    def _assess(self) -> None:
        """Value the designs so far, and tell the best."""
        summary = read_summary(self.out)
        self.found = worths(summary[summary["case_id"].isin(self.cases)], self.question)
        best = next(iter(self.found.by_id.values()), None)
        told = "none can be ranked" if best is None else f"the best {three_digits(best)}"
        counted = f"{len(self.cases)} of at most {self.settings.evaluations} designs"
        tell(f"{counted}: {self.found.column}, {told}")


def _start(dimension: int, seed: int) -> np.ndarray:
    """The first points of a scrambled Sobol sequence (2^START, dimension)."""
    return qmc.Sobol(dimension, scramble=True, seed=seed).random_base2(START)
