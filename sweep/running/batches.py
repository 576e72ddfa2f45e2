"""The order and the size of batches: what a worker that has nothing to do gets next."""

import threading
from collections import deque
from collections.abc import Iterable, Sequence

from sweep.config.case import Case
from sweep.config.solver_defaults import steps
from sweep.config.tables import canonical

SECONDS = 1.0  # of work in a batch: far above the cost of passing it on, and soon done
LEAST = 0.05  # of that, when little is left to share out
MOST = 500  # cases in a batch
MEMORY = 0.5  # weight of what is known of the pace against the newest batch: compiling is forgotten


def cost(case: Case) -> float:
    """Work of a case, steps x elements^1.5: no time, but good enough to sort and to weigh by."""
    elements = case.lattice.walls * (case.lattice.nodes_per_wall + 1)
    return steps(case.loading, case.solver) * elements**1.5


class Plan:
    """Cases that wait, the longest first, so that no worker is left with a long one at the end.

    The first to go is the shortest, for a result at once and a first measure of the pace. Of those
    as long, the ones of a lattice follow one another: it is built once. Batches hold about
    `SECONDS` of work, and less towards the end; no more cases than have told of the pace, as the
    first of them says little of it. Threads may share a plan.
    """

    def __init__(self, cases: Iterable[Case], workers: int) -> None:
        self.workers = workers
        ordered = sorted(cases, key=lambda case: (-cost(case), canonical(case.lattice)))
        self._waiting = deque(ordered)
        self._left = sum(map(cost, self._waiting))
        self._seconds = self._done = 0.0  # of recent batches: time taken, cost
        self._known = 0  # cases that have told of the pace
        self._lock = threading.Lock()

    def __len__(self) -> int:
        return len(self._waiting)

    def take(self) -> list[Case]:
        """The next batch; empty when no case is left."""
        with self._lock:
            batch = self._next() if self._waiting else []
            self._left -= sum(map(cost, batch))
            return batch

    def learn(self, batch: Sequence[Case], seconds: float) -> None:
        """Note how long a batch took on its worker."""
        with self._lock:
            self._known += len(batch)
            self._seconds = MEMORY * self._seconds + seconds
            self._done = MEMORY * self._done + sum(map(cost, batch))

    def _next(self) -> list[Case]:
        if not self._done:
            return [self._waiting.pop()]
        full = SECONDS * self._done / max(self._seconds, 1e-9)
        room = max(min(full, self._left / (2 * self.workers)), LEAST * full)
        batch = [self._waiting.popleft()]
        weight = cost(batch[0])
        while self._waiting and len(batch) < min(MOST, self._known):
            weight += cost(self._waiting[0])
            if weight > room:
                break
            batch.append(self._waiting.popleft())
        return batch
