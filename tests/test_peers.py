"""The other codes of `make bench` solve what we solve."""

import numpy as np
import pytest

from sweep.scene import build_scene
from sweep.stages import stages
from tests.bench import cases, marching, rods, scenes, sweeps
from tests.solving import at_rest
from tests.states import shaken, unit
from tests.terms import Term, derivative_error


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


@pytest.mark.parametrize("inner", [0, 2])
def test_numpy_moves_as_we_do(inner):
    own, others = loaded(rods.Peer, *seed(inner))
    np.testing.assert_allclose(others, own, rtol=0, atol=1e-7 * np.abs(own).max())


@pytest.mark.parametrize("inner", [0, 2])
def test_derivatives_of_rods_in_numpy(inner):
    _, scene = seed(inner)
    model = rods.Rods(scene)
    x = shaken(scene, scene.x_rest, 0, 0.2)[model.free]

    def hessian(x):
        band = model.band(model.found(x))
        lower = sum(np.diag(row[: x.size - k], -k) for k, row in enumerate(band))
        return lower + np.tril(lower, -1).T

    def slope(x, g):
        g += model.found(x).gradient
        return model.found(x).energy

    term = Term(slope, lambda x, projected: hessian(x))
    assert derivative_error(term, x, unit(scene)[model.free]) < 1e-7
