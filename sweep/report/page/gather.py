"""Collects the data of a page: designs with the values that rank them, curves, shapes, failures,
origin.
"""

import json
from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import chain, islice
from pathlib import Path
from typing import Any

import numpy as np
from pandas import DataFrame, Series

from sweep.array_types import Floats
from sweep.columns import ABSORBED_AT, correction_column, end_columns, error_column
from sweep.design.panel import BESIDE
from sweep.design.slicer.patterns import is_sheet
from sweep.loading_modes import MODES, compared, mode_of
from sweep.numbers import FACTORS, counted, in_unit, short
from sweep.ranking.budget import ROUND_OFF
from sweep.ranking.curves import reached
from sweep.ranking.merit import (
    AT_ALLOWED,
    SEVEN_DIGITS,
    UNEQUAL,
    gap_behind,
    is_period,
    merits,
    through_solid,
    unequal_periods,
)
from sweep.ranking.narrow import narrow_patterns
from sweep.ranking.places import LARGE
from sweep.ranking.question import Question
from sweep.ranking.rank import answer, model_versions
from sweep.ranking.ranking import Ranking
from sweep.ranking.requirement_table import MEASURES
from sweep.ranking.requirements import limits, relative_energy, relative_errors
from sweep.ranking.scenes import by_scene, scene_labels
from sweep.ranking.unfinished import interrupted, loaded, stroke_left, unloaded
from sweep.report.figures.panel_piece import piece, places
from sweep.report.figures.storyboard import PARTS, last_loaded, path_of, stacked
from sweep.report.page.selection import (
    LIMITS,
    SCENES,
    Counted,
    front_of_others,
    group_others,
    on_fronts,
    select_designs,
    select_stopped,
)
from sweep.report.page.thinning import (
    force_stairs,
    numbers,
    thin_curves,
    thin_stairs,
)
from sweep.report.page.trails import UNIT, at_rest, drawing, moving_faces, moving_shape
from sweep.report.tables.design_text import design_labels, design_text
from sweep.report.tables.legend import (
    EQUAL,
    TIED,
    UNKNOWN,
    densification_notes,
    front,
    meanings,
    printed_note,
)
from sweep.report.tables.marks import mark_notes, marks
from sweep.report.tables.missing_notes import incomplete
from sweep.report.tables.requirement_notes import (
    COLUMN_NOTES,
    ONE_BY_ONE,
    STRUCK_PANEL,
    TOLERATED,
    WHOLE_PANEL,
)
from sweep.report.tables.sheets import crush_text, impact_text
from sweep.report.tables.size_notes import narrow_note, size_note
from sweep.result import Status
from sweep.simulation.filter_class import without_blows
from sweep.simulation.up_to_force import absorbed_until
from sweep.store.errors import StoreError
from sweep.store.read import StoredRun, read_attributes, read_runs

FilesOf = Callable[[Sequence[str]], Iterable[bytes | None]]
"""The files to print of cases with these ids; None for a case that cannot be printed."""
POINTS = 60  # most points of a curve
FORCES, SMALL = 60, 0.01  # forces at which the work of thin curves is checked; share of all work
FAILURES = 500
TOP, TOP_OF_A_BUDGET = 10, 3  # of the ranking that the page starts with
DRAWINGS, SHAPES = 500_000, 2_400_000  # characters; kagome, 100 mm wide, has 440,000
PRINTS, MOST_PRINTS = 300_000, 16  # characters of files to print; of 2 to 20 kB each
OF_THE_RUN = {
    "created": "last run",
    "git_revision": "revision of the source",
    "compiler": "compiler of the kernels",
    "platform": "machine",
}


def first_ranking(summary: DataFrame, question: Question) -> Ranking:
    """The ranking that a page starts with: crushes count until densification."""
    top = TOP_OF_A_BUDGET if len(question.budgets) > 1 else TOP
    return answer(summary, question._replace(by=None, top=top, allowed_force=None))


def page_data(
    file: str,
    summary: DataFrame,
    question: Question,
    ranking: Ranking | None = None,
    files_of: FilesOf | None = None,
) -> dict[str, Any]:
    """All data of a page, for JSON; numbers that rank designs keep all their digits.

    question: the question with which the page starts; budget (kg) and panel (m) are lists or None.
    ranking: its `first_ranking`, if it exists already. files_of: the page holds the files to
    print of the first designs.
    """
    heads = list(design_text(loaded(summary), summary))
    by_force = _counted(summary)
    whole = by_force[0].rows
    finished = loaded(whole)
    labels = scene_labels(whole)
    by_label = dict(islice(by_scene(finished, labels).items(), SCENES if len(finished) else 0))
    scenes = [*by_label.values()]
    first = _first_ids(ranking or first_ranking(summary, question))
    ids = select_designs(first, by_force, scenes)
    kept = [rows[rows["case_id"].isin(ids)] for rows in scenes]
    cases = _cases(by_force, kept, summary)
    stopped_by_label = by_scene(whole[interrupted(whole)], labels)
    stopped = [stopped_by_label.get(label, whole[:0]) for label in by_label]
    shown = [select_stopped(rows, by_force[0].names, len(scenes)) for rows in stopped]
    unfinished = _cases(by_force, shown, summary)
    about = read_attributes(file)
    forces = [each.force for each in by_force if each.force is not None]
    leading = filter(cases.__contains__, dict.fromkeys([*first, *on_fronts(by_force, scenes)]))
    rows_by_id = {row["case_id"]: row for part in (*kept, *shown) for _, row in part.iterrows()}
    stored = _Stored()
    for run in read_runs(file, [*filter(cases.__contains__, ids), *unfinished]):
        row = rows_by_id[run.case_id]
        case = _as_measured(run, row)
        design = cases.get(case.case_id) or unfinished[case.case_id]
        if case.case_id in cases:
            design |= stored.take(case, row)
        if len(case.history) and MODES[row["loading_mode"]].driven:
            if len(case.history) > 1:
                design["stairs"] = stored.stairs(case.history, row)
            most = row["stroke_m"]  # curves have single precision
            ends = (min(reached(case.history, force)[1], most) for force in forces)
            design["strokes"] += _exact(ends)
    return {
        "file": Path(file).name if Path(file).is_absolute() else Path(file).as_posix(),
        "name": _config(about).get("name") or Path(file).stem,
        "scenes": [
            _scene(label, rows, on_page)
            | {"designs": len(rows), "stopped": len(all_stopped) - len(stopped_on_page)}
            | {"others": group_others(by_force, rows, ids, len(scenes))}
            | {"front_of_others": front_of_others(by_force, rows, ids)}
            for (label, rows), on_page, all_stopped, stopped_on_page in zip(
                by_label.items(), kept, stopped, shown, strict=True
            )
        ],
        "energies": [_energy(each) for each in by_force],
        "heads": heads,
        "question": {
            "budgets_g": [in_unit(float(mass), "g") for mass in question.budgets],
            "panel": list(question.panel or ()) or None,
            "require": limits(question.require),
            "per": question.per,
        },
        "measures": _requirements(),
        "round_off": ROUND_OFF,
        "large_error": LARGE,
        "round_off_of_curves": SEVEN_DIGITS,
        "beside": BESIDE,
        "factors": FACTORS,
        "column_notes": COLUMN_NOTES,
        "struck_panel": STRUCK_PANEL,
        "one_by_one": ONE_BY_ONE,
        "tolerated": TOLERATED,
        "unequal": UNEQUAL,
        "unknown_error": UNKNOWN,
        "largest": _largest(whole),
        "whole_panel": WHOLE_PANEL,
        "ties": {"errors": TIED, "values": EQUAL},
        "cases": list(cases.values()),
        "unfinished": list(unfinished.values()),
        "printed": printed_note(summary) if by_force[0].names.mass != "mass_g" else "",
        "total": len(summary),
        "designs": len(finished),
        "failed": len(summary) - len(loaded(summary)),
        "unloaded": int(unloaded(summary).sum()),
        "failures": list(_failures(summary, labels)),
        "missing": list(incomplete(len(summary), about)),
        "drawings": stored.drawings,
        "shapes": stored.shapes,
        "prints": _prints([*islice(leading, MOST_PRINTS)], files_of) if files_of else {},
        "points": POINTS,
        "doubt": stored.doubt,
        "about": _about(about, summary),
        "config": _config(about),
    }


def _prints(ids: Sequence[str], files_of: FilesOf) -> dict[str, str]:
    """Files to print of cases by their ids, as base64, as long as there is room."""
    prints, room = {}, PRINTS
    with suppress(StoreError):  # a case that cannot be read: the command says why
        for case_id, content in zip(ids, files_of(ids), strict=True):
            text = b64encode(content or b"").decode()
            if 0 < len(text) <= room:
                prints[case_id] = text
                room -= len(text)
    return prints


def _largest(rows: DataFrame) -> list[dict[str, Any]]:
    """The greatest width and depth (m) of specimens with each gap, stopped cases included: a panel
    that is too small for one of them is refused.
    """
    sides = rows[["outer_width_m", "depth_m"]].groupby(gap_behind(rows)).max().dropna()
    return [{"outer": list(row), "gap": gap} for gap, *row in sides.itertuples(name=None)]


def _requirements() -> dict[str, dict[str, Any]]:
    """The possible requirements, with their units and words."""
    return {
        name: {**measure._asdict(), "limit": measure.limit, "far": measure.far}
        for name, measure in MEASURES.items()
    }


def _counted(summary: DataFrame) -> list[Counted]:
    """Energies known for all cases: until densification, and up to the forces of the columns."""
    texts = [match[1] for name in summary if (match := ABSORBED_AT.fullmatch(str(name)))]
    forces = [None, *sorted(map(float, texts))]
    return [Counted(f, *merits(summary, Question(allowed_force=f))) for f in forces]


def _cases(
    by_force: Sequence[Counted], scenes: Sequence[DataFrame], summary: DataFrame
) -> dict[str, dict[str, Any]]:
    """The ranking data of every case of these scenes, and its row of the table, by its id."""
    cases, ends = {}, end_columns(by_force[0].names.energy)
    for number, part in enumerate(scenes):
        if part.empty:
            continue
        least = compared(part)
        energies = [_with_bars(each.rows.loc[part.index], each.names.energy) for each in by_force]
        columns = {
            "id": part["case_id"],
            "scene": [number] * len(part),
            "label": design_labels(part, summary),
            "text": list(zip(*design_text(part, summary).values(), strict=True))
            or [()] * len(part),
            "more": list(zip(*_measures(part).values(), strict=True)) or [()] * len(part),
            "mass": _exact(part[by_force[0].names.mass]),
            "net": _exact(part["mass_g"]),
            "printed": _exact(part["printed_mass_g"]),
            "outer": list(zip(_exact(part["outer_width_m"]), _exact(part["depth_m"]), strict=True)),
            "gap": _exact(gap_behind(part)),
            "energies": list(zip(*energies, strict=True)),
            "ends": list(zip(*(_exact(part[name]) for name in ends), strict=True)),
            "least": _with_bars(part, least) if least else [None] * len(part),
            **{name: _exact(part[column]) for name, column in LIMITS.items()},
            "within": _exact(part["absorbed_energy_within_model_J"]),
            "height": _exact(part["height_m"]),
            "strokes": [[stroke] for stroke in _exact(part["counted_stroke_m"])],
            "solid": through_solid(part).tolist(),
            "crossed": part["crossed"].tolist(),
            "coarse": part["coarse"].tolist(),
            "errors": list(zip(*_errors(part, by_force), strict=True)),
            "marks": marks(part.assign(beyond_model=False)),
            "undrawn": part["does_not_print"],
            "open": part["ends_early"].tolist(),
            "struck": _exact(relative_energy(part)),
            "unresolved": (part["status"] == Status.UNRESOLVED).tolist(),
            "unloaded": unloaded(part).tolist(),
            "rest": _exact(stroke_left(part)),
            "message": part["message"],
            "slicer": part["slicer_settings"],
            "print": _print_options(part),
        }
        for values in zip(*columns.values(), strict=True):
            case = dict(zip(columns, values, strict=True))
            cases[case["id"]] = case
    return cases


def _errors(part: DataFrame, by_force: Sequence[Counted]) -> Iterator[list[dict[str, float]]]:
    """The known relative errors of the values for the requirements, row by row: for each energy,
    and at the end for those up to other forces, which have no error bars.
    """
    for each in by_force:
        yield _known(relative_errors(each.rows.loc[part.index], each.names))
    unbarred = part.drop(columns=error_column("passed_on_N"), errors="ignore")
    names = by_force[0].names._replace(energy=AT_ALLOWED)
    yield _known(relative_errors(unbarred.assign(**{AT_ALLOWED: np.nan}), names))


def _known(errors: Mapping[str, Series]) -> list[dict[str, float]]:
    """The errors of each row that are not zero, by the name of their requirement."""
    rows = zip(*(_exact(values) for values in errors.values()), strict=True)
    return [{name: v for name, v in zip(errors, row, strict=True) if v} for row in rows]


def _exact(values: Iterable[float]) -> list[float | None]:
    """Numbers with all their digits; None in place of NaN."""
    return [float(value) if np.isfinite(value) else None for value in values]


def _with_bars(rows: DataFrame, name: str) -> list[tuple[float | None, ...]]:
    """Value, error and correction of a column, row by row; None if unknown."""
    columns = [rows.get(column) for column in (name, error_column(name), correction_column(name))]
    unknown = [None] * len(rows)
    return list(zip(*(unknown if c is None else _exact(c) for c in columns), strict=True))


def _print_options(rows: DataFrame) -> list[str | None]:
    """The option with which `crumple export` writes each design as .3mf; None where it refuses."""
    sheet, period = rows["lattice_kind"].map(is_sheet), is_period(rows)
    options = np.where(sheet, np.where(period, "--panel", "--kind settings"), "")
    return [
        None if mode == "custom" or sides == "endless" or (tied and not sheet) else str(option)
        for mode, sides, tied, sheet, option in zip(
            rows["loading_mode"], rows["sides"], period, sheet, options, strict=True
        )
    ]


def _measures(rows: DataFrame) -> dict[str, Series]:
    """Columns of text that do not depend on the question."""
    mode = mode_of(rows)
    if mode.struck:
        struck = impact_text(rows)
        del struck["force N"]
        return struck
    return crush_text(rows) if mode.driven else {}


def _scene(label: str, rows: DataFrame, kept: DataFrame) -> dict[str, Any]:
    """The data of a scene; kept: the rows of the designs on the page."""
    mode, least = mode_of(rows), compared(rows)
    return {
        "label": label,
        "requires": mode.requires,
        **{trait: getattr(mode, trait) for trait in ("driven", "struck", "dead")},
        "axes": [axis.label for axis in mode.curve],
        "shown": mode.least and mode.least._asdict(),
        "least": least,
        "front": front(mode),
        "bar": least is not None and error_column(least) in rows,
        "heads": list(_measures(kept)),
        "meanings": [*meanings(rows, mode), *densification_notes(kept)],
        "marks": _mark_notes(kept),
        "sizes": list(size_note(kept)),
        "narrow": list(narrow_note(narrow_patterns(rows))),
        "unequal": unequal_periods(rows),
    }


def _mark_notes(rows: DataFrame) -> list[str]:
    """The meanings of all marks that these rows may have, whether a question puts them beyond the
    model or not.
    """
    both = (mark_notes(rows.assign(beyond_model=beyond)) for beyond in (True, False))
    return [*dict.fromkeys(chain(*both))]


def _energy(one: Counted) -> dict[str, Any]:
    bar = error_column(one.names.energy) in one.rows
    return {"force": one.force, "until": one.names.until, "bar": bar}


def _first_ids(ranking: Ranking) -> list[str]:
    """Ids of the winners of the first ranking of the page, and of the nearest designs."""
    groups = ranking.table.groupby(["scene", "budget_g"], dropna=False, sort=False)
    winners = groups.head(TOP_OF_A_BUDGET).sort_values("place", kind="stable")["case_id"]
    nearest = [
        k for scene in ranking.outcomes.values() for o in scene for k in o.nearest["case_id"]
    ]
    return [*winners, *nearest]


class _Stored:
    """Makes curves and shapes small; shapes only as long as there is room for them."""

    def __init__(self) -> None:
        self.drawings: list[dict[str, Any]] = []
        self.shapes: dict[str, dict[str, Any]] = {}
        self.doubt = 0.0
        self._known: dict[bytes, int] = {}
        self._room = {"drawings": DRAWINGS, "shapes": SHAPES}

    def take(self, case: StoredRun, row: Series) -> dict[str, Any]:
        """The curves and shapes of a case on the page; `row`: of the summary."""
        history, frames = case.history, case.frames
        more: dict[str, Any] = {}
        if len(history) > 1:
            more |= {"curve": _thin(curve_of(history, row), POINTS), "book": _book(history, row)}
            more |= _base(history, row)
        if frames:
            more["drawing"] = self._drawing(frames)
            self._move(case, row)
        return more

    def stairs(self, history: DataFrame, row: Series) -> list[list[float | int | None]]:
        """Force (N), work (J) and travel (m) of `force_stairs` while the platen comes down."""
        loading = history.iloc[: last_loaded(history, row) + 1]
        force = np.fmax(loading["reaction_top_N"], loading["reaction_bottom_N"]).to_numpy()
        work = loading["work_in_J"].to_numpy()
        travel = np.minimum(loading["top_displacement_m"].to_numpy(float), row["stroke_m"])
        highest, done, way = force_stairs(force, work, travel)
        kept = thin_stairs(highest, done, POINTS)
        self.doubt = max(self.doubt, _work_error((highest, done), (highest[kept], done[kept])))
        return [numbers(column[kept], 9) for column in (highest, done, way)]

    def _drawing(self, frames: Mapping[str, Any]) -> int | None:
        """Number of the drawing of a shape at rest, which an earlier case may share."""
        position, edges, thickness = at_rest(frames)
        key = b"".join(a.tobytes() for a in (np.rint(position / UNIT), edges, thickness))
        if key not in self._known and self._room["drawings"] > 0:
            drawn = drawing(position, edges, thickness)
            if self._fits("drawings", len(json.dumps(drawn))):
                self._known[key] = len(self.drawings)
                self.drawings.append(drawn)
        return self._known.get(key)

    def _move(self, case: StoredRun, row: Series) -> None:
        """Keep the moving shape of a case if there is room."""
        if self._room["shapes"] <= 0:
            return
        forces = _forces(case.frames, case.history, row)
        if "quads" in case.frames:
            moving = moving_faces(piece(case.frames, row, 1), forces, places(row))
        else:
            moving = moving_shape(case.frames, forces)
        if self._fits("shapes", len(json.dumps(moving))):
            self.shapes[case.case_id] = moving

    def _fits(self, what: str, length: int) -> bool:
        """True if there is still room; after one that does not fit, no shorter one is taken
        either.
        """
        self._room[what] -= length
        return self._room[what] >= 0


def _thin(columns: Iterable[Any], most: int) -> list[list[float | int | None]]:
    """Columns at the same rows, of which there are at most so many."""
    return [numbers(column) for column in thin_curves(columns, most)]


def _book(history: DataFrame, row: Series) -> dict[str, Any]:
    """Work done and its parts (J) over the path: `stacked`."""
    (total, words, parts), (place, label) = stacked(history, row), path_of(history, row)
    values = _thin([place, total, *(parts[name] for name in parts)], POINTS * 2 // 3)
    names = [PARTS[name] for name in parts]
    return {"label": label, "total": words, "parts": names, "values": values}


def _base(history: DataFrame, row: Series) -> dict[str, Any]:
    """Greatest pressure (kPa) on a patch of the base over the path, if there is one."""
    pressure = in_unit(history["base_pressure_Pa"], "kPa")
    if not pressure.max() > 0.0:
        return {}
    place, label = path_of(history, row)
    return {"base": {"label": label, "values": _thin([place, pressure], POINTS // 3)}}


def _work_error(full: tuple[Floats, Floats], thin: tuple[Floats, Floats]) -> float:
    """Greatest relative error of the work up to a force, where it is no small part of all work."""
    works = [
        (absorbed_until(limit, *full), absorbed_until(limit, *thin))
        for limit in np.linspace(full[0][0], full[0][-1], FORCES)
    ]
    large = [(true, value) for true, value in works if true > SMALL * full[1][-1]]
    return max((abs(value / true - 1.0) for true, value in large), default=0.0)


def _as_measured(run: StoredRun, row: Series) -> StoredRun:
    """A stored run; of a crush with a speed with the forces behind the filter, as it is ranked."""
    history = run.history
    if not (MODES[row["loading_mode"]].driven and len(history) and history["kinetic_J"].any()):
        return run
    return run._replace(history=history.assign(**without_blows(history)))


def curve_of(history: DataFrame, row: Mapping[str, Any]) -> tuple[Any, Any]:
    """Force (N) over strain (%); strain over time (ms) under a dead load, whose force is
    constant.
    """
    x, y = (in_unit(history[axis.column], axis.unit) for axis in MODES[row["loading_mode"]].curve)
    return x, y


def _forces(
    frames: Mapping[str, Any], history: DataFrame, row: Mapping[str, Any]
) -> list[float | int | None]:
    """Ordinate of `curve_of` at every frame."""
    if not len(history):
        return [None] * len(frames["strain"])
    return numbers(np.interp(frames["time_s"], history["time_s"], curve_of(history, row)[1]))


def _failures(summary: DataFrame, labels: Series) -> Iterator[dict[str, str]]:
    """The first cases that did not converge: design, scene, status and message."""
    failed = summary[summary["status"] != Status.CONVERGED][:FAILURES]
    for label, rows in by_scene(failed, labels).items():
        for (_, row), design in zip(rows.iterrows(), design_labels(rows, summary), strict=True):
            where = {"case": str(row["case_id"]), "design": design, "scene": label}
            yield where | {"status": str(row["status"]), "why": str(row["message"])}


def _config(about: Mapping[str, Any]) -> dict[str, Any]:
    """The config stored in a file; empty if there is none."""
    config = json.loads(about.get("config") or "{}")
    return config if isinstance(config, dict) else {}


def _about(about: Mapping[str, Any], summary: DataFrame) -> list[tuple[str, str]]:
    """Origin of the numbers, as pairs of words."""
    versions = model_versions(summary)
    packages = {name.removeprefix("version_"): v for name, v in about.items() if "version_" in name}
    model = ", ".join(f"{version} ({counted(n, 'case')})" for version, n in versions.items())
    pairs = [(words, str(about[name])) for name, words in OF_THE_RUN.items() if name in about]
    pairs += [("version of the model", model)]
    pairs += [(name, short(version)) for name, version in packages.items()]
    return pairs
