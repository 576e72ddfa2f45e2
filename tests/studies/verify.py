"""The numbers of the README, in its own form.

Run by `make verify` with the results of `configs/armor.toml`: the tables of its examples, and how
reliable a crush is, against independent references. These are for the 3 x 3 grid of the default
case (12.5 mm over centre lines, walls of 0.8 mm) of a linear material, Y = 12 MPa, nu = 0.48, plane
stress, and were computed outside this repository with other programs:

FRAME: geometrically exact beams, converged, without contact; glued platens; force in N.
SOLID: plane finite elements with true walls, neo-Hookean, with self-contact, converged; energy, mJ.
CRITICAL: dead load in N at which the exact frame, clamped below, loses stability; the ten nodes of
its top row bear equal shares.
"""

import io
import os
import shlex
import sys
from contextlib import redirect_stdout

import numpy as np

from sweep.__main__ import main
from sweep.config.case import Case
from sweep.ranking.rank import rank
from sweep.simulation.simulate import simulate
from sweep.store.read import read_summary
from tests.studies.tables import head, line
from tests.support import readme
from tests.support.converged import converged, demand
from tests.support.designs.tables import MATERIAL

FRAME = {0.05: 11.62, 0.1: 12.04, 0.3: 13.93}
SOLID = {0.1: 13.65, 0.3: 47.5, 0.4: 66.0, 0.5: 95.3, 0.6: 138.3}
CRITICAL = 7.35
LOADS = (6.6, 7.0, 7.5)
WATCHED = 0.137  # s

ROD = {"element": "classical", "bend_measure": "tangent"}


def pressed(pieces, strain, contact, **solver):
    """Result of a quasi-static crush between glued platens, ``pieces`` elements a wall."""
    case = Case.of(
        lattice=dict(nodes_per_wall=pieces - 1),
        material=MATERIAL,
        loading=dict(mode="displacement", strain=strain, unload=False),
        contact=dict(model=contact, friction=0.0),
        solver=dict(load_steps=round(100 * strain), **{"joints": "points"} | solver),
    )
    return converged(case)


def loaded(force, contact="none", platen="none", **solver):
    """Result of a sudden dead load, three elements a wall, steps of 1 ms, undamped."""
    case = Case.of(
        lattice=dict(nodes_per_wall=2),
        material=MATERIAL,
        loading=dict(mode="force", force=force, platen=platen),
        contact=dict(model=contact, friction=0.0),
        damping=dict(model="none"),
        solver=dict(time_step=1e-3, joints="points", **solver),
    )
    return converged(case)


def beside(name, found, reference, digits):
    """A row of results, each with its error against the reference."""
    errors = [round(100.0 * (a / b - 1.0), 1) + 0.0 for a, b in zip(found, reference, strict=True)]
    cells = zip(found, errors, strict=True)
    return [name, *(f"{value:.{digits}f} ({error:+.1f} %)" for value, error in cells)]


def frame_rows():
    """Force without contact against the exact frame."""
    reference = list(FRAME.values())
    yield ["force in N at a strain of", *(f"{100 * strain:.0f} %" for strain in FRAME)]
    yield ["exact frame", *(f"{force:.2f}" for force in reference)]
    for name, pieces, solver in (
        ("12 elements a wall", 12, {}),
        ("3 elements a wall", 3, {}),
        ("3, classical, tangent measure", 3, ROD),
    ):
        history = pressed(pieces, 0.3, "none", **solver).history
        force = np.interp(list(FRAME), history["strain"], history["reaction_top_N"])
        yield beside(name, force, reference, 2)


def solid_rows():
    """Absorbed energy with contact against solid finite elements; walls of a linear material."""
    reference = list(SOLID.values())
    yield [
        "elements, joints: energy in mJ to",
        *(f"{100 * strain:.0f} %" for strain in SOLID),
    ]
    yield ["solid", *(f"{energy:.1f}" for energy in reference)]
    for pieces, joints in ((6, "solid"), (3, "solid"), (3, "points")):
        history = pressed(pieces, 0.6, "barrier", joints=joints).history
        energy = np.interp(list(SOLID), history["strain"], 1e3 * history["work_in_J"])
        yield beside(f"{pieces}, {joints}", energy, reference, 1)


def buckling_rows():
    """Strain under a sudden dead load below and above the one that the exact frame bears."""
    yield ["strain after 0.137 s under a dead load of", *(f"{force} N" for force in LOADS)]
    yield ["exact frame", *("stands" if force < CRITICAL else "buckles" for force in LOADS)]
    for name, solver in (("cubic", {}), ("classical", {"element": "classical"})):
        histories = [loaded(force, **solver).history for force in LOADS]
        strains = [np.interp(WATCHED, past["time_s"], past["strain"]) for past in histories]
        yield [name, *(f"{strain:.3f}" for strain in strains)]


def soundness_rows():
    """Whether crushed far beyond buckling the book closes and no wall passes through another."""
    yield ["3 elements a wall, contact, loose platens", "10 N", "20 N", "40 N"]
    results = [loaded(force, "barrier", "contact") for force in (10.0, 20.0, 40.0)]
    summaries = [result.summary for result in results]
    yield ["status", *(result.status for result in results)]
    yield ["greatest strain", *(f"{summary['peak_strain']:.2f}" for summary in summaries)]
    yield ["walls that cross", *(f"{summary['max_crossings']}" for summary in summaries)]
    lost = [100.0 * row["dissipated_integrator_J"] / row["absorbed_energy_J"] for row in summaries]
    yield ["taken out by the time steps, %", *(f"{share:.0f}" for share in lost)]
    left = [abs(row["energy_residual_J"]) / row["absorbed_energy_J"] for row in summaries]
    yield ["energy left over / absorbed", *(f"{share:.0e}" for share in left)]
    yield ["processor time, s", *(f"{row['cpu_s']:.2f}" for row in summaries)]


def crush_rows(file):
    """Spread over the crushes of a sweep of the measures of the reliability of energies."""
    summary = read_summary(file)
    crushes = summary[summary["loading_mode"] == "displacement"]
    demand(crushes.to_dict("records"))
    yield [f"the {len(crushes)} crushes of `make sweep`", "least", "median", "greatest"]
    returned = 100.0 * crushes["returned_energy_J"] / crushes["absorbed_energy_J"]
    squeezed = 1.0 + crushes["least_element_strain"]
    for name, values, digits in (
        ("work returned on unloading, %", returned, 0),
        ("printed area still covered at 60 %, %", 100.0 * crushes["kept_area"], 0),
        ("shortest element, in its length at rest", squeezed, 2),
        ("walls that cross", crushes["max_crossings"], 0),
    ):
        spread = values.min(), values.median(), values.max()
        yield [name, *(f"{value:.{digits}f}" for value in spread)]


def beyond(file):
    """How many crushes of a sweep are beyond the model."""
    ranked = {by: rank(file, top=None, by=by) for by in (None, "absorbed_energy_J")}
    crushes = [rows[rows["loading_mode"] == "displacement"] for rows in ranked.values()]
    packed, whole = (int(rows["beyond_model"].sum()) for rows in crushes)
    return f"{packed} designs are beyond the model before densification, {whole} before 60 %"


def failure():
    """Message of a case that may not iterate enough."""
    solver = dict(load_steps=20, max_iterations=2)
    case = Case.of(loading=dict(mode="displacement"), solver=solver)
    result = simulate(case)
    return f'`{result.status}`, "{result.message}"'


def answer(example):
    """Output of the command of an example below its title, up to the next empty line."""
    with redirect_stdout(io.TextIOWrapper(io.BytesIO(), "utf-8")) as output:
        main(shlex.split(example.command)[1:])
    output.seek(0)
    lines = output.read().splitlines()
    begun = lines.index(example.title)
    return [line.rstrip() for line in lines[begun : lines.index("", begun)]]


TABLES = (frame_rows, solid_rows, buckling_rows, soundness_rows)
OF_THIS_RUN = ("energy left over / absorbed", "processor time, s")  # round-off and the machine


def markdown(rows):
    """Lines of a table whose first row is its head."""
    first, *others = rows
    return [*head(first), *map(line, others)]


def everything(file):
    """All lines, in the order of the README."""
    for example in readme.examples():
        yield from (f"$ {example.command}", *answer(example), "")
    for table in TABLES:
        yield from (*markdown(table()), "")
    yield from (*markdown(crush_rows(file)), "", beyond(file), "", failure())


def is_said(text):
    """True if the README has a line, or one that differs from run to run."""
    return readme.says(text) or any(text.startswith(f"| {name}") for name in OF_THIS_RUN)


if __name__ == "__main__":
    os.environ["COLUMNS"] = "104"  # as wide as the tables of the README, whatever the terminal
    loaded(1.0, "barrier", "contact")  # compiled kernels are loaded before any clock starts
    unsaid = []
    for text in everything(sys.argv[1]):
        sys.stdout.write(f"{text}\n")
        unsaid += [] if is_said(text) else [text]
    verdict = "README.md and docs say otherwise of:" if unsaid else "README.md and docs say so."
    sys.stdout.write("\n".join(["", verdict, *unsaid, ""]))
    sys.exit(len(unsaid) > 0)
