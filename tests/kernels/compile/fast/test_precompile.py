"""`crumple warm`: what it compiles is all that a run needs."""

import os
import re
import subprocess
import sys
from pathlib import Path

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.support.designs.structures import BEAM, structure

PRESSED = {"mode": "displacement", "strain": 0.01}
BRIEF = {"release_time": 2e-4, "duration": 4e-4}
TWO = dict(load_steps=2)
TIP = {"node": 1, "force_N": [0.0, -1e-3]}
CASES = {
    "glued": Case.of(loading=PRESSED, solver=TWO),
    "loose": Case.of(loading=dict(**PRESSED, platen="contact", unload=False), solver=TWO),
    "at a speed": Case.of(loading=dict(**PRESSED, speed=0.1), solver=TWO),
    "classical": Case.of(
        loading=PRESSED,
        material=dict(bend="linear"),
        solver=dict(load_steps=2, element="classical", bend_measure="tangent"),
    ),
    "dead load": Case.of(loading=BRIEF),
    "dead load on a platen": Case.of(loading=dict(**BRIEF, platen="glued")),
    "without contact": Case.of(loading=BRIEF, contact=dict(model="none")),
    "without friction": Case.of(loading=BRIEF, contact=dict(friction=0.0)),
    "without damping": Case.of(loading=BRIEF, damping=dict(model="none")),
    "viscous": Case.of(loading=BRIEF, damping=dict(model="kelvin_voigt")),
    "linear": Case.of(loading=BRIEF, material=dict(stretch="linear")),
    "no inner nodes": Case.of(loading=BRIEF, lattice=dict(nodes_per_wall=0)),
    "one inner node": Case.of(loading=BRIEF, lattice=dict(nodes_per_wall=1)),
    "an arc": Case.of(
        lattice=dict(kind="custom", structure=structure(**BEAM, loads=[TIP])),
        solver=dict(integrator="arc_length", load_steps=2),
    ),
    "one cell": Case.of(loading=BRIEF, lattice=dict(cells_x=1, cells_y=1)),
}


WARM = """
from sweep.__main__ import main

assert main(["warm"]) == 0
"""
THEN = """
from tests.kernels.compile.fast.test_precompile import added, unforeseen

print("then", *added(), *unforeseen())
"""


def versions():
    """How many compiled versions of each kernel this process has loaded."""
    from kernels.compile.fast.kernel import Kernel

    modules = [module for name, module in sys.modules.items() if name.startswith("kernels.")]
    kernels = {id(k): k for m in modules for k in vars(m).values() if isinstance(k, Kernel)}
    return {
        f"{kernel.__module__}.{kernel.__qualname__}": len(kernel.linked.signatures)
        + len(kernel.entry.signatures if "entry" in vars(kernel) else ())
        for kernel in kernels.values()
    }


def added():
    """Kernels of which a case needed a version that the cases before it did not, with the case."""
    found = []
    for name, case in CASES.items():
        before = versions()
        simulate(case)
        found += [f"{kernel} {name}" for kernel, n in versions().items() if n > before[kernel]]
    return found


def unforeseen():
    """Kernels that a rehearsal in plain Python foresees with other types than they have."""
    from kernels.compile.fast.precompile import rehearse
    from sweep.simulation.simulate import warm_up

    foreseen = rehearse(lambda: warm_up(arcs=True))
    loaded = [(version, version.compiled()) for version in foreseen]
    return [
        version.name
        for version, compiled in loaded
        if compiled.metadata is not None or compiled.signature.return_type != version.returns
    ]


def run(script):
    """What a process of its own prints: no other test has loaded anything there."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", script],
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[4])},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "Warning" not in done.stderr  # compiling is told there
    return done.stdout.splitlines()


def test_after_warm_no_run_compiles_or_loads_anything():
    """The second process finds what the first has kept, whichever process compiled that."""
    assert re.fullmatch(r".* kernels .*in \d+\.\d s; later runs need not compile", run(WARM)[-1])
    assert run(WARM + THEN)[-1] == "then"
