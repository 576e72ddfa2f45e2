"""The order and the size of batches: the next cases for a worker that is free."""

import threading
from collections import defaultdict, deque
from collections.abc import Sequence
from zlib import crc32

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.specimen import WallLattice
from sweep.config.kinds.steps import count_of
from sweep.config.kinds.table import canonical

SECONDS = 1.0  # of work in a batch: long against the cost of a task, short for progress
LEAST = 0.05  # of SECONDS: the smallest batches, at the end of a sweep
MOST = 500  # cases in a batch
QUAD = 10.0  # elements
MEMORY = 0.5  # weight of earlier batches in the pace; so the time of compilation is soon forgotten


Kind = tuple[str | float | None, ...]


def kind(case: Case) -> Kind:
    """The parameters that affect the pace most, besides the numbers of elements and steps."""
    loading, solver, lattice = case.loading, case.solver, case.lattice
    nodes = lattice.nodes_per_wall if isinstance(lattice, WallLattice) else 0
    errors = getattr(solver, "step_error", None), getattr(solver, "accuracy", None)
    platen = str(loading.platen)
    return loading.direction, loading.mode, platen, case.contact.model, nodes, *errors


def cost(case: Case) -> float:
    """Relative work of a case, steps x elements^1.5, accurate enough to sort and to weight cases.

    A quad of a plate counts as `QUAD` elements.
    """
    lattice = case.lattice
    elements = float(lattice.elements)
    if lattice.layers is not None:
        quarter = 0.25 if lattice.symmetry == "quarter" else 1.0
        elements *= QUAD * quarter * lattice.layers
    return count_of(case.loading, case.solver) * elements**1.5


class Plan:
    """Waiting cases, the longest first, so that no worker is left with a long one at the end.

    The first batch is the shortest case alone: it gives an early result and a first measure of the
    pace. Cases of equal length are sorted by lattice, which is then built once. A batch holds about
    `SECONDS` of work, less towards the end, and never more cases than have been measured, since a
    pace from few cases is uncertain. Threads may share a plan.
    """

    def __init__(self, cases: Sequence[Case], workers: int) -> None:
        self.workers = workers
        self._cases = cases
        self.work = defaultdict[Kind, float](float)  # of all cases
        keys = np.empty((len(cases), 2))
        for row, case in enumerate(cases):
            keys[row] = -cost(case), _mark(case)
            self.work[kind(case)] += cost(case)
        order = np.lexsort(keys.T[::-1])
        self._waiting: deque[int | Case] = deque(order.tolist())  # cases that are put back
        self.left = -float(keys[:, 0].sum())
        self._seconds = self._done = 0.0  # of recent batches: time taken, cost
        self._known = 0  # cases whose duration has been measured
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._waiting)

    def take(self) -> list[Case]:
        """The next batch; empty if no case is left."""
        with self._lock:
            batch = self._next() if self._waiting else []
            self.left -= sum(map(cost, batch))
            return batch

    def put_back(self, batch: Sequence[Case]) -> None:
        """Return a batch that has not run to the plan."""
        with self._lock:
            self._waiting.extendleft(reversed(batch))
            self.left += sum(map(cost, batch))

    def is_quick(self) -> bool:
        """True if no waiting case takes longer than a batch should."""
        with self._lock:
            longest = cost(self._first()) if self._waiting else 0.0
            return longest * self._seconds < SECONDS * self._done

    def learn(self, batch: Sequence[Case], seconds: float) -> None:
        """Update the pace with the duration of a batch on its worker."""
        with self._lock:
            self._known += len(batch)
            self._seconds = MEMORY * self._seconds + seconds
            self._done = MEMORY * self._done + sum(map(cost, batch))

    def _first(self) -> Case:
        """The first waiting case, which stays in its place."""
        first = self._waiting[0]
        if not isinstance(first, Case):
            first = self._waiting[0] = self._cases[first]
        return first

    def _next(self) -> list[Case]:
        if not self._done:
            self._waiting.rotate(1)
            batch = [self._first()]
            self._waiting.popleft()
            return batch
        full = SECONDS * self._done / max(self._seconds, 1e-9)
        limit = max(min(full, self.left / (2 * self.workers)), LEAST * full)
        batch, weight = list[Case](), 0.0
        while self._waiting and len(batch) < min(MOST, max(self._known, 1)):
            case = self._first()
            weight += cost(case)
            if batch and weight > limit:
                break
            batch.append(case)
            self._waiting.popleft()
        return batch


def _mark(case: Case) -> int:
    """A number that cases of the same lattice share."""
    return crc32(canonical(case.lattice).encode())
