"""Scenes whose walls are of a law with memory, and what a march makes of them.

To be run as plain Python: a march is compiled anew for each law, which takes longer. `printed`
calls a function of this module so, in a process of its own.
"""

import json
import os
import subprocess
import sys
from dataclasses import replace
from unittest.mock import patch

import numpy as np

from kernels.planar import problem as planar
from kernels.planar.potential import STORED
from kernels.solve import march
from kernels.solve.problem import Step
from kernels.solve.workspace import make_workspace
from sweep.config.case import Case, Contact, Damping, Lattice, Loading, Material, Solver
from sweep.scene.custom import build_structure
from sweep.scene.lattice import build_scene
from sweep.scene.material import as_law, linear_law
from sweep.simulation.simulate import simulate
from tests.studies.validation.frames import TRUSS
from tests.support.laws import Bent, Clock, standard_solid
from tests.support.solving import at_rest, go_on, neighbours_of, problem_of
from tests.support.structures import BEAM, MATERIAL, structure
from tests.support.terms import nowhere

MODULUS, BRANCH, TIME = 12e6, 0.5, 0.2  # of the spring, Pa; of the branch over it; s
STRAIN, DEEP = 0.02, 0.1
TIP = 1e-5  # N
SURFACE = 0.1  # strain at the surface of a wall per turn of an element
PROGRAM = """
import json
from tests.support import relaxing
print(json.dumps([relaxing.{name}(*each) for each in {calls}]))
"""


def printed(name, *calls):
    """What a function of this module returns, as plain Python, for each tuple of arguments."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(name=name, calls=calls)],
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def linear(modulus):
    """A linear spring, exact at the smallest strains too."""
    return as_law(linear_law(modulus), 1.0, modulus)


def columns(rows):
    """Rows of a march as lists by name."""
    return {name: rows[name].tolist() for name in rows.dtype.names}


def crushed(cells=1, nodes=0, imperfection=0.0):
    """A case and its scene: a lattice between glued platens, whose walls are a standard solid."""
    case = Case(
        lattice=Lattice(
            cells_x=cells, cells_y=cells, nodes_per_wall=nodes, imperfection=imperfection
        ),
        material=Material(modulus=MODULUS, density=1190.0, poisson=0.48, plane="stress"),
        loading=Loading(mode="displacement", strain=0.1, platen="glued"),
        contact=Contact(model="none"),
        damping=Damping(model="none"),
        solver=Solver(load_steps=1, tolerance=1e-12),
    )
    scene = build_scene(case)
    law = standard_solid(linear(MODULUS), BRANCH, TIME)
    return case, replace(scene, terms=scene.terms._replace(law=law))


def pressed(scene, steps, duration, strains, dynamic=False):
    """A stage of ``steps`` that take ``duration`` (s) in all, from one strain to another."""
    high = scene.x_rest[-1]
    height = np.ptp(scene.mesh.points[:, 1])
    driven = [high - strain * height for strain in strains]
    return march.Stage(steps, duration / steps, dynamic, 0.0, 0.0, *driven)


def marched(case, scene, state, stages, **tolerance):
    """March through ``stages``; return the outcomes, and the columns of all rows."""
    done = [go_on(case, scene, state, stage, **tolerance) for stage in stages]
    rows = np.concatenate([rows for _, rows in done])
    return [int(outcome) for outcome, _ in done], columns(rows)


def held(steps):
    """Straight columns pressed in no time, then held for a time `TIME`."""
    case, scene = crushed()
    state = at_rest(scene)
    sudden = pressed(scene, 1, 0.0, (0.0, STRAIN))
    return marched(case, scene, state, [sudden, pressed(scene, steps, TIME, (STRAIN, STRAIN))])


def cycled(time, dynamic, steps):
    """A lattice that buckles, pressed to `DEEP` and let up, each in a ``time``, s."""
    case, scene = crushed(cells=2, nodes=2, imperfection=0.01)
    state = at_rest(scene)
    ways = [(0.0, DEEP), (DEEP, 0.0)]
    return marched(case, scene, state, [pressed(scene, steps, time, w, dynamic) for w in ways])


def kept():
    """Stored energies after a march, by its state and as the problem tells them again."""
    case, scene = crushed(nodes=2, imperfection=0.01)
    state, terms = at_rest(scene), scene.terms
    marched(case, scene, state, [pressed(scene, 2, TIME, (0.0, STRAIN))])
    problem = problem_of(terms, neighbours_of(state.x, terms), terms.make_buffers(state.memory))
    step = Step(state.x, state.x, state.x, TIME, TIME, False, 0.0, 0.5)
    problem.begin(step, nowhere(state.x.size), np.zeros(state.x.size))
    found = make_workspace(state.x.size, STORED).found
    problem.store(state.x, step, found)
    return state.stored.tolist(), found.stored.tolist()


def timed():
    """What walls that tell the time have counted, and the time of the march (s), its steps and its
    rows: of a crush that halves steps, of the same with inertia, and of a path that halves arcs.
    """
    spring, found = linear(MODULUS), []
    law = Clock(spring, spring.modulus)
    press = {"mode": "displacement", "strain": 0.3, "unload": False}
    short = {"load_steps": 2, "max_iterations": 3}
    lattice = Lattice(cells_x=1, cells_y=1)
    arched = Lattice(kind="custom", structure=structure(**TRUSS | {"subdivide": 1}))
    cases = [
        Case(lattice=lattice, loading=Loading(**press), solver=Solver(**short)),
        Case(lattice=lattice, loading=Loading(speed=10.0, **press), solver=Solver(**short)),
        Case(
            lattice=arched,
            contact=Contact(model="none"),
            material=MATERIAL,
            solver=Solver(
                integrator="arc_length", load_steps=40, max_iterations=4, arc_length=4e-2
            ),
        ),
    ]
    for case in cases:
        states = []

        def begun(*of, states=states):
            states.append(planar.at_rest(*of))
            return states[0]

        with (
            patch("sweep.scene.terms.law_in_stretch", lambda *_: law),
            patch("sweep.simulation.simulate.at_rest", begun),
        ):
            result = simulate(case)
        (state,), steps = states, len(result.history["time_s"]) - 1
        count = state.memory[: len(result.frames["edges"]), 0]
        time, taken = (float(state.totals[name][0]) for name in ("time", "steps"))
        found.append([count.tolist(), time, taken, steps])
    return found


def retried():
    """Where a stage leads at once, and after a try that has found nothing; what that has left."""
    case, scene = crushed(nodes=2, imperfection=0.01)
    first = pressed(scene, 2, TIME, (0.0, STRAIN))
    last = pressed(scene, 3, TIME, (STRAIN, 2.0 * STRAIN))
    straight, again = at_rest(scene), at_rest(scene)
    for state in (straight, again):
        marched(case, scene, state, [first])
    before = again.memory.copy()
    failed = marched(case, scene, again, [last], iterations=0)
    left = again.memory.copy()
    for state in (straight, again):
        marched(case, scene, state, [last])
    memories = before, left, straight.memory, again.memory
    return failed, [memory.tolist() for memory in memories]


def crept(steps):
    """Deflection (m) of a cantilever under a dead load, at once and after a time `TIME`."""
    parts = BEAM | {"subdivide": 4, "loads": [{"node": 1, "force_N": [0.0, -TIP]}]}
    case = Case(
        lattice=Lattice(kind="custom", structure=structure(**parts)),
        material=MATERIAL,
        contact=Contact(model="none"),
        solver=Solver(integrator="static", load_steps=1),
    )
    scene = build_structure(case)
    of, spring = scene.terms.bend, linear(MODULUS)
    solid = standard_solid(spring, BRANCH, TIME)
    per_volume = of.stiffness[1] / (MODULUS * SURFACE**2)
    curved = of._replace(
        section=Bent(solid, solid.modulus),
        spread=np.outer([1.0, np.sqrt(3.0)], np.full(len(per_volume), SURFACE)),
        volume=per_volume / 8.0,  # so that 2 V Y (theta_1^2 + theta_2^2) / 2 is E_b
        shear=np.zeros(len(per_volume)),
    )
    scene = replace(scene, terms=scene.terms._replace(bend=curved))
    state, sunk = at_rest(scene), []
    stages = [
        march.Stage(1, 0.0, False, 0.0, 1.0, 0.0, 0.0),
        march.Stage(steps, TIME / steps, False, 1.0, 1.0, 0.0, 0.0),
    ]
    for stage in stages:
        outcomes, rows = marched(case, scene, state, [stage])
        sunk.append(-float(state.x[3]))
    return outcomes, rows, sunk
