"""Paths through limit points along arcs: closed forms, stability, balance, refusals."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

from kernels.solve import arc_length, outcomes
from sweep.config.faults import ConfigError
from sweep.config.load import load_config
from sweep.scene.custom import build_structure
from sweep.simulation.simulate import simulate
from tests.studies.validation.frames import LEE, TRUSS, followed, lee, truss_force
from tests.support.converged import converged
from tests.support.designs.scenes import unbalanced
from tests.support.designs.structures import (
    APART,
    AXIAL,
    BENDING,
    CLAMPED,
    MM,
    ROD,
    case_of,
    probe,
)
from tests.support.kernels.solving import free_of, whole


def arcs_of(parts, arcs=200, contact=APART, **solver):
    solver |= dict(integrator="arc_length", load_steps=arcs)
    return case_of(parts, contact=contact, solver=solver)


def test_truss_follows_its_closed_form_through_both_limit_points():
    result = converged(arcs_of(TRUSS | {"subdivide": 1}, arc_length=1e-3, element="classical"))
    factor, height = result.history["load_factor"], probe(result, 1, "y_m")
    force = truss_force(height)
    np.testing.assert_allclose(4e-3 * AXIAL * factor, force, atol=1e-9 * AXIAL)
    assert factor[-1] == 1.0
    assert factor.min() < -0.7
    slope = np.gradient(force, -height)
    steady = np.abs(slope) > 0.1 * np.abs(slope).max()
    falls = (slope < 0.0).astype(float)
    np.testing.assert_array_equal(result.history["unstable_modes"][steady], falls[steady])
    assert 0.0 < falls.sum() < len(falls)
    assert result.history["work_in_J"][-1] == pytest.approx(result.history["stretch_J"][-1], 1e-2)
    assert unbalanced(result.history) < 1e-9


def test_frame_of_lee_snaps_back():
    """Load and sinking each have a greatest value on the way, and the load a lowest."""
    result = converged(arcs_of(lee(32)))
    factor = result.history["load_factor"]
    sunk = 0.12 - probe(result, 2, "y_m")
    first, lowest, farthest = np.argmax(factor[:100]), np.argmin(factor), np.argmax(sunk[:120])
    assert 0 < first < farthest < lowest < len(factor) - 1
    assert 20.0 * factor[first] == pytest.approx(18.55, rel=1e-3)
    assert 20.0 * factor[lowest] == pytest.approx(-9.42, abs=0.02)
    assert sunk[farthest : lowest - 5].min() < sunk[farthest] - 0.08 * 0.12
    modes = result.history["unstable_modes"]
    assert not modes[:first].any()
    assert (modes[first + 1 : lowest] == 1.0).all()
    assert not modes[lowest + 1 :].any()
    assert factor[-1] == 1.0
    assert unbalanced(result.history) < 1e-9


@pytest.mark.parametrize("length", [2e-3, 4e-2])
def test_arcs_of_any_length_lie_on_the_same_path(length):
    """The longer ones are halved where they miss it."""
    fine, coarse = followed(lee(16)), followed(lee(16), arc_length=length)
    for there, here in zip(fine, coarse, strict=True):
        assert here.max() == pytest.approx(there.max(), abs=0.05 * np.ptp(there))
    k = np.argmax(coarse[0] < -0.1)
    near = np.argmin(np.hypot(fine[1] - coarse[1][k], fine[2] - coarse[2][k]))
    assert coarse[0][k] == pytest.approx(fine[0][near], abs=0.05)


def test_points_are_in_balance_and_as_stable_as_they_say():
    """An independent evaluation: every node of a frame of single elements is a probe."""
    legs = [[0, 24 * k] for k in range(6)] + [[24 * k, 120] for k in range(1, 6)]
    parts = {
        "nodes_mm": [*legs[:5], [0, 120], *legs[6:]],
        "walls": [[k, k + 1] for k in range(10)],
        "subdivide": 1,
        "supports": [{"node": node, "fix": ["x", "y"]} for node in (0, 10)],
        "loads": [{"node": 6, "force_N": LEE["loads"][0]["force_N"]}],
        "probes": list(range(11)),
    }
    case = arcs_of(parts)
    result, scene = converged(case), build_structure(case)
    factor = result.history["load_factor"]
    free, args, load = free_of(scene), whole(scene, scene.x_rest), scene.terms.coordinates.load
    assert factor.min() < -0.2
    for row in range(0, len(factor), 10):
        x = scene.x_rest.copy()
        for node in range(11):
            at = [probe(result, node, what)[row] for what in ("x_m", "y_m", "rotation_rad")]
            x[[2 * node, 2 * node + 1, 22 + node]] = at
        left = args.found(x)[1].elastic[free] - factor[row] * load[free]
        assert np.abs(left).max() < 1e-6 * np.abs(load).max()
        hessian = args.hessian(x)[np.ix_(free, free)]
        assert result.history["unstable_modes"][row] == np.sum(np.linalg.eigvalsh(hessian) < 0.0)


def test_arcs_end_at_the_full_load_or_with_their_number():
    """Loads grow by a twentieth at most, however far an arc would go along a stiff path."""
    few = simulate(arcs_of(lee(8), 5))
    assert (few.status, len(few.history["load_factor"])) == ("converged", 6)
    assert few.history["load_factor"][-1] < 0.9
    small = lee(8) | {"loads": [{"node": 2, "force_N": [0.0, -1e-3 * BENDING / 0.12**2]}]}
    assert list(simulate(arcs_of(small)).history["load_factor"][[0, -1]]) == [0.0, 1.0]


@pytest.mark.parametrize(("newton", "atol"), [(1e-2, 1e-5), (1e-9, 0.05)])
def test_a_stiff_path_has_arcs_of_a_twentieth_of_its_load(newton, atol):
    """A wall of 120 N is pulled. By a billionth of a newton it is drawn out by 4e-14 m in an arc,
    the length of which positions do not resolve to a millionth.
    """
    pulled = ROD | {"supports": [{"node": 0, "fix": CLAMPED}]}
    pulled |= {"loads": [{"node": 1, "force_N": [newton, 0.0]}]}
    factor = converged(arcs_of(pulled)).history["load_factor"]
    np.testing.assert_allclose(factor, np.linspace(0.0, 1.0, 21), atol=atol)


def test_walls_that_meet_on_the_way_touch():
    """Two fingers of a clamp, pressed together by forces, meet over their thickness."""
    clamp = {
        "nodes_mm": [[0, 0], [0, 10], [60, 0], [60, 10]],
        "walls": [[0, 1], [0, 2], [1, 3]],
        "subdivide": [4, 24, 24],
        "supports": [{"node": node, "fix": CLAMPED} for node in (0, 1)],
        "loads": [
            {"node": node, "force_N": [0.0, side * 6.0 * BENDING / 0.06**2]}
            for node, side in ((2, 1.0), (3, -1.0))
        ],
        "probes": [2, 3],
    }
    result = converged(arcs_of(clamp, 60, {}))
    assert result.history["load_factor"][-1] == 1.0
    assert result.history["contact_J"][-1] > 0.0
    assert 0.5 * MM < result.history["min_gap_m"][-1] < MM
    assert unbalanced(result.history) < 1e-6


@pytest.mark.parametrize(
    ("changes", "refused"),
    [
        ({"prescribed": [{"node": 2, "direction": "y", "displacement_mm": -1.0}]}, "prescribed"),
        ({"loads": []}, "no loads"),
        ({"supports": [{"node": 0, "fix": ["x", "y"]}]}, "without resistance"),
    ],
)
def test_refusals(changes, refused):
    with pytest.raises(ValueError, match=refused):
        arcs_of(LEE | changes)


@pytest.mark.parametrize(("table", "refused"), [
    ('[contact]\nfriction = 0.2\n[solver]\nintegrator = "arc_length"',
     'contact.friction = 0.2: .*no effect.* solver.integrator is "arc_length"'),
    ('[solver]\nintegrator = "static"\narc_length = "2 mm"',
     'solver.arc_length = "2 mm".* solver.integrator is "static"'),
])  # fmt: skip
def test_keys_without_effect_are_refused(tmp_path, table, refused):
    (tmp_path / "lee.json").write_text(json.dumps(LEE))
    config = tmp_path / "lee.toml"
    config.write_text(f'[lattice]\nkind = "custom"\nfile = "lee.json"\n{table}')
    with pytest.raises(ConfigError, match=refused):
        load_config(config)


def test_an_interruption_and_a_lost_path_are_told(monkeypatch):
    interrupted = simulate(arcs_of(lee(8)), np.array([1, 0, 0]))
    monkeypatch.setattr("kernels.solve.arc_length.follow", lambda *_: (outcomes.STALLED, 0))
    lost = simulate(arcs_of(lee(8)))
    assert interrupted.status == lost.status == "stopped"
    assert "interrupted" in interrupted.message
    assert "solver.arc_length" in lost.message


@pytest.mark.parametrize("move", [np.inf, np.nan])
def test_a_move_out_of_the_range_of_numbers_ends_an_arc(move):
    """It ends before pairs are listed, which would take for ever for such a move."""
    correct = getattr(arc_length._correct, "__wrapped__", arc_length._correct)
    workspace = SimpleNamespace(evaluation=None, work=SimpleNamespace(direction=0, escape=0))
    problem = SimpleNamespace(scene=SimpleNamespace(coordinates=None))
    found = correct(None, problem, None, 1.0, workspace, None, SimpleNamespace(longest_move=move))
    assert found == outcomes.NOT_FINITE
