"""Scenes with strikers and ribs: where they touch at rest, held rows, and contact."""

import numpy as np
import pytest

from kernels.terms import profile
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from sweep.scene.profiles import gripped

HEX = dict(kind="hex", cells_x=4, cells_y=3, width=16e-3, imperfection=0.0)
RIBS = dict(base="ribs", base_span=9e-3)


def scene_of(mode="displacement", lattice=HEX, **loading):
    return build_scene(Case.of(lattice=lattice, loading=dict(mode=mode) | loading))


@pytest.mark.parametrize("at", [0.0, 0.3, 0.5, 1.0])
@pytest.mark.parametrize("striker", ["round", "edge", "punch"])
def test_a_striker_touches_the_lattice_at_rest(striker, at):
    """It touches the surface of a wall, half a thickness off its centre line, no higher than a
    plate.
    """
    scene, flat = scene_of(striker=striker, striker_at=at), scene_of()
    touch = scene.terms.contact
    assert profile.least_gap(scene.x_rest, touch.profiles) == pytest.approx(0.4e-3, abs=1e-9)
    assert profile.evaluate(scene.x_rest, touch.profiles, 1.0, np.zeros_like(scene.x_rest)) < 1e-20
    assert scene.x_rest[-1] <= flat.x_rest[-1] + 1e-12
    assert scene.x_rest[-2] == flat.x_rest[-2]


def test_ribs_touch_from_below_and_carry_both_sides():
    scene = scene_of(**RIBS)
    touch = scene.terms.contact
    assert (touch.low_away, touch.high_away) == (np.inf, 0.0)
    assert touch.profiles.carrier.tolist() == [touch.low] * 2
    assert profile.least_gap(scene.x_rest, touch.profiles) == pytest.approx(0.4e-3, abs=1e-9)
    middle = 0.5 * (scene.network.points[:, 0].min() + scene.network.points[:, 0].max())
    assert touch.profiles.vertex[[0, 2], 0] - middle == pytest.approx([-4.5e-3, 4.5e-3])


def test_the_lattice_stands_on_its_base_alone():
    glued, loose = scene_of(striker="round"), scene_of(striker="round", platen="contact")
    low, high = glued.terms.contact.low, glued.terms.contact.high
    row = len(glued.bottom) - 1  # without the base
    for scene, held in ((glued, 3 * row + 1), (loose, 2)):  # loose: and a node, sideways
        leader = scene.terms.layout.leader
        assert np.sum(leader < 0) == held
        assert np.all(leader[leader >= 0] == np.flatnonzero(leader >= 0))
        assert leader[high] == high
        assert leader[low] == -1
    assert glued.terms.contact.high_away == np.inf
    assert gripped(Case.of(loading=dict(mode="force", platen="none")).loading) == "none"


def test_only_statics_need_a_node_that_is_held():
    moving = scene_of("impact", striker="round", platen="contact").terms.layout.leader
    assert np.sum(moving < 0) == 1


def test_a_flat_scene_has_no_profiles():
    assert scene_of().terms.contact.profiles.radius.size == 0


def test_a_tip_has_the_weight_that_nodes_miss():
    """l^2 / (8 (r + t_c) t_c) of an element; none where a vertex is only an end."""
    scene = scene_of(striker="edge", striker_tip=1e-3)
    length, starts = scene.mesh.rest_length.mean(), 0.4e-3
    share = length**2 / (8.0 * (1e-3 + starts) * starts)
    assert scene.terms.contact.profiles.weight == pytest.approx([0.0, share * length, 0.0])
