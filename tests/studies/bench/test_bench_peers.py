"""The other codes of `make bench` solve what we solve."""

from functools import partial

import numpy as np
import pytest

from sweep.scene.lattice import build_scene
from sweep.scene.loading import stages
from tests.studies.bench import scenes, sweeps
from tests.studies.bench.measuring import cases, marching
from tests.studies.bench.peers import beams, descent, elements
from tests.support.kernels.solving import at_rest
from tests.support.kernels.states import shaken, unit
from tests.support.kernels.terms import Term, derivative_error


def seed(inner=2):
    """The seed's scene in small, with ``inner`` nodes a wall."""
    case = sweeps.changed(cases.seed(2, 0.02), lattice={"nodes_per_wall": inner})
    return case, build_scene(case)


def loaded(make, case, scene):
    """How far nodes have moved under the load by our march, and by the peer that ``make`` makes."""
    peer, state = make(case, scene), at_rest(scene)
    marching.go(case, scene, state, [phase.stage for phase in stages(case, scene)[:1]])
    assert peer.whole(released=False).iterations > 100
    own = (state.x - scene.x_rest)[: scene.mesh.points.size]
    return own.reshape(-1, 2), peer.moved()


def test_opensees_moves_as_we_do():
    pytest.importorskip("openseespy")
    case, scene = seed()
    own, others = loaded(scenes.PEERS["OpenSees, ProfileSPD"], case, scene)
    joints = np.arange(scene.mesh.n_joints)
    atol = 0.02 * np.abs(own[joints, 1]).max()
    np.testing.assert_allclose(others[joints, 1], own[joints, 1], atol=atol)


@pytest.mark.parametrize(
    ("model", "inner"), [(beams.Beams, 0), (beams.Beams, 2), (elements.Elements, 2)]
)
def test_numpy_moves_as_we_do(model, inner):
    own, others = loaded(partial(descent.Peer, model=model), *seed(inner))
    np.testing.assert_allclose(others, own, rtol=0, atol=1e-7 * np.abs(own).max())


def hessian_of_band(model, x):
    band = model.band(model.found(x))
    lower = sum(np.diag(row[: x.size - k], -k) for k, row in enumerate(band))
    return lower + np.tril(lower, -1).T


@pytest.mark.parametrize(
    ("model", "inner", "hessian"),
    [
        (beams.Beams, 0, hessian_of_band),
        (beams.Beams, 2, hessian_of_band),
        (elements.Elements, 2, lambda model, x: model.found(x).hessian),
    ],
)
def test_derivatives_in_numpy(model, inner, hessian):
    _, scene = seed(inner)
    walls = model(scene)
    x = shaken(scene, scene.x_rest, 0, 0.2)[walls.free]

    def slope(x, g):
        g += walls.found(x).gradient
        return walls.found(x).energy

    term = Term(slope, lambda x, projected: hessian(walls, x))
    assert derivative_error(term, x, unit(scene)[walls.free]) < 1e-7


@pytest.mark.parametrize("model", [beams.Beams, elements.Elements])
def test_numpy_steps_from_a_positive_hessian_only(model):
    _, scene = seed()
    walls = model(scene)
    x = scene.x_rest[walls.free]
    with pytest.raises(np.linalg.LinAlgError):
        walls.towards(walls.found(x), np.full(x.size, -1e9), np.ones(x.size))


def test_peer_that_takes_long_is_measured_once(monkeypatch):
    monkeypatch.setattr(scenes, "LONG", 0.0)
    table = scenes.seed(2, 2e-3, 2, {}, {"numpy": descent.Peer})
    assert table.texts["numpy", scenes.WHOLE].endswith(" x, measured once)")
    monkeypatch.setattr(scenes, "LONG", 1e3)
    table = scenes.seed(2, 2e-3, 2, {}, {"numpy": descent.Peer})
    assert table.texts["numpy", scenes.WHOLE].endswith(" x)")
