"""Rigid joints under a moment, and a cross whose joint is turned far."""

import numpy as np

from tests.studies.validation.exact import Frame
from tests.studies.validation.problem import RODS, Problem, bending
from tests.support.designs.structures import AXIAL, BENDING, CLAMPED, MM, probe, pushed

LENGTHS = (100.0, 60.0, 40.0, 80.0)  # mm
WAYS = {"L": ((-1, 0), (0, -1)), "T": ((-1, 0), (1, 0), (0, -1))}
WAYS["X"] = (*WAYS["T"], (0, 1))
ARM, TURN = 20.0, 0.5  # mm, rad
SMALL = 1e-5  # rad


def joint(kind):
    """Rotation of a joint of clamped walls over M / (sum of 4 Y I / l), as a function of the mesh.

    Under a small moment.
    """

    def value(pieces):
        lengths = np.array(LENGTHS[: len(WAYS[kind])])
        ends = lengths[:, None] * np.array(WAYS[kind])
        stiffness = np.sum(4.0 * BENDING / (MM * lengths))
        parts = {
            "nodes_mm": [[0.0, 0.0], *ends.tolist()],
            "walls": [[0, k + 1] for k in range(len(ends))],
            "subdivide": pieces,
            "supports": [{"node": k + 1, "fix": CLAMPED} for k in range(len(ends))],
            "loads": [{"node": 0, "moment_Nmm": SMALL * stiffness / MM}],
            "probes": [0],
        }
        return probe(pushed(parts, steps=1, tolerance=1e-12), 0, "rotation_rad")[-1] / SMALL

    return value


def shared(kind):
    """The same for linear beams whose joint may move, too: 3 x 3 stiffness by direct summation."""
    whole, turning = np.zeros((3, 3)), 0.0
    for length, along in zip(MM * np.array(LENGTHS), WAYS[kind], strict=False):
        along = np.array([*along, 0.0])
        across = np.array([-along[1], along[0], 0.0])
        turn = np.array([0.0, 0.0, length])
        whole += AXIAL / length * np.outer(along, along)
        by_length = BENDING / length**3
        whole += by_length * 12.0 * np.outer(across, across)
        whole += by_length * 6.0 * (np.outer(across, turn) + np.outer(turn, across))
        whole += by_length * 4.0 * np.outer(turn, turn)
        turning += 4.0 * BENDING / length
    return turning * np.linalg.inv(whole)[2, 2]


CROSS = {
    "nodes_mm": [[0.0, 0.0], [ARM, 0.0], [0.0, ARM], [-ARM, 0.0], [0.0, -ARM]],
    "walls": [[0, k] for k in (1, 2, 3, 4)],
    "wall_thickness_mm": 1.0,
    "supports": [{"node": k, "fix": CLAMPED} for k in (1, 2, 3, 4)],
    "probes": [0],
}
UNIT = bending(1.0) / (ARM * MM)  # of a moment, N m


def turned(pieces):
    """Moment over Y I / l that holds the joint of a cross at `TURN`."""
    led = {"prescribed": [{"node": 0, "direction": "rotation", "angle_rad": TURN}]}
    result = pushed(CROSS | led | {"subdivide": pieces})
    return probe(result, 0, "reaction_moment_Nm")[-1] / UNIT


def turned_exactly():
    """The same for exact rods."""
    frame = Frame(CROSS | {"loads": [{"node": 0, "moment_Nmm": UNIT / MM}]})
    for turn in (0.1, 0.2, 0.3, 0.4, TURN):
        moment = frame.lead(0, "rotation", turn)
    return moment


BEAMS = "linear beams"
PROBLEMS = (
    *(
        Problem(
            f"{kind} joint under a moment: rotation", joint(kind), shared(kind), BEAMS,
            order=0, within=1e-5,
        )
        for kind in WAYS
    ),
    Problem("cross turned by 0.5 rad: moment", turned, turned_exactly, RODS),
)  # fmt: skip
