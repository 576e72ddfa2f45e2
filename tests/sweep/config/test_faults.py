"""Refusals: they reach a user from another process as they were."""

import pickle

import pytest

from sweep.config.faults import ConfigError, Fault
from sweep.config.kinds.table import RefusedError
from sweep.config.structures.structure_file import StructureError

REFUSALS = (
    ConfigError([Fault("lattice.kind", 'unknown value "hexx"')]),
    RefusedError("lattice.depth", -1.0, "more than 0", "lattice.mass"),
    StructureError(["walls: none", "nodes: none"]),
)


@pytest.mark.parametrize("refusal", REFUSALS, ids=lambda refusal: type(refusal).__name__)
def test_a_refusal_survives_the_way_between_processes(refusal):
    received = pickle.loads(pickle.dumps(refusal))
    assert (str(received), vars(received)) == (str(refusal), vars(refusal))
    assert str(received)
