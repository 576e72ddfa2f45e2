"""The march of a case alone, without building its scene and reading off results."""

from typing import NamedTuple

import numpy as np

from kernels.shared.rows import ROW, Output
from kernels.solve import history, march, outcomes
from sweep.scene.loading import stages, tolerances
from tests.studies.bench.measuring.clock import seconds
from tests.support.kernels.solving import at_rest, ramp

SAMPLE = 5e-3  # s of marches in a sample


class Spent(NamedTuple):
    """CPU seconds and Newton iterations of a march."""

    seconds: float
    iterations: int

    @property
    def each(self):
        """Seconds an iteration."""
        return self.seconds / self.iterations


def whole(case, scene):
    """March through all stages of a case, from rest."""
    return go(case, scene, at_rest(scene), [stretch.stage for stretch in stages(case, scene)])


def press(case, scene, state, strain, steps):
    """March a state from one strain to another (``strain``: a pair); it is changed in place."""
    low, high = (case.lattice.height * e for e in strain)
    return go(case, scene, state, [ramp(scene, steps, travel=(low, high))])


def go(case, scene, state, ramps):
    """March ``state`` through stages."""
    before, spent = state.totals[0].iterations, 0.0
    for stage in ramps:
        out = Output(
            np.zeros(stage.steps, ROW), np.full(stage.steps, -1),
            np.zeros((0, state.x.size)), scene.bottom, scene.top, scene.base,
            scene.probes, np.zeros((stage.steps, 2, scene.probes.size)),
            scene.standing, np.zeros((scene.standing.size, 3)), 0.0,
        )  # fmt: skip
        allowed = tolerances(case, scene, stage)
        given = (scene.terms, allowed, stage, state, out, np.zeros(2, np.int64))
        ended = []
        spent += seconds(lambda given=given, out=ended: out.append(march.march(*given)))
        if ended[0][0] != outcomes.CONVERGED:
            raise RuntimeError(f"the march of {case.case_id} did not converge: {ended[0]}")
    return Spent(spent, int(state.totals[0].iterations - before))


def sustained(march):
    """Seconds an iteration of a march, repeated until caches are warm and a sample is full."""
    march()
    runs = [march()]
    while sum(run.seconds for run in runs) < SAMPLE:
        runs.append(march())
    return sum(run.seconds for run in runs) / sum(run.iterations for run in runs)


def copied(state):
    """A state to march on from, again and again."""
    rates, gradients = (type(part)(*(array.copy() for array in part)) for part in state[3:5])
    x, v, lagged, *rest = (array.copy() for array in (*state[:3], *state[5:]))
    return history.State(x, v, lagged, rates, gradients, *rest)
