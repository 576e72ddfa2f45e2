"""Crushes that were taken to where they are watched, and go on from there again and again."""

from sweep.scene.lattice import build_scene
from tests.studies.bench.measuring import cases
from tests.studies.bench.measuring.marching import copied, press, sustained
from tests.support.kernels.solving import at_rest

APPROACH = 0.005  # strain of a step on the way there
BUCKLED, COLLAPSED = (0.05, 0.1), (0.55, 0.6)


class Crush:
    """Cells by cells pressed to the first strain of ``span``, to go on in ``steps``."""

    def __init__(self, cells, contact=cases.APART, span=BUCKLED, steps=10):
        self.span, self.steps = span, steps
        self.case = cases.crush(cells, span[1], steps, contact)
        self.scene = build_scene(self.case)
        self.state = at_rest(self.scene)
        approach = max(round(span[0] / APPROACH), 1)
        press(self.case, self.scene, self.state, (0.0, span[0]), approach)

    def onwards(self):
        """Time and iterations from there to the second strain, and the state at the end."""
        state = copied(self.state)
        return press(self.case, self.scene, state, self.span, self.steps), state

    def each(self):
        """Seconds an iteration."""
        return sustained(lambda: self.onwards()[0])
