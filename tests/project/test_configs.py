"""Every config of the repository runs; each is held by a number."""

from pathlib import Path

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.config.grid import chosen_case, expand
from sweep.config.load import load_config
from sweep.ranking.rank import rank
from sweep.running.sweep import run_sweep
from sweep.simulation.simulate import simulate
from sweep.store.read import read_attributes, read_frames, read_history, read_summary
from tests.support.designs.tables import material_with
from tests.support.materials.strips import pulled

CONFIGS = Path(__file__).parents[2] / "configs"


def sound(case):
    """The result of a case; it has converged, its energies balance and no walls cross."""
    result = simulate(case)
    summary = result.summary
    assert result.status == "converged", result.message
    assert abs(summary["energy_residual_J"]) < 1e-6 * summary["absorbed_energy_J"]
    assert summary["max_crossings"] == 0
    return result


def test_no_config_is_forgotten():
    """`thousand` is held by the bench, `others` by tests of their own."""
    names = {path.stem for path in CONFIGS.glob("*.toml")}
    others = {"custom", "extreme", "impact", "khatri_egan_square"}
    assert names == others | {
        "armor", "drawn", "drop", "infills", "khatri_egan_hexagon_out_of_plane",
        "khatri_egan_square_out_of_plane", "panel", "rammed", "reuse", "seed", "search", "slicer",
        "smoke", "thousand", "which_way", "which_way_lost", "gyroid",
    }  # fmt: skip


def test_smoke_runs_from_end_to_end(tmp_path):
    out, config = tmp_path / "smoke.h5", load_config(CONFIGS / "smoke.toml")
    assert run_sweep(config, out) == 0
    table = read_summary(out).set_index(["lattice.cells", "loading.mode", "loading.platen"])
    assert len(table) == len(expand(config)) == 6
    assert set(table["status"]) == {"converged"}
    assert not table["max_crossings"].any()
    assert set(table["git_revision"]) == {read_attributes(out)["git_revision"]}
    assert (abs(table["energy_residual_J"]) < 1e-6 * table["absorbed_energy_J"]).all()
    pinned = table.loc[(3, "displacement", "glued")]
    assert 1e3 * pinned["absorbed_energy_J"] == pytest.approx(137.68, rel=1e-3)
    case_id = pinned["case_id"]
    assert read_history(out, case_id)["strain"].max() == pytest.approx(0.4)
    assert read_frames(out, case_id)["position_m"].shape[1:] == (100, 2)
    assert set(rank(out)["case_id"]) == set(table["case_id"])


@pytest.mark.parametrize(
    ("mode", "platen", "force", "energy"),
    [
        ("displacement", "glued", None, 1705.7),
        ("displacement", "contact", None, 1511.4),
        ("force", "contact", 500.0, 4462.6),
    ],
)
def test_armor_holds_its_numbers(mode, platen, force, energy):
    """The grid of 6 x 2 cells with walls of 0.8 mm, printed in NinjaFlex."""
    found = [
        case
        for case in expand(load_config(CONFIGS / "armor.toml"))
        if (case.lattice.cells_x, case.lattice.wall_thickness) == (6, 0.8e-3)
        and case.material.name == "ninjaflex"
        and (case.loading.mode, case.loading.platen) == (mode, platen)
        and case.loading.value("force") == force
    ]
    assert len(found) == 1
    summary = sound(found[0]).summary
    assert 1e3 * summary["absorbed_energy_J"] == pytest.approx(energy, rel=1e-3)


def infills():
    """The cases of infills.toml by pattern, orientation and lines all round."""
    cases = expand(load_config(CONFIGS / "infills.toml"))
    return {
        (case.lattice.kind, case.lattice.orientation, case.lattice.perimeters): case
        for case in cases
        if case.lattice.grading == 1.0
    }


@pytest.mark.parametrize(
    ("design", "energy"), [(("hex", "flat", 0), 1913.3), (("diamond", None, 0), 1686.7)]
)
def test_infills_hold_their_numbers(design, energy):
    result = sound(infills()[design])
    summary, frames = result.summary, result.frames
    y, plates = frames["position_m"][..., 1], frames["plate_y_m"]
    assert np.all((y > plates[:, :1]) & (y < plates[:, 1:]))
    assert summary["mass_g"] == pytest.approx(14.5, rel=1e-12)
    assert 1e3 * summary["absorbed_energy_J"] == pytest.approx(energy, rel=1e-3)


def test_infills_are_twelve_designs_and_more():
    assert len(infills()) == 12


def test_panel_holds_its_numbers():
    """Squares of 17 x 3 cells, in one piece of 100 x 50 mm."""
    (wide,) = (
        case
        for case in expand(load_config(CONFIGS / "panel.toml"))
        if (case.lattice.kind, case.lattice.cells_x) == ("square", 17)
        and case.lattice.wall_thickness == 0.8e-3
    )
    assert wide.lattice.cells_y == 3
    summary = sound(wide).summary
    assert summary["absorbed_energy_until_packed_J"] == pytest.approx(7.556, rel=1e-3)


def test_drawn_holds_its_numbers():
    """The braced panel, whose walls are as thick as its mass says."""
    case = expand(load_config(CONFIGS / "drawn.toml"))[0]
    assert (case.lattice.name, case.lattice.counts) == ("drawn.csv", (23, 44))
    summary = sound(case).summary
    assert summary["mass_g"] == pytest.approx(4.0, rel=1e-9)
    assert 1e3 * summary["absorbed_energy_until_packed_J"] == pytest.approx(405.48, rel=1e-3)


def test_rammed_holds_its_numbers():
    """Squares of 17 x 3 cells are rammed by a flat robot of 1 lb, as heavy as their own."""
    case = expand(load_config(CONFIGS / "rammed.toml"))[0]
    assert (case.lattice.cells_x, case.lattice.cells_y) == (17, 3)
    summary = sound(case).summary
    assert summary["peak_force_N"] == pytest.approx(4318.6, rel=1e-3)
    assert summary["target_speed_m_per_s"] == pytest.approx(3.3031, rel=1e-3)


def test_reuse_holds_its_numbers():
    found = {case.lattice.kind: case for case in expand(load_config(CONFIGS / "reuse.toml"))}
    assert list(found) == ["square", "hex", "diamond", "circle"]
    summary = sound(found["square"]).summary
    assert summary["mass_g"] == pytest.approx(1.4, rel=1e-12)
    assert 1e3 * summary["absorbed_energy_in_cycle_2_J"] == pytest.approx(25.825, rel=1e-3)
    assert summary["second_cycle_share"] == pytest.approx(0.7169, rel=1e-3)


def test_reuse_softens_as_it_says():
    """A strip that is stretched by 20 % absorbs 0.75 of the first cycle; 0.84 without softening."""
    (material,) = {case.material for case in expand(load_config(CONFIGS / "reuse.toml"))}
    relaxing = material_with(loss=material.loss)
    assert relaxing.softening_r is None
    works = [pulled(each, 0.2, 50.0) for each in (material_with(), relaxing, material)]
    shares = [second / first for first, _, second, _ in works]
    assert shares == pytest.approx([1.0, 0.84, 0.75], abs=0.005)
    lost = [1.0 + back / there for there, back, *_ in works]
    assert lost == pytest.approx([0.0, 0.283, 0.385], abs=0.005)


def test_slicer_holds_its_numbers():
    """Seven infills of the same mass as extruded; honeycomb needs the least share."""
    cases = expand(load_config(CONFIGS / "slicer.toml"))
    glued = {case.lattice.pattern: case for case in cases if case.loading.platen == "glued"}
    assert len(cases) == 2 * len(glued) == 14
    shares = {name: case.lattice.infill for name, case in glued.items()}
    assert shares["honeycomb"] == min(shares.values()) == pytest.approx(0.1769, rel=1e-3)
    summary = sound(glued["honeycomb"]).summary
    assert summary["printed_mass_g"] == pytest.approx(24.0, rel=1e-9)
    assert 1e3 * summary["absorbed_energy_until_packed_J"] == pytest.approx(6709, rel=2e-3)


def test_drop_holds_its_numbers():
    """The only pad that keeps 80 g0."""
    found = {
        (case.lattice.kind, case.lattice.cells_x, case.lattice.wall_thickness): case
        for case in expand(load_config(CONFIGS / "drop.toml"))
    }
    assert len(found) == 8
    summary = sound(found["hex", 6, 0.8e-3]).summary
    assert summary["impact_energy_J"] == pytest.approx(0.5 * 9.80665 * 0.5)
    assert summary["peak_force_N"] == pytest.approx(346.6, rel=2e-3)
    filtered = "peak_deceleration_filtered_m_per_s2"
    assert summary[filtered] / 9.80665 == pytest.approx(57.2, rel=2e-3)


def test_search_holds_its_number():
    """The middle of everything that may be chosen."""
    config = load_config(CONFIGS / "search.toml")
    middle = {key: axis.at(0.5) for key, axis in config.recipe.search.items()}
    case = chosen_case(config.recipe, middle)
    lattice = case.lattice
    assert (lattice.kind, lattice.cells_x, lattice.cells_y) == ("hex", 4, 3)
    assert lattice.wall_thickness == 1e-3
    summary = sound(case).summary
    assert 1e3 * summary["absorbed_energy_at_50N_J"] == pytest.approx(14.302, rel=1e-3)


def pressed_a_little(case, steps=2, **lattice):
    """The summary of a case that is pressed by 1 %, with coarse walls; along its cells."""
    coarse = case.lattice.model_copy(update={"layers": None} | lattice)
    loading = dict(direction="out_of_plane", platen=case.loading.platen, strain=0.01)
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
    cases = expand(load_config(CONFIGS / f"khatri_egan_{cells}_out_of_plane.toml"))
    assert {case.loading.platen for case in cases} == {"glued", "clamped", "contact"}
    case = cases[0]
    summary = pressed_a_little(case, nodes_per_wall=3, imperfection=0.0)
    outer = case.lattice.outer_size
    assert summary["solid_strain"] == pytest.approx(
        1.0 - 1e-6 * area / (outer[0] * outer[1]), rel=1e-5
    )
    length = 0.99
    force = case.material.modulus * 4e-7 * walls * (1.0 / length**2 - length) / 3.0
    assert force < summary["peak_force_N"] < 4.0 / 3.0 * force
    assert summary["peak_force_N"] == pytest.approx(peak, rel=1e-2)
    assert summary["mass_g"] == pytest.approx(1.22 * area * 12.0e-3, rel=1e-5)


def test_which_way_presses_one_print_in_both_directions():
    cases = expand(load_config(CONFIGS / "which_way.toml"))
    across, along = (
        {case.lattice.kind: case for case in cases if case.loading.direction == direction}
        for direction in ("in_plane", "out_of_plane")
    )
    assert len(across) == len(along) == 8
    for kind, case in along.items():
        assert case.lattice.wall_thickness == across[kind].lattice.wall_thickness
        assert case.loading.stroke == across[kind].loading.stroke
    summary = pressed_a_little(along["square"], nodes_per_wall=2)
    assert summary["mass_g"] == pytest.approx(0.5, rel=1e-9)
    assert summary["direction"] == "out_of_plane"


def test_which_way_lost_presses_the_same_prints_of_a_material_that_loses_30_percent():
    """Pressed by 1 % and let go, one loses a little more than a strip does until its force is
    zero.
    """
    cases = expand(load_config(CONFIGS / "which_way_lost.toml"))
    elastic = expand(load_config(CONFIGS / "which_way.toml"))
    for case, other in zip(cases, elastic, strict=True):
        assert case.lattice == other.lattice
        assert case.loading.stroke == other.loading.stroke
        assert (case.material.loss, case.loading.unload) == (0.3, True)
    along = next(case for case in cases if case.loading.direction == "out_of_plane")
    summary = pressed_a_little(along, nodes_per_wall=2, steps=20)
    assert summary["lost_share"] == pytest.approx(0.3245, abs=2e-3)


@pytest.mark.parametrize(
    ("name", "laid", "along", "energy"),
    [
        ("gyroid", False, True, 2.5483),
        ("schwarz_d", False, True, 2.7183),
        ("square", False, True, 5.8111),
        ("gyroid", True, False, 2.5194),
        ("tpmsd", True, True, 2.9508),
    ],
)
def test_gyroid_holds_its_numbers(name, laid, along, energy):
    """Energy per gram of a coarse period that is pressed by 1 %, mJ/g; about a fifth is solid.

    laid: by a slicer.
    """
    case = [
        case
        for case in expand(load_config(CONFIGS / "gyroid.toml"))
        if (case.lattice.name, case.along) == (name, along)
        and (case.lattice.value("slicer") is not None) == laid
    ][-1]
    coarse = {"nodes_per_wall": 2, "layers": None if case.lattice.sheet else 6}
    tables = {"loading": {"strain": 0.01, "stroke": None}, "solver": {"load_steps": 2}}
    summary = sound(case.changed(lattice=coarse, **tables)).summary
    assert summary["sides"] == "tied, fixed period"
    assert summary["relative_density"] == pytest.approx(0.2, rel=0.02)
    assert 1e3 * summary["specific_absorption_J_per_g"] == pytest.approx(energy, rel=1e-3)


def seed(model, hinges):
    """Summary of the case of seed.toml in steps of 20 us, nonlinear, Newton exact."""
    (case,) = (
        case
        for case in expand(load_config(CONFIGS / "seed.toml"))
        if (case.contact.model, case.solver.element) == (model, hinges)
        and (case.material.stretch, case.solver.hessian) == ("nonlinear", "exact")
    )
    return sound(case).summary


@pytest.mark.parametrize(
    ("model", "hinges", "energy", "within"),
    [("position_based", "classical", 122.0, 1e-2), ("barrier", "cubic", 99.28, 1e-3)],
)
def test_seed_holds_its_numbers(model, hinges, energy, within):
    """Nodes that are moved apart in another order come to rest a little elsewhere."""
    summary = seed(model, hinges)
    assert (summary["injected_by_projection_J"] > 0.0) == (model == "position_based")
    assert summary["touched"] == 1
    assert 1e3 * summary["absorbed_energy_J"] == pytest.approx(energy, rel=within)
