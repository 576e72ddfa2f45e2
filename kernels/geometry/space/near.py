import numpy as np
from kernels.compile.jit import jit_exact
@jit_exact
def longest(move, n_nodes):
    most = 0.0
    for p in range(n_nodes):
        most = max(most, (move[6*p]**2+move[6*p+1]**2+move[6*p+2]**2)**0.5)
    return most
@jit_exact
def farthest(x, other, n_nodes):
    most = 0.0
    for p in range(n_nodes):
        most = max(most, ((x[6*p]-other[6*p])**2+(x[6*p+1]-other[6*p+1])**2+(x[6*p+2]-other[6*p+2])**2)**0.5)
    return most
