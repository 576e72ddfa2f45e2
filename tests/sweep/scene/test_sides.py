"""A lattice with tied sides: the middle of a wide one, its invariances, its derivatives."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.scene.sides import build_tied
from sweep.simulation.simulate import simulate
from tests.studies.sides.panels import Strip, crush
from tests.support.designs.periods import (
    DEPTH,
    MATERIAL,
    PLANE,
    L,
    assert_alike,
    assert_derivatives,
    assert_solved,
    crushed,
    cut_elsewhere,
    follow,
    lattice_of,
    pressed,
)
from tests.support.designs.scenes import is_sound, trapezoid, unbalanced


def strip(kind, cells, slenderness, **chosen):
    return lattice_of(kind, cells, slenderness, repeats="sides", **chosen)


def test_diamonds_that_widen_freely_only_bend():
    """Between platens without friction the mean lateral force is zero."""

    def force(friction):
        lattice = strip("diamond", (1, 4), 0.01, imperfection=0.0)
        case = pressed(lattice, strain=1e-3, steps=4, friction=friction, platen="contact")
        return case.widens, simulate(case).history["reaction_top_N"][-1]

    (free, least), (held, most) = force(0.0), force(0.3)
    assert (free, held) == (True, False)
    assert 0.0 < least < 1e-2 * most


@pytest.mark.parametrize(
    ("kind", "platens"),
    [("square", way) for way in ("glued", "loose", "smooth")]
    + [("hex", "smooth"), ("diamond", "smooth")],
)
def test_a_period_is_what_a_wide_lattice_gains_by_its_width(kind, platens):
    """The edges of two wide lattices are the same: their difference is the middle."""
    wide, wider, one = (
        simulate(crush(Strip(kind, platens, sides, n)))
        for sides, n in (("free", 6), ("free", 12), ("periodic", 1))
    )
    assert is_sound(one)
    cells = 12 - 6
    gained = wider.summary["mass_g"] - wide.summary["mass_g"]
    assert one.summary["mass_g"] == pytest.approx(gained / cells, rel=1e-9)
    work = [result.history["work_in_J"] for result in (wide, wider)]
    middle, most = (work[1] - work[0]) / cells, one.history["work_in_J"].max()
    within = 0.05 if platens == "loose" else 0.005  # friction reaches far in from free sides
    np.testing.assert_allclose(one.history["work_in_J"], middle, rtol=0, atol=within * most)


@pytest.mark.parametrize(
    ("kind", "share", "within"), [("square", 1.0, 1e-6), ("diamond", 0.5**0.5, 1e-3)]
)
def test_slender_cells_between_glued_platens(kind, share, within):
    """Squares are columns; diamonds, a grid at 45 degrees, cannot widen: both walls of a period
    take half of the strain, Y' t b e / 2 each.
    """
    case = pressed(strip(kind, (1, 4), 0.01, imperfection=0.0), strain=1e-6, steps=1)
    stiffness = simulate(case).history["reaction_top_N"][-1] / 1e-6
    assert stiffness == pytest.approx(share * PLANE * 0.01 * L * DEPTH, rel=within)


PLATENS = [("glued", 0.3), ("sliding", 0.3), ("contact", 0.3), ("contact", 0.0)]


def cut_at(case, cut):
    """Result with the left side of the period at ``cut``, m."""
    with cut_elsewhere((cut, 0.0)):
        return simulate(case)


@pytest.mark.parametrize(
    ("kind", "platen", "friction"),
    [(("reentrant", "kagome")[k % 2], *way) for k, way in enumerate(PLATENS)],
)
def test_it_does_not_matter_where_the_period_is_cut(kind, platen, friction):
    """Walls that touch across the border, and press on platens there, are walls like others."""
    lattice = strip(kind, (2, 2), 0.1, nodes_per_wall=2)
    case = pressed(lattice, friction=friction, platen=platen)
    one, other = (cut_at(case, cut) for cut in (0.0, 0.37 * L))
    assert is_sound(one)
    assert_alike(one, other, friction)


@pytest.mark.parametrize(("platen", "friction"), PLATENS)
def test_three_cells_are_as_good_as_one(platen, friction):
    one, three = (
        simulate(pressed(strip("hex", (n, 2), 0.1), friction=friction, platen=platen))
        for n in (1, 3)
    )
    most = one.history["work_in_J"].max()
    for name in ("work_in_J", "contact_J"):
        third = three.history[name] / 3
        np.testing.assert_allclose(third, one.history[name], rtol=0, atol=1e-5 * most)
    same = ("relative_density", "specific_absorption_J_per_g", "plateau_stress_Pa")
    for name in same:
        assert three.summary[name] == pytest.approx(one.summary[name], rel=1e-4)


@pytest.mark.parametrize(("platen", "friction"), PLATENS)
def test_the_book_is_closed(platen, friction):
    lattice = strip("kagome", (2, 2), 0.08)
    result = simulate(pressed(lattice, friction=friction, unload=True, platen=platen))
    assert is_sound(result)
    history = result.history
    assert unbalanced(history) < 1e-8
    assert trapezoid(history) == pytest.approx(history["work_in_J"][-1], rel=1e-3, abs=1e-3)
    top, bottom = history["reaction_top_N"], history["reaction_bottom_N"]
    np.testing.assert_allclose(bottom, top, rtol=0, atol=1e-4 * np.abs(top).max())


@pytest.mark.parametrize("platen", ["sliding", "contact"])
@pytest.mark.parametrize(("kind", "cells"), [("square", 1), ("hex", 1), ("reentrant", 2)])
def test_derivatives_across_the_border(kind, cells, platen):
    lattice = strip(kind, (cells, 2), 0.12, imperfection=0.3, nodes_per_wall=2)
    case = pressed(lattice, 0.45, platen=platen)
    scene = build_tied(case)
    x, args = crushed(case, scene)
    assert args.energy(x) > 0.0
    assert_derivatives(scene, x, args)
    assert_solved(scene, x, args, drifts=platen == "contact")


@pytest.mark.parametrize(
    ("platen", "integrator"),
    [("glued", "backward_euler"), ("sliding", "bdf2"), ("contact", "newmark"), ("contact", "bdf2")],
)
def test_images_move_with_their_originals_in_an_impact(platen, integrator):
    """The support bears the momentum of the striker."""
    case = Case.of(
        lattice=strip("hex", (1, 2), 0.1),
        material=MATERIAL,
        loading=dict(mode="impact", platen=platen, striker_mass=5e-3, striker_speed=0.5),
        contact=dict(friction=0.3),
        damping=dict(model="none"),
        solver=dict(integrator=integrator, joints="points"),
    )
    result = simulate(case)
    assert is_sound(result)
    assert unbalanced(result.history) < 1e-8
    layout, n = build_tied(case).terms.layout, result.frames["position_m"].shape[1]
    x = result.frames["position_m"].reshape(-1, 2 * n)
    copies = layout.images[layout.images[:, 1] >= 0]
    apart = x[:, copies[:, 0]] - x[:, copies[:, 1]]
    np.testing.assert_allclose(apart, np.tile(apart[0], (len(x), 1)), rtol=0, atol=1e-11 * L)
    assert np.ptp(x, axis=0).max() > 0.02 * L
    speed, force = (result.history[k] for k in ("striker_speed_m_per_s", "reaction_bottom_N"))
    given = 5e-3 * (speed[0] - speed[-1])
    borne = np.sum(force[1:] * np.diff(result.history["time_s"]))
    assert borne == pytest.approx(given, rel=0.05)


@pytest.mark.parametrize("falls", [False, True])
@pytest.mark.parametrize("platen", ["glued", "sliding", "contact"])
def test_two_periods_below_twice_the_mass_are_as_good_as_one(platen, falls):
    """On a target, or with the weight of the striker. Momentum and book: `test_target`."""

    def hit(n):
        base = dict(gravity=True) if falls else dict(target_mass=0.01 * n)
        struck = dict(mode="impact", striker_mass=5e-3 * n, striker_speed=0.5, platen=platen)
        lattice, solver = strip("hex", (n, 2), 0.1), dict(joints="points")
        return Case.of(lattice=lattice, loading=struck | base, solver=solver)

    one, two = (simulate(hit(n)).summary for n in (1, 2))
    assert one["status"] == two["status"] == "converged"
    if falls:
        sunk = 5e-3 * 9.80665 * one["indentation_m"]
        assert one["absorbed_energy_J"] == pytest.approx(0.5 * 5e-3 * 0.25 + sunk, rel=2e-3)
    else:
        assert one["target_speed_m_per_s"] > 0.1
    for name in ("indentation_m", "peak_deceleration_m_per_s2", "rebound_share"):
        assert two[name] == pytest.approx(one[name], rel=1e-5)


def test_a_load_does_the_work_on_a_period_that_a_wide_lattice_gains():
    """With the same load on every column; a lattice with free sides has one more."""

    def work(sides, n, columns):
        lattice = dict(kind="square", cells_x=n, cells_y=2, width=n * L, height=2 * L, sides=sides)
        loading = dict(mode="force", force=0.4 * columns, platen="contact", duration=0.1)
        case = Case.of(
            lattice=lattice | dict(wall_thickness=0.1 * L, depth=DEPTH),
            material=MATERIAL,
            loading=loading,
            solver=dict(joints="points"),
        )
        return simulate(case).summary["absorbed_energy_J"]

    middle = (work("free", 12, 13) - work("free", 6, 7)) / 6
    assert work("periodic", 1, 1) == pytest.approx(middle, rel=1e-3)


def test_the_unknowns_of_a_fixed_period_are_those_of_its_nodes():
    """Nothing is led by the width of the period, unless it is free."""
    for friction, free in ((0.3, False), (0.0, True)):
        case = pressed(strip("square", (2, 2), 0.1), friction=friction, platen="contact")
        scene = build_tied(case)
        width = scene.terms.coordinates.mass.size - 3
        assert scene.x_rest[width] == pytest.approx(2 * L)
        led = follow(scene)[:, :-1][width].any()
        assert (scene.terms.layout.leader[width] >= 0, bool(led)) == (free, free)
