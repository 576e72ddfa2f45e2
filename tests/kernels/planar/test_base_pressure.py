"""Forces on the base by node, and the greatest of them on a patch."""

import numpy as np
import pytest

from kernels.planar.base_pressure import force_on_base, greatest_on_patch
from tests.support.designs.scenes import run
from tests.support.kernels.solving import whole
from tests.support.kernels.states import SCENES, bent, struck
from tests.sweep.simulation.test_target import hit

BASES = ["free top", "loose platen", "loose and glued", "free base, glued", "free base, loose"]


def forces(name):
    """Step, state, its gradient, nodes that may press on the base, and their forces (N)."""
    scene = SCENES[name]()
    x = bent(scene)
    args = whole(scene, x)
    _, found = args.found(x)
    nodes = scene.standing
    pressing = [force_on_base(args.problem, x, found, p) for p in nodes]
    return scene, args, x, found, nodes, np.array(pressing)


@pytest.mark.parametrize("name", BASES)
def test_the_forces_of_nodes_sum_to_that_on_the_base(name):
    scene, _, _, found, _, pressing = forces(name)
    low = scene.terms.contact.low
    total = sum(found.elastic[c] if c == low else found.g[c] for c in scene.bottom)
    assert np.count_nonzero(pressing) > 1
    assert pressing.sum() == pytest.approx(total, rel=1e-12)


@pytest.mark.parametrize("width", [1e-4, 5e-3, 1.0])
@pytest.mark.parametrize("name", BASES)
def test_no_patch_has_more_force(name, width):
    """Among patches all along the base; each force acts over the thickness of its wall."""
    scene, args, x, found, nodes, pressing = forces(name)
    place, t = x[2 * nodes], scene.terms.contact.node_thickness[nodes]
    knots = [place + side * span for side in (-0.5, 0.5) for span in (width + t, width - t)]
    centres = np.concatenate([*knots, np.linspace(place.min() - width, place.max() + width, 999)])
    low = np.maximum(place - 0.5 * t, centres[:, None] - 0.5 * width)
    high = np.minimum(place + 0.5 * t, centres[:, None] + 0.5 * width)
    shares = np.clip(high - low, 0.0, None) / t
    sums = shares @ pressing
    greatest, at = greatest_on_patch(
        args.problem, x, found, nodes.copy(), np.zeros((nodes.size, 3)), width
    )
    assert greatest == pytest.approx(sums.max(), rel=1e-9)
    assert greatest > 0.0
    middles = (shares * 0.5 * (low + high)) @ pressing / greatest
    best = np.isclose(sums, greatest, rtol=1e-9)
    assert np.abs(middles - at)[best].min() < 1e-12
    assert np.abs(centres - at)[best].min() <= 0.5 * width * (1.0 + 1e-9)


@pytest.mark.parametrize("target", [None, 0.2])
def test_a_patch_as_wide_as_the_lattice_bears_all(target):
    """It bears the force of loose walls, which do not pull, in every row of a run."""
    case = hit("contact", target)
    history = run(case.changed(loading={"base_patch": 1.0})).history
    width, depth = case.footprint
    force = width * depth * history["base_pressure_Pa"]
    np.testing.assert_allclose(force, history["reaction_bottom_N"], rtol=1e-9, atol=1e-12)
    narrow = run(case).summary["peak_base_pressure_Pa"]
    assert narrow > 1.2 * history["base_pressure_Pa"].max()
    assert narrow < width / case.loading.base_patch * history["base_pressure_Pa"].max()


def test_a_base_that_moves_is_borne_by_its_inertia():
    """The row glued to the base follows it in y; coordinates without mass in y have no leader."""
    scene = struck("glued")
    layout, low = scene.terms.layout, scene.terms.contact.low
    bottom = np.flatnonzero(layout.leader == low)
    assert scene.terms.coordinates.mass[low] == 0.2
    assert set(bottom) == set(scene.bottom)
    assert layout.point[low] == layout.point[low + 1]
    assert layout.slot[low] != layout.slot[low + 1]
