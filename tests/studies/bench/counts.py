"""How often a march calls what it is made of: its loops run as Python, what they call compiled."""

from collections import Counter
from contextlib import ExitStack
from unittest.mock import patch

from kernels.planar import reach
from kernels.planar.problem import Planar, PlanarScene
from kernels.solve import march, newton

# Whatever stands between these, and what returns arrays to code that counts no references.
LOOPS = [(march, "march"), (march, "_run"), (march, "_begin_share"), (march, "_step")]
LOOPS += [(march, "_equilibrate"), (march, "minimise"), (march, "make_workspace")]
LOOPS += [(PlanarScene, name) for name in ("find_neighbours", "renew_neighbours", "assemble")]
WATCHED = {
    "evaluate": (Planar, "evaluate"),
    "factor": (Planar, "factor"),
    "solve": (newton, "_newton_direction"),
    "limit": (Planar, "step_limit"),
    "list": (reach, "list_neighbours"),
    "room": (reach, "make_system"),
}


def counted(crush):
    """Calls an iteration of every part while a crush goes on."""
    calls = Counter()

    def watched(name, function):
        def call(*args):
            calls[name] += 1
            return function(*args)

        return call

    with ExitStack() as patches:
        for place, name in LOOPS:
            loop = getattr(place, name).__wrapped__
            patches.enter_context(patch.object(place, name, loop))
        for part, (place, name) in WATCHED.items():
            watch = watched(part, getattr(place, name))
            patches.enter_context(patch.object(place, name, watch))
        spent, _ = crush.onwards()
    return {part: calls[part] / spent.iterations for part in WATCHED}
