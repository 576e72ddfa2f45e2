"""Which nodes get room in the matrix: nodes of springs, and of walls that are almost in contact."""

import numpy as np
import pytest

from kernels.compile.reference import referred
from kernels.geometry import near_pairs
from kernels.planar.couplings import MARGIN, couplings
from kernels.terms import bend, friction
from kernels.terms.damping import Damp
from kernels.terms.spring import Spring
from tests.support.kernels.frames import (
    NO_SPRINGS,
    linear_law,
    point_of,
    terms_of,
    touching,
    two_walls,
)

T = 0.8


def coupled(gap, springs=NO_SPRINGS):
    """Sets of nodes that get room where two walls, 0.8 thick, are ``gap`` apart."""
    of = two_walls(gap, (1, 1))
    law, undamped = point_of(linear_law(of.modulus)), Damp(0.0, 0.0, 0.0)
    scene = referred(terms_of(of, law, bend.ANGLE, undamped))
    scene = scene._replace(contact=touching(of), spring=springs)
    found = near_pairs.find(of.rest, scene.contact, 3.0 * scene.contact.reach)
    assert found.node.size > 0
    return {frozenset(nodes) for nodes in couplings(of.rest, scene, found, friction.none())}


@pytest.mark.parametrize(("share", "count"), [(0.5, 4), (0.99, 4), (1.1, 0)])
def test_walls_get_room_before_they_touch(share, count):
    """Each of four nodes with the wall across; distances are rounded down."""
    assert len(coupled(share * (1.0 + MARGIN) * T)) == count


def test_springs_have_room_however_long_they_are():
    springs = Spring(np.array([[0, 3], [2, 1]]), np.ones(2), np.ones(2))
    assert coupled(2.0 * T, springs) == {frozenset((0, 3)), frozenset((1, 2))}
