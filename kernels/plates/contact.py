from typing import NamedTuple
import numpy as np
from kernels.compile.jit import jit_exact, jit_owning
class Contact(NamedTuple):
    reach: float
    most_move: float
    triangles: np.ndarray
    edges: np.ndarray
    area: np.ndarray
    high_nodes: np.ndarray
    low: int
    high: int
class Touching(NamedTuple):
    count: np.ndarray
@jit_owning
def no_contacts(contact, pairs):
    return Touching(np.zeros(1,np.int64))
@jit_exact
def evaluate(x, contact, pairs, drift, touching, g):
    return 0.0
@jit_exact
def step_limit(x, dx, far, contact, pairs, drift):
    return 1.0
@jit_exact
def least_gap(x, contact, pairs, drift):
    return np.inf
