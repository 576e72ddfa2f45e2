"""The verb `materials`: list them, show one, plot several, fit one to a coupon."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sweep.array_types import Floats
from sweep.cli.refusals import ArgumentError, writing
from sweep.cli.terminal import print_sheets, say, say_all
from sweep.whole_file import write_whole

if TYPE_CHECKING:
    from sweep.config.materials.material_file import Record

PLOTTED = -0.6, 1.0, 401  # strains and number of points of a picture
UNBROKEN = 0.1  # strain to which a plastic is drawn if its file states no break
PICTURE = "materials.png"
OF_A_FIT = ("gauge", "area", "density", "speed", "test", "zero", "units", "columns")


def materials(arguments: Namespace) -> None:
    """List, show, plot or fit."""
    from sweep.config.materials.material_file import available

    first, *names = arguments.words or [""]
    if first != "fit":
        _refuse_options_of_a_fit(arguments)
    if first == "fit":
        _fit(arguments, names)
    elif first == "plot":
        _plot(names or available(), Path(arguments.out or PICTURE))
    elif arguments.out:
        raise ArgumentError("--out belongs to plot and fit")
    elif first:
        _show([first, *names])
    else:
        _list(available())


def _refuse_options_of_a_fit(arguments: Namespace) -> None:
    options = [name for name in OF_A_FIT if getattr(arguments, name)]
    if options:
        raise ArgumentError(f"--{options[0]} belongs to fit")


def _record(name: str) -> Record:
    from sweep.config.materials.material_file import locate, read_record

    return read_record(locate(name))


def _list(names: list[str]) -> None:
    from sweep.report.tables.material_sheets import material_sheet

    print_sheets([material_sheet(map(_record, names))])


def _show(names: list[str]) -> None:
    from sweep.report.tables.material_sheets import details

    for name, record in [(name, _record(name)) for name in names]:
        say(name)
        say_all(f"  {line}" for line in details(record))


def _plot(names: list[str], out: Path) -> None:
    from sweep.report.figures.case_plots import blank, save
    from sweep.report.figures.material_plots import material_curves

    figure = blank(11.0, 4.6)
    material_curves(figure, {record.name: _curve(record) for record in map(_record, names)})
    with writing(out.parent, out):
        picture = save(figure, _png(out))
    say(picture)


def _curve(record: Record) -> tuple[Floats, Floats]:
    """Strain and stress of the first loading, to the end of the record or to the break."""
    from sweep.config.kinds.material import Material, material
    from sweep.scene.material import monotonic_law

    low, high, count = PLOTTED
    broken = record.plasticity.get("fracture_strain", UNBROKEN)
    ends = (-broken, broken) if record.plasticity else (-0.95, max(record.strain))
    strain = np.linspace(max(low, ends[0]), min(high, ends[1]), count)
    numbers = {"modulus": record.modulus, "density": record.density, "poisson": record.poisson}
    if record.plasticity:
        plotted = material({**numbers, **record.plasticity})
    else:
        curve = {"curve_strain": record.strain, "curve_stress": record.stress}
        plotted = Material.model_validate({"name": record.name, **numbers, **curve})
    return strain, monotonic_law(plotted).at(strain)


def _png(path: Path) -> Path:
    if path.suffix != ".png":
        raise ArgumentError(f"--out {path}; allowed: a file whose name ends in .png")
    return path


def _fit(arguments: Namespace, names: list[str]) -> None:
    from sweep.config.materials.material_file import read_record
    from sweep.coupon.answers import UNITS, Answers
    from sweep.coupon.fit import fit
    from sweep.coupon.record import read_coupon
    from sweep.coupon.write import file_beside, fit_sentence, material_text, sentences_on_fit
    from sweep.report.figures.case_plots import blank, save
    from sweep.report.figures.material_plots import coupon_fit

    if len(names) != 1:
        raise ArgumentError("fit needs the file of one coupon: crumple materials fit coupon.csv")
    file = Path(names[0])
    out = file_beside(file, arguments.out, "--out")
    columns, units = (_by_quantity(getattr(arguments, key), key) for key in ("columns", "units"))
    sizes = {name: getattr(arguments, name) for name in UNITS}
    answers = Answers.of(sizes, arguments.test, arguments.zero, columns, units)
    coupon = read_coupon(file, answers)
    law = fit(coupon)
    with writing(out.parent, out):
        write_whole(out, material_text(law, answers.density))
    say_all(sentences_on_fit(law, read_record(out)))
    figure = blank(8.0, 6.0)
    record, model = (coupon.strain, coupon.stress), (coupon.strain, law.model)
    coupon_fit(figure, record, model, f"{coupon.name}: {fit_sentence(law)}")
    picture = save(figure, out.with_suffix(".png"))
    acts = '; its loss and softening act with material.memory = "measured"'
    say(f"{out}: for material.name{acts if law.memory else ''}")
    say(picture)


def _by_quantity(words: list[str] | None, option: str) -> dict[str, str]:
    """The words of an option, such as "force=kN", by their quantity."""
    from sweep.coupon.unit import SI

    pairs = [word.partition("=") for word in words or []]
    for quantity, _, value in pairs:
        if quantity not in SI or not value:
            allowed = ", ".join(f"{name}=..." for name in SI)
            raise ArgumentError(f"--{option} {quantity}; allowed: {allowed}")
    return {quantity: value for quantity, _, value in pairs}
