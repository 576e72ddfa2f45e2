"""A Newton iteration taken apart: what a march calls, how often, and how long that takes."""

from functools import partial

from tests.studies.bench.measuring import cases, loops
from tests.studies.bench.measuring.clock import medians
from tests.studies.bench.measuring.counts import counted
from tests.studies.bench.measuring.crushes import BUCKLED, COLLAPSED, Crush
from tests.studies.bench.measuring.spot import Spot
from tests.studies.bench.table import Table

STATES = {"buckled": (cases.APART, BUCKLED), "collapsed": (cases.SMOOTH, COLLAPSED)}
WHOLE, SEARCH, REST = "an iteration", "line search", "the rest"


def _sides(spot):
    names = ("EVALUATE", "FACTOR", "SOLVE", "LIMIT", "CONTACT", "CONTACT_HESSIAN")
    sides = {name: partial(spot.each, getattr(loops, name)) for name in names}
    return sides | {"SEARCH": spot.search, "ANALYSE": spot.analyse}


def split(crush, count):
    """Seconds an iteration of the whole and of its parts, by name.

    The parts are timed where the crush sets out and where it ends.
    """
    often, ends = counted(crush), (crush.state.x, crush.onwards()[1].x)
    spots = [Spot(crush.scene, x, crush.move) for x in ends]
    sides = {(k, name): side for k in (0, 1) for name, side in _sides(spots[k]).items()}
    times = medians(sides | {WHOLE: crush.each}, count)
    at = {name: 0.5 * (times[0, name] + times[1, name]) for name in _sides(spots[0])}
    evaluation = at["EVALUATE"] - at["CONTACT"]
    parts = {
        "evaluation of walls and joints": evaluation,
        SEARCH: (often["evaluate"] - 1.0) * evaluation,
        "factor": often["factor"] * (at["FACTOR"] - at["CONTACT_HESSIAN"]),
        "solve": often["solve"] * at["SOLVE"],
        "contact: energy and Hessian": often["evaluate"] * at["CONTACT"]
        + often["factor"] * at["CONTACT_HESSIAN"],
        "how far a step may go": often["limit"] * at["LIMIT"],
        "near pairs and pattern anew": often["list"] * at["SEARCH"] + often["room"] * at["ANALYSE"],
    }
    return {WHOLE: times[WHOLE], **parts, REST: times[WHOLE] - sum(parts.values())}


def table(sizes, count):
    """µs an iteration, before anything touches and after the collapse."""
    columns = tuple(f"{n} x {n} {state}" for state in STATES for n in sizes)
    found = Table("µs (% of the iteration)", columns)
    for state, given in STATES.items():
        for cells in sizes:
            times = split(Crush(cells, *given), count)
            for name, time in times.items():
                share = "" if name == WHOLE else f"{100 * time / times[WHOLE]:.0f}"
                found.put(name, f"{cells} x {cells} {state}", 1e6 * time, share)
    return found
