"""How far a step may go: nothing meets, folds or shrinks to nothing, however far it wants to."""

from dataclasses import replace

import numpy as np
import pytest

from kernels.geometry import ccd, near_pairs
from kernels.planar import neighbour_lists
from kernels.shared.moves import ADVANCE
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from tests.support.kernels.solving import whole
from tests.support.kernels.states import GRIP, STATES, loaded, nodes, unit


def moving(scene, which, by):
    """A move of one node by (dx, dy), or of the upper platen by dy."""
    dx = np.zeros(scene.x_rest.size)
    if which is None:
        dx[-1] = by
    else:
        nodes(scene, dx)[which] = by
    return dx


def node_at(scene, x, y):
    return np.argmin(np.linalg.norm(scene.mesh.points - (x, y), axis=1))


def one_cell(platen):
    """A cell of 10 mm with walls of two elements; without a platen, without contact."""
    return build_scene(
        Case.of(
            lattice=dict(
                cells_x=1, cells_y=1, nodes_per_wall=1, width=0.01, height=0.01, imperfection=0.0
            ),
            loading=dict(platen=platen),
            contact=dict(model="none" if platen == "none" else "barrier"),
            solver=dict(joints="points"),
        )
    )


@pytest.mark.parametrize(
    ("platen", "start", "by", "share"),
    [
        ("contact", (0.0, 5e-3), (1e-3, 0.0), 1.0),  # nothing in the way
        ("contact", (0.0, 5e-3), (20e-3, 0.0), 0.9 * 0.5),  # to the opposite wall
        ("none", (0.0, 5e-3), (20e-3, 0.0), 1.0),  # through it
        ("none", (0.0, 5e-3), (0.0, 10e-3), 0.9 * 0.5),  # along its wall: a tenth is left
        ("none", (0.0, 5e-3), (10e-3, -10e-3), 0.9 * 0.5),  # until a corner closes
        ("contact", (5e-3, 0.0), (0.0, -8e-4), 0.9 * 0.5),  # through the lower platen
        ("contact", None, -8e-4, 0.9 * 0.5),  # the upper platen through a wall
    ],
)
def test_limits_of_a_step(platen, start, by, share):
    scene = one_cell(platen)
    which = None if start is None else node_at(scene, *start)
    args, dx = whole(scene, scene.x_rest, reach=0.03), moving(scene, which, by)
    assert args.limit(scene.x_rest, dx) == pytest.approx(share, rel=1e-9)


@pytest.mark.parametrize("share", [1.0, 0.4])
def test_moves_are_as_long_as_lists_may_cover(share):
    scene = one_cell("contact")
    dx = moving(scene, node_at(scene, 0.0, 5e-3), (5e-3, 0.0))
    touch = scene.terms.contact._replace(most_move=share * 5e-3)
    scene = replace(scene, terms=scene.terms._replace(contact=touch))
    args = whole(scene, scene.x_rest)
    assert args.limit(scene.x_rest, dx) == pytest.approx(share, rel=1e-9)


def hits(scene, x, dx):
    """Shares at which parts of a scene meet or fold, and shares at which elements are short."""
    terms, high, low = scene.terms, x.size - 1, x.size - 2
    has_contact = len(terms.contact.edges) > 0
    everything = near_pairs.find(x, terms.contact, 1.0) if has_contact else near_pairs.empty()
    near = zip(everything.node, terms.contact.edges[everything.edge], strict=True)
    met = [ccd.first_contact(x, dx, p, a, b) for p, (a, b) in near]
    met += [ccd.first_fold(x, dx, a, b, c) for a, b, c in terms.fold.nodes]
    for p in terms.contact.platen_nodes:
        gaps = x[2 * p + 1] - x[low], x[high] - x[2 * p + 1]
        closing = dx[low] - dx[2 * p + 1], dx[2 * p + 1] - dx[high]
        met += [gap / way for gap, way in zip(gaps, closing, strict=True) if way > 0.0]
    short = [
        ccd.first_shrink(x, dx, a, b, neighbour_lists.LEAST_LENGTH) for a, b in terms.walls.edges
    ]
    return np.array(met), np.array(short)


@pytest.mark.parametrize("contact", [GRIP, dict(model="none")], ids=["contact", "no contact"])
@pytest.mark.parametrize("state", ["rest", *STATES])
def test_the_bounds_of_a_step_miss_nothing(state, contact):
    """Walls meet, corners close and elements shrink, in moves of any size."""
    scene = loaded(contact=contact, platen="none" if contact.get("model") == "none" else "contact")
    x = scene.x_rest if state == "rest" else STATES[state](scene)
    args, limited = whole(scene, x, reach=0.1), 0
    for seed in range(60):
        rng = np.random.default_rng(seed)
        dx = unit(scene) * 10.0 ** rng.uniform(-2.5, 0.5) * rng.uniform(-1, 1, x.size)
        met, short = hits(scene, x, dx)
        least = min(1.0, ADVANCE * met.min(), short.min())
        most = min(1.0, ADVANCE * met[met <= 1.0].min(initial=np.inf), short.min())
        assert least * (1 - 1e-12) <= args.limit(x, dx) <= most * (1 + 1e-12)
        limited += most < 1.0
    assert 5 < limited < 60
