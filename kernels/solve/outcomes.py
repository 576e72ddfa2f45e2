"""How a minimisation, a share of a step or an arc ends."""

CONVERGED = 0
ITERATIONS = 1  # too many iterations
STALLED = 2  # no admissible move lowers the energy
INTERRUPTED = 3  # by the caller
SINGULAR = 4  # not even a shifted Hessian is positive definite
NOT_FINITE = 5  # energy or residual is infinite or not a number
OUTGROWN = 6  # neighbour lists or matrix are too small: renew them and call again
INACCURATE = 7  # the local error is larger than allowed, or energy is generated
UNBALANCED = 8  # the work of the residual is too large
UNRESOLVED = 9  # the residual is round-off, but too large relative to the forces
UNFINISHED = 10  # none yet: the iteration continues
