"""Loads or compiles the kernels that cases need, here or on a worker of a cluster."""

from collections.abc import Iterable
from typing import NamedTuple

from sweep.config.case import Case
from sweep.running.child_process import Simulate
from sweep.running.progress import announce

OF = {
    "marches": "walls in the plane",
    "arcs": "arc lengths",
    "plates": "walls as shells",
}
"""The walls or the method for which kernels are compiled, in words."""
UNWRITABLE = "CRUMPLE_CACHE_DIR, else the user's cache folder, is not a writable folder"


class Kernels(NamedTuple):
    """The kernels of a worker: those that it would have to compile, and whether other processes of
    its host can then use them.
    """

    cold: list[str]
    lasting: bool


def real_simulate(cases: Iterable[Case]) -> Simulate:
    """The function `simulate_again`, with the kernels that these cases need.

    It is imported only here, since it loads or compiles the kernels.
    """
    from kernels.compile.cache import is_lasting

    simulate, kernels = simulate_unloaded(cases)
    if cold := cold_kernels(kernels):
        scenes = " and of ".join(OF[name] for name in cold)
        announce(f"compiling the kernels of {scenes}, once: this takes {time_to_compile()}")
        if not is_lasting():
            announce(f"for this run alone: {UNWRITABLE}")
    load(kernels)
    return simulate


def simulate_unloaded(cases: Iterable[Case]) -> tuple[Simulate, list[str]]:
    """The function `simulate_again`, and the names of the kernels that these cases need."""
    from sweep.simulation.retries import simulate_again
    from sweep.simulation.warm_up import kernels_of

    return simulate_again, sorted({kernels_of(case) for case in cases})


def time_to_compile() -> str:
    """How long the compiler of this process takes, in words."""
    from kernels.compile.choice import FAST, compiler

    return "a minute or two" if compiler() == FAST else "two or three minutes"


def cold_kernels(kernels: Iterable[str]) -> list[str]:
    """The named kernels (keys of `SMALLEST`) that may have to be compiled."""
    from kernels.compile.cache import is_cold

    return [name for name in kernels if is_cold(name)]


def inspect_kernels(kernels: Iterable[str]) -> Kernels:
    """The state of the named kernels in this process, a worker."""
    from kernels.compile.cache import is_lasting

    return Kernels(cold_kernels(kernels), is_lasting())


def load(kernels: Iterable[str]) -> None:
    """Load or compile the named kernels, and record that they are cached."""
    from kernels.compile.cache import warmed_up
    from sweep.simulation.warm_up import warm_up

    for name in kernels:
        warm_up([name])
        warmed_up(name)
