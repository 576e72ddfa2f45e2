"""Laws with a memory, and single material points that follow a path of strains."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from kernels.laws.elastic import ElasticCurve
from kernels.laws.fibre import Fibre
from kernels.laws.law import Memory
from kernels.laws.relaxation import Relaxing
from kernels.laws.softening import Softening
from kernels.laws.yielding import Yielding
from sweep.scene.material import as_law, stress_law
from tests.support.designs.tables import material_with

NO_SOFTENING = (0.0, 0.0, 0.0)


class Path(NamedTuple):
    """Values of a point after each step: stress, work by the trapezoidal rule, stored energy, and
    dissipation so far; (steps,) each.
    """

    stress: np.ndarray
    work: np.ndarray
    stored: np.ndarray
    dissipated: np.ndarray

    @property
    def gap(self):
        """Largest gap of the book of all steps, as a share of the most work."""
        return np.abs(self.work - self.stored - self.dissipated).max() / np.abs(self.work).max()


def relaxing(curve: ElasticCurve, shares=(), times=(), softening=NO_SOFTENING) -> Fibre:
    """A law that relaxes and softens: 1 / r, m, beta."""
    branches = np.array(shares, float), np.array(times, float)
    law = Relaxing(Softening(curve, *softening), *branches, curve.modulus)
    elastic = len(shares) == 0 and softening == NO_SOFTENING
    return Fibre(
        relaxing=law,
        yielding=Yielding(curve.modulus, 0.0, 0.0, 0.0),
        modulus=curve.modulus,
        is_elastic=elastic,
    )


def measured(name="ninjaflex"):
    """The curve of a shipped material, in MPa."""
    material = material_with(name=name)
    return as_law(stress_law(material), 1e-6, material.modulus)


def virgin(law, points=1, line=2) -> Memory:
    """The memory of some points at rest, with a ``line`` of numbers of the step for each."""
    size = law.state_size()
    return Memory(np.zeros((points, size)), np.zeros((points, line)), law.make_pace())


def prepare(law, memory: Memory, duration: float) -> None:
    """Prepare the first point for a step."""
    law.set_pace(duration, memory.pace)
    law.begin(memory, 0)


def follow(law: Fibre, strains, durations, memory=None) -> Path:
    """Follow a path of strains (steps,) from rest, or from a memory, in steps of ``durations``."""
    memory = virgin(law) if memory is None else memory
    rows, work, lost, before, last = [], 0.0, 0.0, 0.0, 0.0
    for strain, duration in zip(strains, np.broadcast_to(durations, len(strains)), strict=True):
        prepare(law, memory, duration)
        potential, stress, _ = law.respond(strain, memory, 0)
        work += 0.5 * (before + stress) * (strain - last)
        released, dissipated = law.commit(strain, memory, 0)
        stored = potential - released
        lost, before, last = lost + dissipated, stress, strain
        rows.append((stress, work, stored, lost))
    return Path(*np.array(rows).T)


def there_and_back(strain: float, steps: int) -> np.ndarray:
    """Even steps to a strain and back, (2 steps,)."""
    up = np.linspace(0.0, strain, steps + 1)
    return np.concatenate([up[1:], up[-2::-1]])


def pulled(law: Fibre, strain: float, time: float, steps=50, cycles=2) -> list[float]:
    """Work (J/m^3) of each cycle's loading of a strip, and of its release.

    The ends move evenly, in ``time`` (s) each way. A strip that is longer than their distance hangs
    slack, without stress.
    """
    memory, works, at, pull = virgin(law), [], 0.0, 0.0
    ends = np.linspace(0.0, strain, steps + 1)
    for way in [ends[1:], ends[-2::-1]] * cycles:
        works.append(0.0)
        for end in way:
            prepare(law, memory, time / steps)
            slack = law.respond(end, memory, 0)[1] < 0.0
            now = brentq(lambda e: law.respond(e, memory, 0)[1], end, strain) if slack else end
            stress = law.respond(now, memory, 0)[1]
            law.commit(now, memory, 0)
            works[-1] += 0.5 * (pull + stress) * (now - at)
            at, pull = now, stress
    return works
