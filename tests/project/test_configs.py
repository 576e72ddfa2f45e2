"""Every config of the repository runs; each, or a smaller copy of it, is held by a number."""

from functools import cache
from operator import attrgetter
from pathlib import Path

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.grid import chosen_case, expand
from sweep.config.load import load_config
from sweep.ranking.rank import rank
from sweep.running.sweep import run_sweep
from sweep.scene.material import law_in_stretch
from sweep.simulation.simulate import simulate
from sweep.store.read import read_attributes, read_frames, read_history, read_summary
from tests.support.designs.tables import material_with
from tests.support.materials.memory import pulled

CONFIGS = Path(__file__).parents[2] / "configs"


def sound(case):
    """The result of a case; it has converged, its energies balance and no walls cross."""
    result = simulate(case)
    summary = result.summary
    assert result.status == "converged", result.message
    assert abs(summary["energy_residual_J"]) < 1e-6 * summary["absorbed_energy_J"]
    assert summary["max_crossings"] == 0
    return result


@cache
def cases_of(name):
    return expand(load_config(CONFIGS / f"{name}.toml"))


def first(name, **values):
    wanted = [(attrgetter(key.replace("__", ".")), value) for key, value in values.items()]
    return next(case for case in cases_of(name) if all(of(case) == value for of, value in wanted))


def near(value, rel=1e-3):
    return pytest.approx(value, rel=rel)


def pin(name, values, smaller=None, **numbers):
    """A row of `PINNED`: a config, the values of a case, what makes its lattice smaller or its
    steps fewer, and columns within 1e-3 or as stated.
    """
    sure = {c: near(n) if isinstance(n, float) else n for c, n in numbers.items()}
    return pytest.param(name, values, smaller or {}, sure, id=f"{name}-{next(iter(sure))}")


ARMOR = dict(lattice__cells_x=6, lattice__wall_thickness=0.8e-3, material__name="ninjaflex")
CRUSHED, LOADED = dict(loading__mode="displacement"), dict(loading__mode="force")
GLUED, LOOSE = dict(loading__platen="glued"), dict(loading__platen="contact")
PANEL = dict(lattice__cells_x=17, lattice__cells_y=3)
SQUARE, HEX = dict(lattice__kind="square"), dict(lattice__kind="hex")
FLAT = HEX | dict(lattice__orientation="flat", lattice__perimeters=0)
DIAMOND = dict(lattice__kind="diamond", lattice__perimeters=0)
BRACED = dict(lattice__name="drawn.csv", lattice__counts=(23, 44))
HONEYCOMB = GLUED | dict(lattice__pattern="honeycomb", lattice__infill=near(0.1769))
PAD = HEX | dict(lattice__cells_x=6, lattice__wall_thickness=0.8e-3)
COARSE, ONE_WAY = {"load_steps": 100}, {"unload": False}
SHARE = 0.12 * 0.454
CRUSH = {"loading": ONE_WAY, "solver": COARSE}
PINNED = [
    pin("armor", ARMOR | CRUSHED | GLUED, absorbed_energy_J=1.6839),
    pin("armor", ARMOR | CRUSHED | LOOSE, absorbed_energy_J=1.5050),
    # A third of the bumper.
    pin(
        "armor",
        ARMOR | LOADED | LOOSE | dict(loading__force=500.0),
        {"lattice": {"width": 12.5e-3}, "loading": {"force": 500.0 / 3.0}},
        absorbed_energy_J=1.4568,
    ),
    pin("infills", FLAT, CRUSH, absorbed_energy_J=1.9097, mass_g=near(14.5, 1e-12)),
    pin("infills", DIAMOND, CRUSH, absorbed_energy_J=1.6909, mass_g=near(14.5, 1e-12)),
    # Squares in one piece, of 24 of 100 mm.
    pin(
        "panel",
        PANEL | SQUARE | dict(lattice__wall_thickness=0.8e-3),
        {"lattice": {"width": 24e-3}, "solver": COARSE},
        absorbed_energy_until_packed_J=2.1210,
    ),
    # A panel whose walls are as thick as its mass says.
    pin("drawn", BRACED, absorbed_energy_until_packed_J=0.40548, mass_g=near(4.0, 1e-9)),
    # 12 mm of 100 mm, by as much of a flat robot of 1 lb, as heavy as their own.
    pin(
        "rammed",
        PANEL | dict(loading__striker_mass=0.454),
        {"lattice": {"width": 12e-3}, "loading": {"striker_mass": SHARE, "target_mass": SHARE}},
        peak_force_N=302.56,
        target_speed_m_per_s=3.3708,
    ),
    # 2 x 2 cells of 4 x 4.
    pin(
        "reuse",
        SQUARE,
        {"lattice": dict(cells_x=2, cells_y=2, width=1e-2, height=1e-2, mass=0.35e-3)}
        | {"solver": COARSE},
        absorbed_energy_in_cycle_2_J=0.0051943,
        second_cycle_share=0.7083,
        mass_g=near(0.35, 1e-12),
    ),
    pin(
        "slicer",
        HONEYCOMB,
        {"loading": ONE_WAY | {"strain": 0.25}, "solver": COARSE},
        absorbed_energy_until_packed_J=near(3.3324, 2e-3),
        printed_mass_g=near(24.0, 1e-9),
    ),
    # The only pad that keeps 80 g0.
    pin(
        "drop",
        PAD,
        peak_force_N=near(285.6, 2e-3),
        peak_deceleration_filtered_m_per_s2=near(57.62 * 9.80665, 2e-3),
        impact_energy_J=near(0.5 * 9.80665 * 0.5, 1e-6),
    ),
]
COUNTS = {"reuse": 4, "slicer": 14, "drop": 8, "smoke": 6, "which_way": 16}
ELSEWHERE = {"custom", "extreme", "impact", "khatri_egan_square", "thousand"}
"""Configs held by tests of their own, and by the bench."""


def test_no_config_is_forgotten():
    names = {path.stem for path in CONFIGS.glob("*.toml")}
    along = {f"khatri_egan_{cells}_out_of_plane" for cells in ("square", "hexagon")}
    own = {"smoke", "search", "seed", "gyroid", "which_way", "which_way_lost"} | along
    assert names == ELSEWHERE | own | {row.values[0] for row in PINNED}
    assert {name: len(cases_of(name)) for name in COUNTS} == COUNTS
    assert sum(case.lattice.grading == 1.0 for case in cases_of("infills")) == 12


@pytest.mark.parametrize(("name", "design", "smaller", "numbers"), PINNED)
def test_a_config_holds_its_numbers(name, design, smaller, numbers):
    result = sound(first(name, **design).changed(**smaller))
    assert {column: result.summary[column] for column in numbers} == numbers
    if name == "infills":
        y, plates = result.frames["position_m"][..., 1], result.frames["plate_y_m"]
        assert np.all((y > plates[:, :1]) & (y < plates[:, 1:]))


def test_smoke_runs_from_end_to_end(tmp_path):
    out = tmp_path / "smoke.h5"
    assert run_sweep(load_config(CONFIGS / "smoke.toml"), out) == 0
    table = read_summary(out).set_index(["lattice.cells", "loading.mode", "loading.platen"])
    assert set(table["status"]) == {"converged"}
    assert not table["max_crossings"].any()
    assert set(table["git_revision"]) == {read_attributes(out)["git_revision"]}
    assert (abs(table["energy_residual_J"]) < 1e-6 * table["absorbed_energy_J"]).all()
    pinned = table.loc[(3, "displacement", "glued")]
    assert pinned["absorbed_energy_J"] == near(0.13768)
    assert read_history(out, pinned["case_id"])["strain"].max() == pytest.approx(0.4)
    assert read_frames(out, pinned["case_id"])["position_m"].shape[1:] == (100, 2)
    assert set(rank(out)["case_id"]) == set(table["case_id"])


def test_reuse_softens_as_it_says():
    """A strip that is stretched by 20 % absorbs 0.75 of the first cycle; 0.84 without softening."""
    (material,) = {case.material for case in cases_of("reuse")}
    relaxing = material_with(loss=material.loss)
    assert relaxing.softening_r is None
    laws = (law_in_stretch(each, 1.0) for each in (material_with(), relaxing, material))
    works = [pulled(law, 0.2, 50.0) for law in laws]
    shares = [second / first for first, _, second, _ in works]
    assert shares == pytest.approx([1.0, 0.84, 0.75], abs=0.005)
    lost = [1.0 + back / there for there, back, *_ in works]
    assert lost == pytest.approx([0.0, 0.283, 0.385], abs=0.005)


def test_search_holds_its_number():
    """The middle of everything that may be chosen."""
    recipe = load_config(CONFIGS / "search.toml").recipe
    case = chosen_case(recipe, {key: axis.at(0.5) for key, axis in recipe.search.items()})
    lattice = case.lattice
    assert (lattice.kind, lattice.cells_x, lattice.cells_y) == ("hex", 4, 3)
    assert lattice.wall_thickness == 1e-3
    assert sound(case).summary["absorbed_energy_at_50N_J"] == near(0.014302)


def pressed_a_little(case, steps=2, unload=False, **lattice):
    """The summary of a case that is pressed by 1 %, with coarse walls; along its cells."""
    coarse = case.lattice.model_copy(update={"layers": None} | lattice)
    loading = dict(direction="out_of_plane", platen=case.loading.platen, strain=0.01, unload=unload)
    steps = case.solver.model_copy(update={"load_steps": steps})
    tables = {"lattice": coarse, "material": case.material, "loading": loading, "solver": steps}
    return sound(Case.of(**tables)).summary


@pytest.mark.parametrize(
    ("cells", "walls", "area", "peak"),
    [("square", 24 * 4.0, 37.12, 28.03), ("hexagon", 49 * 2.0207, 38.0824, 28.60)],
)
def test_khatri_egan_along_the_cells_begins_as_a_block(cells, walls, area, peak):
    """Before walls buckle, F = mu A (1 / l^2 - l) if they are free to widen; the glue holds their
    ends, which makes them stiffer, by 4 / 3 if it held all of them.

    walls: length of all, mm; area: of their union, mm2; peak: pinned, N.
    """
    cases = cases_of(f"khatri_egan_{cells}_out_of_plane")
    assert {case.loading.platen for case in cases} == {"glued", "clamped", "contact"}
    case = cases[0]
    summary = pressed_a_little(case, nodes_per_wall=3, imperfection=0.0)
    outer = case.lattice.outer_size
    assert summary["solid_strain"] == near(1.0 - 1e-6 * area / (outer[0] * outer[1]), 1e-5)
    length = 0.99
    force = case.material.modulus * 4e-7 * walls * (1.0 / length**2 - length) / 3.0
    assert force < summary["peak_force_N"] < 4.0 / 3.0 * force
    assert summary["peak_force_N"] == near(peak, 1e-2)
    assert summary["mass_g"] == near(1.22 * area * 12.0e-3, 1e-5)


def test_which_way_presses_one_print_in_both_directions():
    across, along = (
        {c.lattice.kind: c for c in cases_of("which_way") if c.loading.direction == direction}
        for direction in ("in_plane", "out_of_plane")
    )
    assert len(across) == len(along) == 8
    for kind, case in along.items():
        assert case.lattice.wall_thickness == across[kind].lattice.wall_thickness
        assert case.loading.stroke == across[kind].loading.stroke
    summary = pressed_a_little(along["square"], nodes_per_wall=2)
    assert summary["mass_g"] == near(0.5, 1e-9)
    assert summary["direction"] == "out_of_plane"


def test_which_way_lost_presses_the_same_prints_of_a_material_that_loses_30_percent():
    """Pressed by 1 % and let go, one loses a little more than a strip does until its force is
    zero.
    """
    for case, other in zip(cases_of("which_way_lost"), cases_of("which_way"), strict=True):
        assert case.lattice == other.lattice
        assert case.loading.stroke == other.loading.stroke
        assert (case.material.loss, case.loading.unload) == (0.3, True)
    along = first("which_way_lost", loading__direction="out_of_plane")
    summary = pressed_a_little(along, nodes_per_wall=2, steps=20, unload=True)
    assert summary["lost_share"] == pytest.approx(0.3245, abs=2e-3)


@pytest.mark.parametrize(
    ("name", "laid", "along", "energy"),
    [
        ("gyroid", False, True, 2.5591),
        ("schwarz_d", False, True, 2.7291),
        ("square", False, True, 5.8319),
        ("gyroid", True, False, 2.5306),
        ("tpmsd", True, True, 2.9624),
    ],
)
def test_gyroid_holds_its_numbers(name, laid, along, energy):
    """Energy per gram of a coarse period that is pressed by 1 %, mJ/g; about a fifth is solid.

    laid: by a slicer.
    """
    *_, case = (
        case
        for case in cases_of("gyroid")
        if (case.lattice.name, case.along) == (name, along)
        and (case.lattice.value("slicer") is not None) == laid
    )
    coarse = {"nodes_per_wall": 2, "layers": None if case.lattice.sheet else 6}
    tables = {"loading": ONE_WAY | {"strain": 0.01, "stroke": None}, "solver": {"load_steps": 2}}
    summary = sound(case.changed(lattice=coarse, **tables)).summary
    assert summary["sides"] == "tied, fixed period"
    assert summary["relative_density"] == near(0.2, 0.02)
    assert 1e3 * summary["specific_absorption_J_per_g"] == near(energy)


@pytest.mark.parametrize(
    ("model", "element", "energy", "within"),
    [("position_based", "classical", 0.122, 1e-2), ("barrier", "cubic", 0.09928, 1e-3)],
)
def test_seed_holds_its_numbers(model, element, energy, within):
    """In steps of 20 us; nodes that are moved apart in another order come to rest a little
    elsewhere.
    """
    method = dict(contact__model=model, solver__element=element, solver__hessian="exact")
    summary = sound(first("seed", material__stretch="nonlinear", **method)).summary
    assert (summary["injected_by_projection_J"] > 0.0) == (model == "position_based")
    assert summary["touched"] == 1
    assert summary["absorbed_energy_J"] == near(energy, within)
