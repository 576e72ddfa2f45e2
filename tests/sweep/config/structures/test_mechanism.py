"""Mechanisms: motions without resistance, in frames, in trusses, and by a hair."""

import pytest

from sweep.config.structures.mechanism import find_mechanism
from tests.support.designs.structures import structure

FEET = [{"node": 0, "fix": ["x", "y"]}, {"node": 1, "fix": ["y"]}]
FOUR_BARS = {"nodes_mm": [[0, 0], [10, 0], [10, 10], [0, 10]], "pins": [0, 1, 2, 3]}
FOUR_BARS |= {"walls": [[0, 1], [1, 2], [2, 3], [3, 0]], "supports": FEET}
BAR = {"nodes_mm": [[0, 0], [10, 0]], "walls": [[0, 1]]}
FLAT_ARCH = {"walls": [[0, 1], [1, 2]], "pins": [0, 1, 2]}
FLAT_ARCH |= {"supports": [{"node": node, "fix": ["x", "y"]} for node in (0, 2)]}


def spring(*nodes):
    return {"springs": [{"nodes": list(nodes), "stiffness_N_mm": 1.0}]}


@pytest.mark.parametrize(
    "parts",
    [
        {"pins": [0, 1]},  # two rigid corners
        {"walls": [*FOUR_BARS["walls"], [0, 2]]},
        spring(1, 3),
        {"prescribed": [{"node": 2, "direction": "x", "displacement_mm": 1.0}]},
    ],
)
def test_four_bars_stand_with_one_tie_more(parts):
    assert find_mechanism(structure(**FOUR_BARS)) == "node 2 can move in x without resistance"
    assert find_mechanism(structure(**FOUR_BARS | parts)) == ""


def test_a_spring_along_a_bar_holds_nothing():
    assert find_mechanism(structure(**FOUR_BARS | spring(1, 2))) != ""


@pytest.mark.parametrize(
    ("supports", "loose"),
    [
        ([], "node 1 can move in y"),
        ([{"node": 0, "fix": ["x", "rotation"]}], "node 0 can move in y"),
        ([{"node": 0, "fix": ["x", "y"]}], "node 1 can move in y"),
        ([{"node": k, "fix": ["y"]} for k in (0, 1)], "node 0 can move in x"),
        (FEET, ""),
    ],
)
def test_a_bar_has_three_ways_to_move(supports, loose):
    found = find_mechanism(structure(**BAR, supports=supports))
    assert found == (f"{loose} without resistance" if loose else "")


def test_a_flat_arch_moves_by_a_hair_and_one_with_a_rise_does_not():
    for rise, found in ((0, "node 1 can move in y without resistance"), (1, "")):
        nodes = [[0, 0], [10, rise], [20, 0]]
        assert find_mechanism(structure(**FLAT_ARCH, nodes_mm=nodes)) == found
