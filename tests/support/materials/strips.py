"""A strip of a material with memory, stretched and released: its law in numpy, step by step."""

from math import erf

import numpy as np
from scipy.interpolate import PPoly
from scipy.optimize import brentq

from sweep.scene.material import stress_law
from sweep.scene.relaxation import relaxation_of


class Strip:
    """Stress (Pa) over strain of a strip that relaxes and softens on reuse (Ogden and Roxburgh).

    g_i, tau_i of a branch, s the instantaneous stress, s_i that which the branch has forgotten:

        stress = s - sum g_i s_i,   d s_i / dt = (s - s_i) / tau_i
    """

    def __init__(self, material, dt):
        law, relaxation = stress_law(material), relaxation_of(material)
        self.curve = PPoly(law.coefficients[:, ::-1].T * relaxation.instant, law.knots)
        self.energy = self.curve.antiderivative()
        self.material, self.shares = material, relaxation.shares
        self.m = (material.softening_m or 0.0) * relaxation.instant
        self.decay = np.exp(-dt / relaxation.times)
        self.gain = (1.0 - self.decay) * relaxation.times / dt
        self.instant, self.forgotten, self.most = 0.0, np.zeros_like(self.shares), 0.0

    def work(self, strain):
        """Energy of the instantaneous curve, J/m^3."""
        return float(self.energy(strain) - self.energy(0.0))

    def instantaneous(self, strain):
        """Stress of the curve, softened below the greatest energy so far."""
        stress, below = float(self.curve(strain)), self.most - self.work(strain)
        if self.material.softening_r is None or below <= 0.0:
            return stress
        width = self.m + self.material.softening_beta * self.most
        return stress * (1.0 - erf(below / width) / self.material.softening_r)

    def stress(self, strain):
        """Stress after a step in which s changes evenly, with s and s_i after it."""
        now = self.instantaneous(strain)
        lag = self.decay * (self.instant - self.forgotten) + self.gain * (now - self.instant)
        return now - float(self.shares @ (now - lag)), now, now - lag

    def step(self, strain):
        """Go to a strain; return the stress."""
        stress, self.instant, self.forgotten = self.stress(strain)
        self.most = max(self.most, self.work(strain))
        return stress


def pulled(material, strain, time, steps=50, cycles=2):
    """Work (J/m^3) of each cycle's loading and of its release.

    The ends move evenly, in ``time`` (s) each way. A strip that is longer than their distance hangs
    slack, without stress.
    """
    strip, works = Strip(material, time / steps), []
    ends = np.linspace(0.0, strain, steps + 1)
    at = pull = 0.0
    for way in [ends[1:], ends[-2::-1]] * cycles:
        works.append(0.0)
        for end in way:
            slack = strip.stress(end)[0] < 0.0
            now = brentq(lambda e: strip.stress(e)[0], end, strain) if slack else end
            stress = strip.step(now)
            works[-1] += 0.5 * (pull + stress) * (now - at)
            at, pull = now, stress
    return works
