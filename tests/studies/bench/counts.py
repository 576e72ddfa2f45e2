"""How often a march calls what it is made of: its loops run as Python, what they call compiled."""

from collections import Counter
from contextlib import ExitStack
from unittest.mock import patch

from kernels.solve import march, newton
from kernels.planar import potential as step

# Whatever stands between these, and `_step`, which returns arrays to code that counts none.
LOOPS = [(march, name) for name in ("march", "_go", "_step", "_balance")]
LOOPS += [(newton, "minimise"), (step, "renew"), (step, "find_near")]
WATCHED = {
    "evaluate": (newton, "evaluate"),
    "factor": (newton, "factor"),
    "solve": (newton, "_solve"),
    "limit": (newton, "step_limit"),
    "list": (step, "list_near"),
    "room": (step, "make_system"),
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
        for module, name in LOOPS:
            loop = getattr(module, name).__wrapped__
            for place in {module, march}:
                patches.enter_context(patch.object(place, name, loop))
        for part, (module, name) in WATCHED.items():
            watch = watched(part, getattr(module, name))
            patches.enter_context(patch.object(module, name, watch))
        spent, _ = crush.onwards()
    return {part: calls[part] / spent.iterations for part in WATCHED}
