"""The stress of one material point along a given strain: a tensile test without a specimen."""

import numpy as np

from kernels.compile.jit import jit_owning
from kernels.laws.law import Memory


@jit_owning
def stresses(law, time, strain):
    """Return the stress (n,) in Pa at the strains (n,) that a point reaches at the times (n,) in s.

    The point is at rest before the first time. The strain changes evenly between two times.
    """
    pace = law.make_pace()
    memory = Memory(np.zeros((1, law.state_size())), np.zeros((1, 2)), pace)
    stress = np.empty(strain.size)
    for i in range(strain.size):
        law.set_pace(time[i] - time[i - 1] if i > 0 else 0.0, pace)
        law.begin(memory, 0)
        stress[i] = law.respond(strain[i], memory, 0)[1]
        law.commit(strain[i], memory, 0)
    return stress
