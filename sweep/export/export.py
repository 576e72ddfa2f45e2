"""Writes a case as a file for another program, in the format given by the ending of its name."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Sized
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeVar

from sweep.constants import TO_MM, TO_MM3
from sweep.export.curves import write_curves
from sweep.export.dxf import write_dxf
from sweep.export.errors import ExportError
from sweep.export.outline import Layout, block, filled_panel, outline, panel, specimen
from sweep.export.shapes import write_shapes
from sweep.export.solid import Body, extruded, solid
from sweep.export.stl import write_stl
from sweep.export.svg import write_svg
from sweep.export.three_mf import write_3mf
from sweep.numbers import in_unit, text_in
from sweep.store.read import read_case, read_cases, read_frames, read_history, read_summary
from sweep.whole_file import whole

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from pandas import DataFrame

    from sweep.config.case import Case
    from sweep.export.design import Design

Kind = Literal["lattice", "settings"]
Result = TypeVar("Result", bound=Sized)
SOLID = "print it with 100 % infill"
SHOWN = 0.05  # mm: least difference of lengths that is reported


class Exported(NamedTuple):
    """The file that was written, and sentences about its contents."""

    file: Path
    notes: list[str]


@dataclass(frozen=True)
class Source:
    """A case in a results file, of which each part is read when it is needed.

    row: of the case in the summary; empty if the case, `planned`, need not have run.
    """

    file: str | os.PathLike[str] = ""
    row: Mapping[str, Any] = field(default_factory=dict)
    planned: Case | None = None

    @cached_property
    def case(self) -> Case:
        """The case."""
        return self.planned or read_case(self.file, self.row["case_id"])

    @cached_property
    def design(self) -> Design:
        """The printed design."""
        from sweep.export.design import design_of

        return design_of(self.case)

    @property
    def history(self) -> DataFrame:
        """The curves."""
        return self._read(read_history, "curves")

    @property
    def frames(self) -> dict[str, NDArray[Any]]:
        """The shapes."""
        return self._read(read_frames, "shapes")

    def _read(self, read: Callable[[str | os.PathLike[str], str], Result], what: str) -> Result:
        """Results of the case, which are refused if there are none."""
        if not self.row:
            raise ExportError(
                f"a case alone has no {what}; allowed: a results file and the id of a case in it, "
                f"or {PRINTED}"
            )
        results = read(self.file, self.row["case_id"])
        if not len(results):
            why = self.row["message"] or f"it is {self.row['status']}"
            raise ExportError(f"case {self.row['case_id']} has no {what}: {why}")
        return results


class Wish(NamedTuple):
    """The requested print: a panel of these sides (m) or one specimen, and the kind of 3MF."""

    panel: Sequence[float] | None
    kind: Kind


def export_case(
    source: Case | str | os.PathLike[str],
    to: str | os.PathLike[str],
    case_id: str = "",
    panel: Sequence[float | str] | None = None,
    kind: Kind | None = None,
) -> Exported:
    """Write a case as .stl, .3mf, .svg, .dxf, .csv, .vtkhdf or .gif.

    Parameters
    ----------
    source : a case, or a results file.
    to : the file to write; a file of that name is replaced.
    case_id : of the case in the results file.
    panel : two lengths (m, or text with a unit) that whole specimens fill as nearly as they can,
        side by side along the first, one behind the other along the second; `rank` counts the same
        ones. Without it, one specimen.
    kind : of a .3mf: "lattice" (default), the walls themselves, printed with 100 % infill;
        "settings", a solid block whose infill the slicer draws.
    """
    path = Path(to)
    wish = check_export(path, panel, kind)
    with whole(path) as file:
        notes = _writer(path)(file, _source(source, case_id), wish)
    return Exported(path, notes)


def printed(file: str | os.PathLike[str], case_ids: Iterable[str]) -> Iterator[bytes | None]:
    """What `export_case` writes as .3mf for cases of a results file; None where it refuses."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "print.3mf"
        for case in read_cases(file, case_ids):
            try:
                _three_mf(path, Source(planned=case), Wish(None, "lattice"))
            except ExportError:
                yield None
            else:
                yield path.read_bytes()


def check_export(path: Path, panel: Sequence[float | str] | None, kind: Kind | None) -> Wish:
    """Refuse arguments of `export_case` that contradict each other; nothing is read or written."""
    writer = _writer(path)
    if (panel or kind) and writer not in PRINTS.values():
        raise ExportError(f"{path.name} shows no print; allowed with a panel or a kind: {PRINTED}")
    if kind and path.suffix.lower() != ".3mf":
        raise ExportError(f"{path.name} has one kind only; allowed with a kind: .3mf")
    if kind not in (None, "lattice", "settings"):
        raise ExportError(f'kind "{kind}"; allowed: lattice, settings')
    return Wish(_sides(panel), kind or "lattice")


def _writer(path: Path) -> Writer:
    """The writer of the format that the name of a file implies."""
    if writer := WRITERS.get(path.suffix.lower()):
        return writer
    wrong = f"{path.suffix} is unknown" if path.suffix else "has no ending"
    raise ExportError(f"{path.name or path}: {wrong}; allowed: {', '.join(WRITERS)}")


def _sides(panel: Sequence[float | str] | None) -> list[float] | None:
    """The two lengths of a panel, m."""
    if panel is None:
        return None
    from sweep.config.units import quantity

    sides = [quantity(side, "m") if isinstance(side, str) else side for side in panel]
    if len(sides) == 2 and min(sides) > 0.0:
        return sides
    raise ExportError(f"panel {', '.join(map(str, panel))}; allowed: two lengths above zero")


def _source(source: Case | str | os.PathLike[str], case_id: str) -> Source:
    if not isinstance(source, str | os.PathLike):
        return Source(planned=source)
    summary = read_summary(source)
    if not case_id:
        ids = ", ".join(summary["case_id"].head(3))
        raise ExportError(
            f"{os.fspath(source)} has {len(summary)} cases; needed: case_id, of {ids} ..."
        )
    rows = summary[summary["case_id"] == case_id]
    if rows.empty:
        raise ExportError(f'{os.fspath(source)} holds no case "{case_id}"')
    return Source(source, rows.iloc[0].to_dict())


def _layout(source: Source, wish: Wish) -> Layout:
    """The layout: a specimen or a panel, of walls or of blocks."""
    design = source.design
    shape = block(source.case.lattice) if wish.kind == "settings" else outline(design.network)
    return panel(design, shape, wish.panel) if wish.panel else specimen(design, shape)


def _stl(path: Path, source: Source, wish: Wish) -> list[str]:
    body, notes = _body(source, wish)
    write_stl(path, body)
    return [*notes, SOLID]


def _three_mf(path: Path, source: Source, wish: Wish) -> list[str]:
    if wish.kind == "settings":
        return _filled_block(path, source, wish)
    body, notes = _body(source, wish)
    write_3mf(path, body, source.case.case_id, {})
    return [*notes, SOLID]


def _body(source: Source, wish: Wish) -> tuple[Body, list[str]]:
    """The walls, and a description in sentences."""
    if source.case.lattice.sheet:
        from sweep.export.sheet import sheet_panel

        return sheet_panel(source.case, wish.panel)
    layout = _layout(source, wish)
    body = solid(layout, TO_MM3 * layout.specimens * source.design.volume)
    return _as_printed(body, source), _description(layout, source, wish)


def _as_printed(body: Body, source: Source) -> Body:
    """The body with the axis of its layers upwards."""
    from sweep.config.kinds.sliced import Sliced

    lattice = source.case.lattice
    return body.stood_up if isinstance(lattice, Sliced) and lattice.lateral else body


def _filled_block(path: Path, source: Source, wish: Wish) -> list[str]:
    """A block, and the settings with which the slicer fills it."""
    from sweep.export.slicer import by_hand, prusa_reads, settings_of, slicer_files

    settings = settings_of(source.case.lattice)
    layout, notes = _block(source, wish)
    body = _as_printed(extruded(layout), source)
    write_3mf(path, body, layout.name, slicer_files(settings, layout.name, len(body.triangles)))
    prusa = "PrusaSlicer reads the settings of the object from the file. "
    prusa = prusa if prusa_reads(settings) else ""
    twice = ", and lays crossings twice, so that the block is heavier than the lattice"
    if settings.solid_layers:
        twice += "; it also lays perimeters in front and behind, which the drawing does not have"
    return [
        *notes,
        f"{prusa}OrcaSlicer and Bambu Studio may import only the geometry; if so, set by hand: "
        f"{by_hand(settings)}",
        "the slicer chooses where its lines begin, so that walls may be shifted"
        f"{'' if source.case.lattice.sheet else twice}",
    ]


def _block(source: Source, wish: Wish) -> tuple[Layout, list[str]]:
    """The block, and a description in sentences."""
    if source.case.lattice.sheet:
        from sweep.export.sheet import sheet_block

        return sheet_block(source.case, wish.panel)
    layout = _layout(source, wish)
    return layout, _description(layout, source, wish)


def _drawn(write: Callable[[Path, Layout], None]) -> Writer:
    """The writer of a format that shows the outline."""

    def writer(path: Path, source: Source, wish: Wish) -> list[str]:
        layout = _layout(source, wish)
        write(path, layout)
        return _description(layout, source, wish)

    return writer


def _csv(path: Path, source: Source, wish: Wish) -> list[str]:
    write_curves(path, source.history, source.row)
    return []


def _vtkhdf(path: Path, source: Source, wish: Wish) -> list[str]:
    write_shapes(path, source.frames)
    return []


def _gif(path: Path, source: Source, wish: Wish) -> list[str]:
    from sweep.report.figures.animation import write_gif

    write_gif(path, source.row, source.frames, source.history)
    return []


def _description(layout: Layout, source: Source, wish: Wish) -> list[str]:
    """A description of a layout in a sentence; for a panel, in two."""
    _, _, width, height = layout.shape.bounds
    size = f"{width:.4g} x {height:.4g} mm, {layout.depth:.4g} mm deep: {layout.grams:.4g} g"
    if extruded := source.design.extruded_grams:
        size += (
            f", and {layout.specimens * extruded:.4g} g as the slicer extrudes it and rank counts"
        )
    if wish.panel is None:
        return [size]
    lengths = " x ".join(f"{in_unit(side, 'mm'):g}" for side in wish.panel)
    nominal = TO_MM * filled_panel(source.design, wish.panel).width
    wider = f"; corners that stick out make them {width - nominal:.2g} mm wider"
    behind = "" if layout.behind == 1 else f"{layout.behind} specimens of "
    deep = f"each {behind}{text_in(source.case.footprint[1], 'mm')} deep"
    several = layout.specimens > 1
    these = f"these {layout.specimens} specimens, which are not joined, are"
    return [
        f"{layout.across} side by side, {deep}: {size}" if several else size,
        f"{these if several else 'this specimen is'} what rank counts for a panel of {lengths} mm"
        f"{wider if width - nominal > SHOWN else ''}",
    ]


Writer = Callable[[Path, Source, Wish], list[str]]
PRINTS: dict[str, Writer] = {
    ".stl": _stl,
    ".3mf": _three_mf,
    ".svg": _drawn(write_svg),
    ".dxf": _drawn(write_dxf),
}
WRITERS: dict[str, Writer] = {**PRINTS, ".csv": _csv, ".vtkhdf": _vtkhdf, ".gif": _gif}
PRINTED = ", ".join(PRINTS)
