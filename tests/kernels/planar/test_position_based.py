"""Contact by position: which nodes are moved, how far, and the effect on momentum and energy."""

import numpy as np
import pytest

from kernels.geometry import near_pairs
from kernels.geometry.distance import squared_distance
from kernels.planar import position_based
from kernels.terms import contact
from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from tests.support.designs.scenes import run, unbalanced
from tests.support.designs.tables import MATERIAL, lattice_with
from tests.support.kernels.frames import touching, two_walls

APART = 1.0 - 1e-5  # of the thickness
BY_POSITION = dict(model="position_based")


def moved(gap, shift, ease):
    """Two walls, 0.8 thick and ``gap`` apart, moved apart: where they were, and are."""
    walls = two_walls(gap, shift=shift)
    x, contacts = walls.rest.copy(), touching(walls)
    listed = near_pairs.find(x, contacts, 2.0 * contacts.reach)
    projection = position_based.Projection(contacts, np.broadcast_to(ease, x.shape).copy())
    changed = position_based.move_apart(x, projection, listed)
    nearest = contact.least_gap(
        x, contacts, near_pairs.find(x, contacts, 2.0 * contacts.reach), 0.0
    )
    return walls.rest, x, changed, nearest


@pytest.mark.parametrize("gap", [0.1, 0.5, 0.79])
@pytest.mark.parametrize("shift", [0.0, 0.7])
def test_walls_are_moved_to_their_thickness_and_no_farther(gap, shift):
    rest, x, changed, nearest = moved(gap, shift, 1.0)
    assert changed
    assert nearest == pytest.approx(0.8, rel=1e-5)
    assert np.abs(x - rest).max() < 0.8 - gap + 1e-9
    rest, x, changed, _ = moved(0.81, shift, 1.0)
    assert not changed
    np.testing.assert_array_equal(x, rest)


@pytest.mark.parametrize("tau", [0.0, 0.25, 0.9])
def test_one_pair_is_moved_apart_at_once(tau):
    """Along the normal, by masses and levers of its three nodes."""
    x, ease = np.array([tau, 0.1, 0.0, 0.0, 1.0, 0.0]), np.array([9.0, 1.0, 9.0, 2.0, 9.0, 0.5])
    assert position_based._separate(x, ease, 0, 1, 2, 0.2)
    assert x[1] - (1.0 - tau) * x[3] - tau * x[5] == pytest.approx(0.2, rel=1e-12)
    np.testing.assert_allclose(x[::2], [tau, 0.0, 1.0], rtol=1e-12)


def test_momentum_is_kept_whatever_the_masses():
    """And what is held stays."""
    ease = np.random.default_rng(1).uniform(0.5, 2.0, moved(0.5, 0.3, 1.0)[0].size)
    rest, x, _, nearest = moved(0.5, 0.3, ease)
    shifts = ((x - rest) / ease)[: 2 * 8]
    assert nearest > 0.8 * APART
    np.testing.assert_allclose(shifts[0::2].sum(), 0.0, atol=1e-12)
    np.testing.assert_allclose(shifts[1::2].sum(), 0.0, atol=1e-12)
    assert np.abs(shifts).max() > 0.05
    ease[:4] = 0.0
    rest, x, _, nearest = moved(0.5, 0.3, ease)
    np.testing.assert_array_equal(x[:4], rest[:4])
    assert nearest > 0.8 * APART


@pytest.mark.parametrize(("platen", "side"), [(-2, 1.0), (-1, -1.0)], ids=["lower", "upper"])
def test_a_platen_keeps_half_a_thickness_from_all_nodes(platen, side):
    """One that is nearer, or beyond it, is moved straight away from the platen."""
    walls = two_walls(2.0)
    x, contacts = walls.rest.copy(), touching(walls)
    x[-2:] = -50.0, 50.0
    x[platen] = 1.0 - side
    x[1] = x[platen] - 0.1 * side
    nodes, ease = x[:-2].copy(), np.ones(x.size)
    near = side * (x[contacts.platen_nodes * 2 + 1] - x[platen]) < 0.4
    assert 0 < near.sum() < near.size
    assert position_based._leave_platens(x, contacts, ease)
    assert not position_based._leave_platens(x, contacts, ease)
    gaps = side * (x[contacts.platen_nodes * 2 + 1] - x[platen])
    np.testing.assert_allclose(gaps[near], 0.4, rtol=1e-12)
    np.testing.assert_array_equal(x[:-2][0::2], nodes[0::2])
    np.testing.assert_array_equal(gaps[~near], 2.0)


@pytest.mark.parametrize("kind", ["square", "hex", "triangle", "reentrant", "diamond"])
def test_joints_at_rest_are_no_contacts(kind):
    lattice = lattice_with(kind=kind, nodes_per_wall=7)
    scene = build_scene(Case.of(lattice=lattice, contact=BY_POSITION))
    x, touch = scene.x_rest.copy(), scene.terms.project.contact
    listed = near_pairs.find(x, touch, 2.0 * touch.reach)
    assert not position_based.move_apart(x, scene.terms.project, listed)
    assert np.any(listed.distance < lattice.wall_thickness)


def dropped(model="position_based", force=15.0, time_step=2e-4, duration=0.016):
    """A dead load under which rows land on one another, let go at three quarters of the time."""
    return Case.of(
        lattice=dict(nodes_per_wall=2),
        material=MATERIAL,
        loading=dict(force=force, release_time=0.75 * duration, duration=duration),
        contact=dict(model=model, friction=0.0),
        damping={},
        solver=dict(time_step=time_step, element="classical"),
    )


def test_energies_of_a_step_are_those_of_where_it_was_moved_to():
    """Motion from the shapes alone, (x' - x) / dt, and stretching from the lengths in them."""
    case = dropped(force=14.0, duration=6e-3)
    result, scene = run(case), build_scene(case)
    history, frames = result.history, result.frames
    assert len(frames["time_s"]) == len(history["time_s"]) == result.summary["steps"] + 1
    assert history["injected_by_projection_J"].any()
    dt = np.diff(history["time_s"])
    step = np.diff(frames["position_m"], axis=0) / dt[:, None, None]
    share = scene.terms.coordinates.mass[: 2 * step.shape[1]].reshape(-1, 2)
    kinetic = 0.5 * np.sum(share * step**2, axis=(1, 2))
    np.testing.assert_allclose(kinetic, history["kinetic_J"][1:], rtol=1e-9)
    ends = frames["position_m"][:, frames["edges"]]
    length = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=-1)
    energy = 0.5 * MATERIAL.modulus * scene.terms.stretch.area / length[0]
    stored = np.sum(energy * (length - length[0]) ** 2, axis=1)
    linear = np.all(length > 0.3 * length[0], axis=1)  # a guard acts below
    assert linear.sum() > 20
    np.testing.assert_allclose(stored[linear], history["stretch_J"][linear], rtol=1e-9, atol=1e-15)


def test_book_closes_with_what_is_injected():
    """Without contact nothing is."""
    apart = run(dropped(force=5.0))
    assert not apart.history["injected_by_projection_J"].any()
    assert apart.summary["injected_by_projection_J"] == 0.0
    history = run(dropped()).history
    injected = history["injected_by_projection_J"]
    assert np.abs(injected).max() > 0.1 * history["work_in_J"].max()
    assert unbalanced(history) < 1e-6
    assert not history["contact_J"].any()
    loaded = history["time_s"] < 0.0121
    work = 15.0 * history["top_displacement_m"]
    np.testing.assert_allclose(history["work_in_J"][loaded], work[loaded], rtol=1e-9)


def test_walls_end_no_closer_than_where_they_touch():
    """That is their thickness, or less for pairs near a joint."""
    case = dropped(time_step=2e-5)
    touch, least = build_scene(case).terms.project.contact, np.inf
    for position in run(case).frames["position_m"][::20]:
        x = position.ravel()
        listed = near_pairs.find(x, touch, touch.reach)
        ends = touch.edges[listed.edge]
        rows = zip(listed.node, ends, listed.d_contact, strict=True)
        near = [squared_distance(x, p, *ends) ** 0.5 / dc for p, ends, dc in rows if dc > 0.0]
        least = min([least, *near])
    assert 0.98 < least < 1.0


def test_a_glued_platen_stops_what_is_not_glued_to_it():
    tables = {"contact": BY_POSITION, "material": MATERIAL}
    loading = dict(strain=0.6, speed=1.0, unload=False)
    result = run(Case.of(loading=loading, solver=dict(load_steps=2000), **tables))
    y, plates = result.frames["position_m"][..., 1], result.frames["plate_y_m"]
    assert result.status == "converged"
    assert y[-1].min() >= plates[-1, 0] + 0.4e-3 * APART
    assert np.sort(y[-1])[-5] <= plates[-1, 1] - 0.4e-3 * APART
    assert unbalanced(result.history) < 1e-6


def test_energy_that_it_injects_falls_with_the_time_step():
    """It falls more than in proportion, as each step pushes back the overlap of one step."""
    injected = [
        run(dropped(time_step=dt)).history["injected_by_projection_J"][-1]
        for dt in (5e-5, 2.5e-5, 1.25e-5)
    ]
    assert injected[0] > 2.0 * injected[1] > 4.0 * injected[2] > 0.0
