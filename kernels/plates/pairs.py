from typing import NamedTuple
import numpy as np
from kernels.compile.jit import jit_owning
class Pairs(NamedTuple):
    start: np.ndarray
    triangle: np.ndarray
    bound: np.ndarray
    d_contact: np.ndarray
    one: np.ndarray
    two: np.ndarray
    edge_bound: np.ndarray
    edge_contact: np.ndarray
@jit_owning
def find(x, contact, radius):
    z=np.zeros(0,np.int64); f=np.zeros(0)
    return Pairs(np.zeros(contact.area.size+1,np.int64),z,f,f,z,z,f,f)
