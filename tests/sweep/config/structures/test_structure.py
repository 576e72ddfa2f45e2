"""Structures as their files give them: one value for all walls or nodes, or one for each."""

import pytest

from sweep.config.structures.structure import Structure

NODES = ((0.0, -2.0), (3.0, 1.0), (-4.0, 0.0))
WALLS = ((0, 1), (1, 2))


def structure(**parts):
    return Structure(nodes_mm=NODES, walls=WALLS, **parts)


@pytest.mark.parametrize(
    ("key", "read", "one", "each"),
    [
        ("wall_thickness_mm", "thickness_mm", 0.5, (0.5, 0.7)),
        ("subdivide", "pieces", 3, (3, 1)),
        ("initial_velocity_mm_s", "velocity_mm_s", (1.0, 2.0), ((1.0, 2.0),) * 2 + ((0.0, 0.0),)),
    ],
)
def test_one_value_stands_for_each(key, read, one, each):
    assert getattr(structure(**{key: one}), read) == (one,) * len(each)
    assert getattr(structure(**{key: each}), read) == each


def test_all_walls_become_thicker_by_one_factor():
    assert structure(wall_thickness_mm=0.5).with_thickness(0.8).thickness_mm == (0.8, 0.8)
    uneven = structure(wall_thickness_mm=(0.5, 1.5)).with_thickness(2.0)
    assert uneven.thickness_mm == (1.0, 3.0)
    assert uneven.nodes_mm == NODES


def test_extent_is_that_of_the_nodes():
    assert structure().size_mm == (7.0, 3.0)


def test_what_is_held_is_told_by_node_and_direction():
    fixed = [{"node": 0, "fix": ("x", "y")}, {"node": 2, "fix": ("y",)}]
    found = Structure.model_validate({"nodes_mm": NODES, "walls": WALLS, "supports": tuple(fixed)})
    assert found.restraints == {(0, "x"), (0, "y"), (2, "y")}
    assert structure().restraints == set()
