"""Counts the calls in a march: its kernels run compiled, all their callers as Python."""

from collections import Counter
from unittest.mock import patch

from kernels.compile.jit import Kernel
from kernels.planar import neighbour_lists
from kernels.planar.problem import Planar

WATCHED = {Planar.factor: "factor", neighbour_lists.list_neighbours: "list"}
COMPILED = (Planar.descend,)  # meets records that only compiled code can read


def counted(crush):
    """Calls an iteration of every part while a crush goes on."""
    calls, compiled = Counter(), Kernel.__call__

    def call(kernel, *args):
        if kernel not in WATCHED:
            return compiled(kernel, *args) if kernel in COMPILED else kernel.__wrapped__(*args)
        calls[WATCHED[kernel]] += 1
        return compiled(kernel, *args)

    with patch.object(Kernel, "__call__", call):
        spent, _ = crush.onwards()
    return {part: calls[part] / spent.iterations for part in WATCHED.values()}
