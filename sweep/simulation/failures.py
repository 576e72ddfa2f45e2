"""The status and the message of a case that does not finish: what happened, and what to try.

A converged case whose material breaks has a message too. Cases that end without a simulation, as
their memory or their worker is lost, get theirs from `running.child_process`
and `running.dask_graph`.
"""

from collections.abc import Mapping
from math import sqrt
from typing import Any

import numpy as np

from kernels.solve import outcomes
from kernels.solve.march import MOST_DOUBLINGS
from sweep.config.case import Case
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.solver import Arcs, InTime
from sweep.numbers import percent, short, with_unit
from sweep.result import Status
from sweep.simulation.time_resolution import resolving_step

Failure = tuple[Status, str]

SAFER = {
    (False, False): 'try smaller steps, damping or solver.integrator "backward_euler"',
    (False, True): "try smaller steps or damping",
    (True, False): 'try smaller steps or solver.integrator "backward_euler"',
    (True, True): "try smaller steps",
}
"""By whether walls are shells, without damping, and whether the integrator is backward Euler."""
FINER = "try more solver.load_steps"
PASSED = """\
the striker has passed the lattice: it misses it, slips off, or both fall off the base, {}; \
try another loading.striker_at or loading.base_span"""
BELOW = 'the striker has pressed the lattice below its base, {}; try a contact.model of "barrier"'
SOUNDER = "try a smaller solver.tolerance, and check for values of the wrong order of magnitude"
ADVICE = {
    outcomes.ITERATIONS: "no equilibrium within {limit} Newton iterations; try {further}",
    outcomes.STALLED: "the minimisation stalled; try a looser solver.tolerance or smaller steps",
    outcomes.SINGULAR: "no stable equilibrium was found; check the supports{damped}",
    outcomes.INACCURATE: "no step was short enough for {needed}",
    outcomes.UNBALANCED: f"work and energies do not balance; {SOUNDER}",
    outcomes.UNRESOLVED: "the forces are too small, or the steps too short, for the motion to "
    "exceed round-off; try larger steps or loads",
    outcomes.NOT_FINITE: "the solution diverged; try smaller steps or a smaller load",
}
APART = (
    "the minimisation stalled, as the load presses walls that nothing keeps apart; "
    'try contact.model "barrier" or a smaller load'
)
MOVES_DOWN = "the striker still moves down; try a longer loading.duration"
PUSHED_BACK = "the lattice still pushes the striker back; try a longer loading.duration"
SLIPPED_OFF = (
    "the striker lost the lattice: it missed or slipped off, or ribs let the lattice through; "
    "try another loading.striker_at or loading.base_span, or a smaller strain"
)
TIPPED_OVER = (
    "the lattice tipped over between the loose platens, and bears nothing at full stroke; "
    'try more solver.load_steps, a wider lattice, or a loading.platen of "glued"'
)
BALANCE = "its energy to balance; try a larger load, or another solver.integrator"
LOST = "no equilibrium within the shortest arc; try a smaller solver.arc_length"


def stopped(case: Case, outcome: int, where: str, driven: bool) -> Failure:
    """The solver has ended with an ``outcome`` other than `outcomes.CONVERGED`.

    where: stage, strain and number of steps, in words. driven: a platen or a support is moved.
    """
    if outcome == outcomes.INTERRUPTED:
        return Status.STOPPED, f"interrupted {where}; run again to complete it"
    why = LOST if isinstance(case.solver, Arcs) else _advice(case, outcome, driven)
    return stopped_as(why, where)


def stopped_as(why: str, where: str) -> Failure:
    """The case has no result: ``why``, with what to try, and ``where`` it is, in words."""
    what, _, advice = why.partition("; ")
    return Status.STOPPED, f"{what} {where}; {advice}"


def _advice(case: Case, outcome: int, driven: bool) -> str:
    """What happened in a step, and what to try."""
    solver = case.solver
    timed = solver.load_steps is None
    shorter = "a smaller solver.time_step" if timed else "more solver.load_steps"
    # A lattice that buckles under a dead load goes all the way at once, in however short a step.
    buckles = not timed and not driven
    further = "a larger solver.max_iterations" if buckles else shorter
    limit = solver.max_iterations
    loose = isinstance(case.loading, DeadLoad) and case.contact.model == "none"  # may overlap
    if outcome == outcomes.STALLED and loose:
        return APART
    if case.loading.quasi_static:
        limit <<= MOST_DOUBLINGS  # of the last attempt
    error = isinstance(solver, InTime) and solver.step_error is not None
    needed = f"solver.step_error; try a larger one or {shorter}" if error else BALANCE
    damped = "" if case.loading.quasi_static or case.shells else " or add damping"
    return ADVICE[outcome].format(limit=limit, further=further, damped=damped, needed=needed)


def timed_out(case: Case, where: str) -> Failure:
    """The case has taken longer than `solver.time_limit`."""
    reached = f"solver.time_limit of {case.solver.time_limit:g} s reached {where}"
    return Status.TIMED_OUT, f"{reached}; raise it and add --retry-failed"


def energy_gained(case: Case) -> Failure:
    """The time integration has gained energy."""
    safer = SAFER[case.shells, case.solver.integrator == "backward_euler"]
    advice = FINER if case.loading.quasi_static else safer
    return Status.STOPPED, f"the time integration gained energy; {advice}"


def passed_lattice(case: Case, where: str) -> Failure:
    """The striker of a case that has finished is below the base."""
    is_flat = isinstance(case.loading, Impact) and not case.loading.is_shaped
    return Status.SLIPPED, (BELOW if is_flat else PASSED).format(where)


def energy_unresolved(case: Case, share: float) -> Failure:
    """The integrator has removed or created a share of the energy of an impact."""
    what = f"the time integrator removed or created {percent(share)} % of the energy"
    return Status.UNRESOLVED, f"{what}; {_finer(case)}"


def momentum_unresolved(case: Case, share: float) -> Failure:
    """The support has not taken the momentum of an impact, as rows are too far apart."""
    what = "the steps are too long for the contact: the impulse on the support differs from the"
    return Status.UNRESOLVED, f"{what} momentum of the impact by {percent(share)} %; {_finer(case)}"


def faster_than_sound(case: Case) -> str:
    """Why an impact, or a crush with a speed, fails if it is faster than c = (modulus /
    density)^(1/2); empty if it is slower. The wave front strains walls with a linear law by v / c.
    """
    loading = case.loading
    if loading.quasi_static or not isinstance(loading, Impact | Crush):
        return ""
    ratio = (loading.approach or 0.0) / sqrt(case.material.modulus / case.material.density)
    presses = "striker" if isinstance(loading, Impact) else "platen"
    what = f"the {presses} moves at {short(ratio)} times the speed of sound in the walls"
    return f"; {what}: its wave front would press them to no length" if ratio > 1.0 else ""


def _finer(case: Case) -> str:
    """The time step that may resolve an impact, and the integrator of second order."""
    first_order = case.solver.integrator == "backward_euler"
    other = ' and solver.integrator "bdf2"' if first_order else ""
    return f"try a solver.time_step of {with_unit(resolving_step(case), 's')}{other}"


def broke(summary: Mapping[str, Any], case: Case) -> bool:
    """Whether a fibre was stretched beyond the strain at which its material breaks."""
    limit = case.material.fracture_strain
    return limit is not None and summary["greatest_fibre_strain"] > limit


def break_message(summary: Mapping[str, Any]) -> str:
    """Where the specimen broke; a custom structure has no strain of its own."""
    strain = summary["broke_at_strain"]
    where = f"broke at a strain of {strain:.3g}:"
    if np.isnan(strain):
        greatest = summary["greatest_fibre_strain"]
        where = f"a wall broke: the greatest strain of a fibre is {greatest:.3g},"
    return f"{where} later rows assume unbroken walls"
