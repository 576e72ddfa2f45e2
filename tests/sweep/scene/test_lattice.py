"""The arrays of a case: masses, loads, supports, contact, and what is left out."""

import numpy as np
import pytest

from kernels.solve.problem import HELD
from sweep.config.case import Case, Contact, Damping, Lattice, Loading, Material, Solver
from sweep.design.network import mass
from sweep.scene.lattice import build_scene
from sweep.scene.terms import plane_factors
from sweep.simulation.simulate import simulate
from tests.studies.verify import MATERIAL

DEPTH, THICKNESS, WALL = 12e-3, 0.8e-3, 12.5e-3 / 3
LOADINGS = {
    "none": Loading(force=5.0),
    "contact": Loading(force=5.0, platen="contact"),
    "glued": Loading(force=5.0, platen="glued"),
    "driven, contact": Loading(mode="displacement", platen="contact"),
    "driven, glued": Loading(mode="displacement", platen="glued"),
}


def scene_of(elements=3, platen="none", imperfection=0.0, **tables):
    """A 3 x 3 grid of a linear material in plane stress."""
    lattice = Lattice(nodes_per_wall=elements - 1, imperfection=imperfection)
    chosen = {"lattice": lattice, "material": MATERIAL, "loading": LOADINGS[platen]} | tables
    return build_scene(Case(**chosen))


@pytest.mark.parametrize("platen", LOADINGS)
@pytest.mark.parametrize("elements", [1, 4])
def test_masses_sum_to_the_printed_mass_in_each_direction(elements, platen):
    scene = scene_of(elements, platen)
    nodes = 2 * len(scene.mesh.points)
    expected = mass(scene.network, DEPTH, MATERIAL.density)
    printed = (12.5e-3 + THICKNESS) ** 2 - 9 * (WALL - THICKNESS) ** 2
    assert expected == pytest.approx(printed * DEPTH * MATERIAL.density, rel=1e-9)
    x, y = scene.terms.coordinates.mass[:nodes].reshape(-1, 2).T
    np.testing.assert_array_equal(x, y)
    assert x.sum() == pytest.approx(expected, rel=1e-12)
    assert x.min() > 0.0
    assert not scene.terms.coordinates.mass[nodes:].any()


def test_masses_go_with_the_length_around_a_node():
    scene = scene_of(3)
    x = scene.terms.coordinates.mass[: 2 * len(scene.mesh.points) : 2]
    elements = np.bincount(scene.mesh.edges.ravel())
    np.testing.assert_allclose(x / x[-1], elements / 2, rtol=1e-12)


@pytest.mark.parametrize("elements", [1, 3])
@pytest.mark.parametrize("platen", LOADINGS)
def test_the_load_sums_to_the_force(platen, elements):
    scene = scene_of(elements, platen)
    load, nodes = scene.terms.coordinates.load, 2 * len(scene.mesh.points)
    if platen.startswith("driven"):
        assert not load.any()
    elif platen == "none":
        top = np.flatnonzero(np.isclose(scene.mesh.points[:, 1], 12.5e-3))
        assert len(top) == 3 * elements + 1
        np.testing.assert_allclose(load[2 * top + 1], -5.0 / len(top), rtol=1e-12)
        assert np.count_nonzero(load) == len(top)
    else:
        assert load[-1] == -5.0
        assert not load[:-1].any()
    assert load.sum() == (0.0 if platen.startswith("driven") else pytest.approx(-5.0, rel=1e-12))
    assert not load[:nodes:2].any()


def row_of_nodes(scene, height):
    """x, y and rotation coordinates of an outer row."""
    nodes = np.flatnonzero(np.isclose(scene.mesh.points[:, 1], height))
    joints = nodes[nodes < scene.mesh.n_joints]
    return 2 * nodes, 2 * nodes + 1, 2 * len(scene.mesh.points) + joints


@pytest.mark.parametrize("elements", [1, 3])
@pytest.mark.parametrize("platen", LOADINGS)
def test_what_is_held_and_what_moves_with_the_platen(platen, elements):
    """A clamped row is held in x, y and phi; a glued upper one too, but for y, the platen's."""
    scene = scene_of(elements, platen)
    leader = scene.terms.layout.leader
    low, high = leader.size - 2, leader.size - 1
    bottom, top = (np.concatenate(row_of_nodes(scene, y)) for y in (0.0, 12.5e-3))
    x, y, rotation = row_of_nodes(scene, 12.5e-3)
    glued = np.concatenate([x, rotation])
    held, led = {
        "none": ([*bottom, low, high], []),
        "glued": ([*bottom, *glued, low], [*y, high]),
        "contact": ([low], [high]),
    }[platen.removeprefix("driven, ")]
    np.testing.assert_array_equal(np.flatnonzero(leader < 0), np.sort(held))
    np.testing.assert_array_equal(np.flatnonzero(leader == high), np.sort(led))
    alone = np.delete(np.arange(leader.size), [*held, *led])
    np.testing.assert_array_equal(leader[alone], alone)
    assert scene.terms.coordinates.driven == (high if platen.startswith("driven") else -1)
    assert len(top) == len(bottom)


@pytest.mark.parametrize("elements", [1, 3])
@pytest.mark.parametrize("platen", LOADINGS)
def test_the_solver_knows_who_leads_and_where_walls_are(platen, elements):
    scene = scene_of(elements, platen)
    layout, walls, mesh = scene.terms.layout, scene.terms.walls, scene.mesh
    n = len(mesh.points)
    assert layout.n_nodes == n
    places = zip(layout.point, layout.slot, strict=True)
    pairs = [(p, s) for p in range(n) for s in (0, 1)] + [(p, 2) for p in range(16)]
    assert list(places) == [*pairs, (n, 0), (n, 0)]
    np.testing.assert_array_equal(layout.first, np.flatnonzero(layout.slot == 0)[:n])
    assert layout.driven == scene.terms.coordinates.driven
    held = scene.terms.coordinates.role == HELD
    np.testing.assert_array_equal(layout.leader < 0, held)
    expected = np.full(len(mesh.points) + 1, -1)
    for w in range(24):
        chain = walls.edges[walls.start[w] : walls.start[w + 1]]
        expected[chain[1:, 0]] = w
        if elements > 1:
            assert layout.inner[w] == 2 * chain[0, 1]
            np.testing.assert_array_equal(np.diff(chain[:-1, 1]), 1)
        ends = np.array([chain[0, 0], chain[-1, 1]])
        outer = np.column_stack([2 * ends, 2 * ends + 1, 2 * len(mesh.points) + ends])
        np.testing.assert_array_equal(layout.outer[w], outer.ravel())
    np.testing.assert_array_equal(layout.wall_of, expected)
    assert layout.scale == pytest.approx(MATERIAL.modulus * DEPTH * THICKNESS * elements / WALL)


def test_a_glued_row_keeps_its_shape():
    """Through a whole crush its nodes stay side by side and go down with the platen."""
    result = simulate(
        Case(
            material=MATERIAL,
            loading=Loading(mode="displacement", strain=0.2, unload=False),
            solver=Solver(load_steps=10),
        )
    )
    shapes, rest = result.frames["position_m"], result.frames["position_m"][0]
    top, bottom = (np.isclose(rest[:, 1], y) for y in (12.5e-3, 0.0))
    assert top.sum() == bottom.sum() == 10
    np.testing.assert_allclose(
        shapes[:, bottom], np.broadcast_to(rest[bottom], shapes[:, bottom].shape)
    )
    moved = shapes[:, top] - rest[top]
    np.testing.assert_allclose(moved[:, :, 0], 0.0, atol=1e-15)
    np.testing.assert_allclose(
        moved[:, :, 1],
        -12.5e-3 * result.frames["strain"][:, None] + 0.0 * moved[:, :, 1],
        atol=1e-15,
    )
    assert np.abs(shapes[-1] - rest)[:, 0].max() > 1e-4


def test_rotations_are_scaled_by_the_length_of_an_element():
    scene = scene_of(3)
    scale, nodes = scene.terms.coordinates.scale, 2 * len(scene.mesh.points)
    np.testing.assert_allclose(scale[nodes:-2], WALL / 3, rtol=1e-12)
    np.testing.assert_array_equal(np.delete(scale, np.arange(nodes, nodes + 16)), 1.0)
    np.testing.assert_allclose(scene.terms.coordinates.lever * scale, 1.0, rtol=1e-15)


@pytest.mark.parametrize(
    ("plane", "in_stretch", "in_bend"),
    [("stress", 1.0, 1.0), ("strain", 1 / 0.84, 1 / 0.84), ("strain_bending", 1.0, 1 / 0.84)],
)
def test_plane_factors(plane, in_stretch, in_bend):
    """Y' = Y / (1 - nu^2) in stretching and contact, and in bending."""
    material = Material(modulus=12e6, density=1190.0, poisson=0.4, plane=plane)
    assert plane_factors(material) == pytest.approx((in_stretch, in_bend))
    flat, plain = scene_of(material=material).terms, scene_of().terms
    for found, expected, factor in (
        (flat.law.coefficients, plain.law.coefficients, in_stretch),
        (flat.law.energy, plain.law.energy, in_stretch),
        (flat.law.modulus, plain.law.modulus, in_stretch),
        (flat.contact.stiffness, plain.contact.stiffness, in_stretch),
        (flat.bend.hinge_stiffness, plain.bend.hinge_stiffness, in_bend),
        (flat.bend.arm_stiffness, plain.bend.arm_stiffness, in_bend),
        (flat.fold.stiffness, plain.fold.stiffness, in_bend),
    ):
        np.testing.assert_allclose(found, factor * expected, rtol=1e-12)


def test_stiffness_of_contact_is_c_times_that_of_a_wall():
    touch = scene_of(contact=Contact(stiffness=2.5)).terms.contact
    assert touch.stiffness == pytest.approx(2.5 * MATERIAL.modulus * DEPTH)
    assert touch.reach == THICKNESS
    np.testing.assert_allclose(touch.node_thickness, THICKNESS, rtol=1e-12)
    assert touch.tributary.sum() == pytest.approx(24 * WALL)


def test_without_contact_its_arrays_are_empty():
    terms = scene_of(contact=Contact(model="none")).terms
    touch = terms.contact
    empty = ("edges", "edge_thickness", "subtract", "special_node", "special_weight",
             "special_distance", "special_subtract", "plate_nodes")  # fmt: skip
    assert {name: getattr(touch, name).size for name in empty} == dict.fromkeys(empty, 0)
    assert touch.reach == 0.0
    assert not touch.special_start.any()
    assert terms.friction.mu == 0.0


@pytest.mark.parametrize("model", ["none", "barrier"])
@pytest.mark.parametrize("platen", LOADINGS)
def test_platens_touch_what_is_not_glued_to_them(platen, model):
    scene = scene_of(platen=platen, contact=Contact(model=model))
    y = scene.mesh.points[:, 1]
    touched = np.full(len(y), platen.endswith("contact"))
    if platen.endswith("glued") and model == "barrier":
        touched = (y > 0.0) & (y < 12.5e-3)
    np.testing.assert_array_equal(scene.terms.contact.plate_nodes, np.flatnonzero(touched))
    assert len(scene.terms.contact.edges) == (0 if model == "none" else len(scene.mesh.edges))
    np.testing.assert_allclose(
        scene.x_rest[-2:], [-0.5 * THICKNESS, 12.5e-3 + 0.5 * THICKNESS], rtol=1e-12
    )


@pytest.mark.parametrize(
    ("damping", "expected"),
    [
        (Damping(model="none"), (0.0, 0.0, 0.0)),
        (Damping(model="rayleigh", mass=7.0, stiffness=3e-4), (7.0, 3e-4, 0.0)),
        (Damping(model="kelvin_voigt", relaxation_time=2e-4), (0.0, 0.0, 2e-4)),
    ],
)
def test_damping_is_that_of_its_model_and_none_without_time(damping, expected):
    assert scene_of(damping=damping).terms.damp == expected
    assert scene_of(platen="driven, glued", damping=damping).terms.damp == (0.0, 0.0, 0.0)


def test_smoothing_of_friction():
    """A speed, whatever the time step; without time a thousandth of the wall thickness."""
    rubbing = scene_of(
        contact=Contact(friction=0.4, slip_speed=0.02), solver=Solver(time_step=1e-3)
    )
    assert rubbing.terms.friction == pytest.approx((0.4, 0.02))
    assert scene_of(platen="driven, glued").terms.friction == pytest.approx((0.3, 1e-3 * THICKNESS))


@pytest.mark.parametrize(
    ("platen", "bottom", "top", "base"),
    [
        ("none", "row", "row", "row"),
        ("glued", "row and platen", "row", "row"),
        ("contact", "platen", "nothing", "nodes"),
        ("driven, contact", "platen", "platen", "platen"),
        ("driven, glued", "row and platen", "platen", "platen"),
    ],
)
def test_where_reaction_and_strain_are_read(platen, bottom, top, base):
    scene = scene_of(platen=platen)
    high = scene.x_rest.size - 1
    below, above = row_of_nodes(scene, 0.0)[1], row_of_nodes(scene, 12.5e-3)[1]
    nodes = 2 * np.arange(len(scene.mesh.points)) + 1
    low_of = {"row": below, "platen": [high - 1], "nodes": nodes}
    low_of["row and platen"] = [*below, high - 1]
    high_of = {"row": above, "platen": [high], "nothing": []}
    np.testing.assert_array_equal(scene.bottom, low_of[bottom])
    np.testing.assert_array_equal(scene.top, high_of[top])
    np.testing.assert_array_equal(scene.base, low_of[base])
