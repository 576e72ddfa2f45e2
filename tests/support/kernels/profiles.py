"""Rigid profiles next to a small frame, carried by the upper platen."""

from types import SimpleNamespace

import numpy as np

from kernels.geometry.profile import Profiles
from kernels.terms import contact
from sweep.design import profile as shapes
from sweep.design.profile import Profile
from sweep.scene.profiles import profiles_of
from tests.support.kernels.frames import Frame, contact_of

REACH = 40.0
SHAPES = {
    "round": shapes.circle(0.0, 3.0),
    "thin": shapes.circle(0.0, 0.05),
    "edge": shapes.wedge(0.0, 1.2, 0.4, REACH),
    "sharp": shapes.wedge(0.0, 1.0, 0.0, REACH),
    "punch": shapes.punch(0.0, 3.0, 0.5, REACH),
    "cornered": shapes.punch(0.0, 3.0, 0.0, REACH),
    "rib": shapes.rib(0.0, 0.6, REACH)._replace(chain=np.array([[0.0, 0.6], [0.0, REACH]])),
}


def resized(shape: Profile, length: float) -> Profile:
    """The shape in a unit of length, ``length`` of which make a millimetre."""
    return shape._replace(chain=shape.chain * length, radius=shape.radius * length)


def of_frame(of: Frame, shape: Profile) -> Profiles:
    """The data of one profile."""
    mesh = SimpleNamespace(
        points=of.points, edges=of.edges, rest_length=of.l0, thickness=of.thickness
    )
    return profiles_of([shape], np.array([of.rest.size - 1]), mesh, contact_of(of))


def below(of: Frame, shape: Profile) -> contact.Contact:
    """Contact of all walls of a frame with one profile alone, in place of the upper platen."""
    apart = contact_of(of)._replace(platen_nodes=np.empty(0, np.int64))
    return apart._replace(profiles=of_frame(of, shape), high_away=np.inf)
