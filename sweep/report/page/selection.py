"""Selects the designs that a page of many holds, and bounds the values of the others.

A page of up to `MOST` designs holds all. Of more, it holds those that have one of the first places
within some budget, per gram or per area of a panel, until densification or up to a force of the
columns; the best below some limit of a requirement; and a sample of the others.

The remaining designs are represented by groups. A group is a design that no page shows: the least
mass of its members, their greatest energies, their least force and so on. No member can have a
better value than the group for any question, nor miss a requirement that the group meets. So the
page knows which places are certain (`certainty` in rank.js). The members are grouped twice, once by
mass alone and once by all limited values, and the lower of both bounds counts; within a budget,
also the bound from the front of the designs that are left out.
"""

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, islice, zip_longest
from typing import Any, NamedTuple

import numpy as np
from pandas import DataFrame, Index

from sweep.array_types import Floats, Ints
from sweep.loading_modes import compared
from sweep.ranking.merit import Compared, doubtful, gap_behind, through_solid

MOST = 300  # designs
SAMPLE = 50  # number of these that are sampled from all the others
SCENES = 40
PLACES = 15  # within a budget
LIMITED = 8  # number of designs that are the best below some limit of a requirement
STOPPED, LEAST_STOPPED = 60, 10  # unfinished cases in all scenes; of each at least
GROUPS = 256  # in all scenes
LIMITS = {
    "passed": "passed_on_N",
    "peak": "peak_force_N",
    "deceleration": "peak_deceleration_filtered_m_per_s2",
    "pressure": "peak_base_pressure_Pa",
    "accelerated": "peak_target_acceleration_m_per_s2",
}
"""Columns that requirements limit from above, by their names in the page."""


class Counted(NamedTuple):
    """Energy up to an allowed force (N; None: until densification), and the rows with the compared
    columns.
    """

    force: float | None
    rows: DataFrame
    names: Compared


def select_designs(
    first: Iterable[str], counted: Sequence[Counted], scenes: Sequence[DataFrame]
) -> list[str]:
    """Ids of the designs that a page holds, the most important first.

    first: the ids that come first. scenes: the rows of each, with the columns of `counted[0]`.
    """
    every = [case_id for rows in scenes for case_id in rows["case_id"]]
    if len(every) <= MOST:
        return list(dict.fromkeys([*first, *every]))
    depths = zip_longest(*(layer for rows in scenes for layer in _layered(counted, rows)))
    limited = (layer for rows in scenes for layer in _limited(counted[0], rows))
    rounds = chain(islice(depths, 1), [limited], depths)
    leading = chain.from_iterable(filter(None, chain.from_iterable(rounds)))
    ids = dict.fromkeys(islice(dict.fromkeys(chain(first, leading)), MOST - SAMPLE))
    others = [case_id for case_id in every if case_id not in ids]
    sample = np.linspace(0, len(others) - 1, min(MOST - len(ids), len(others))).round().astype(int)
    return [*ids, *(others[k] for k in sample)]


def on_fronts(counted: Sequence[Counted], scenes: Sequence[DataFrame]) -> list[str]:
    """Ids of the trusted designs that are first within some budget, by energy until densification,
    then up to the forces of the columns, of the scenes in turn.
    """
    fronts = []
    for each in counted:
        for rows in scenes:
            part = _sound(each, rows.index)
            merit = _merits(part, each.names)[0]
            fronts += [*_ids(part, part[each.names.mass].to_numpy(float), merit, 1)]
    return [k for depth in zip_longest(*fronts) for k in depth if k is not None]


def select_stopped(rows: DataFrame, names: Compared, scenes: int) -> DataFrame:
    """The rows of stopped cases in one of the scenes that reached the most, for some budget."""
    most = max(STOPPED // scenes, LEAST_STOPPED)
    if len(rows) <= most:
        return rows
    mass, energy = (rows[name].to_numpy(float) for name in (names.mass, names.energy))
    merits = layers(mass, energy, PLACES), layers(np.zeros_like(mass), energy / mass, PLACES)
    leading = chain.from_iterable(
        part for depth in zip_longest(*merits) for part in depth if part is not None
    )
    chosen = list(islice(dict.fromkeys(chain(leading, range(len(rows)))), most))
    return rows.iloc[np.sort(chosen)]


def layers(limited: Floats, merit: Floats, most: int) -> Iterator[Ints]:
    """Row numbers of the best designs below any limit, then of the next best, ``most`` times.

    A design among the best ``most`` below some limit is in one of these layers.
    """
    order = np.lexsort((-merit, limited))
    order = order[np.isfinite(merit[order]) & np.isfinite(limited[order])]
    for _ in range(most):
        if not len(order):
            return
        values = merit[order]
        is_best = values > np.append(-np.inf, np.maximum.accumulate(values)[:-1])
        yield order[is_best]
        order = order[~is_best]


def _layered(counted: Sequence[Counted], rows: DataFrame) -> Iterator[Iterator[list[str]]]:
    """Ids of the best designs of a scene by each of its merits in turn, in layers."""
    for name in (counted[0].names.mass, "peak_force_N"):  # ends of the sliders
        values = rows[name].to_numpy(float)
        for ends in (values, -values):
            yield _ids(rows, np.zeros(len(rows)), ends, 1)
    for each in counted:
        part = _sound(each, rows.index)
        mass, same = part[each.names.mass].to_numpy(float), np.zeros(len(part))
        merit, *per_gram = _merits(part, each.names)
        area = (part["outer_width_m"] * part["depth_m"]).to_numpy(float)
        yield _ids(part, mass, merit, PLACES)
        yield _ids(part, same, per_gram[0] if per_gram else merit, PLACES)
        yield _ids(part, mass / area, merit / area if per_gram else merit, PLACES)
        yield _ids(part, same, merit / area, PLACES)


def _limited(until_packed: Counted, rows: DataFrame) -> Iterator[list[str]]:
    """Ids of some of the best designs of a scene below the limits of one requirement."""
    part = rows[~doubtful(rows)]
    for column in (*LIMITS.values(), "counted_stroke_m"):
        for merit in _merits(part, until_packed.names):
            for ids in _ids(part, part[column].to_numpy(float), merit, 1):
                yield ids[:: -(-len(ids) // LIMITED)]


def _sound(each: Counted, index: Index) -> DataFrame:
    """The trusted ones of some rows, with their values up to a force."""
    return each.rows[each.rows.index.isin(index) & ~doubtful(each.rows)]


def _ids(part: DataFrame, limited: Floats, merit: Floats, most: int) -> Iterator[list[str]]:
    names = part["case_id"].to_numpy()
    return (list(names[layer]) for layer in layers(limited, merit, most))


def _merits(part: DataFrame, names: Compared) -> list[Floats]:
    """The values to be maximised: energy, and energy per gram; or the negative of the column
    compared instead.
    """
    least = compared(part)
    columns = [names.energy, names.per_gram] if least is None else [least]
    sign = 1.0 if least is None else -1.0
    return [sign * part[name].to_numpy(float) for name in columns]


def group_others(
    counted: Sequence[Counted], rows: DataFrame, ids: Iterable[str], scenes: int
) -> list[list[dict[str, Any]]]:
    """The groups of the designs of a scene that are not on the page, by both groupings; none if all
    are.

    ids: of the designs on the page. scenes: number of scenes.
    """
    rows = rows[~rows["case_id"].isin([*ids]) & rows[counted[0].names.mass].notna()]
    if rows.empty:
        return []
    columns = [counted[0].names.mass, counted[0].names.energy, "passed_on_N", "counted_stroke_m"]
    axes, gap = rows[columns].to_numpy(float), gap_behind(rows).fillna(-1.0).to_numpy(float)
    values, forces = _values(counted, rows), [each.force for each in counted if each.force]
    count = max(GROUPS // scenes, 1)
    return [
        [
            _corner({name: column[group] for name, column in values.items()}, forces)
            for one in np.unique(gap)
            for group in _split(np.flatnonzero(gap == one), axes[:, :used], count)
        ]
        for used in (1, len(columns))
    ]


def front_of_others(
    counted: Sequence[Counted], rows: DataFrame, ids: Iterable[str]
) -> list[list[list[float]]]:
    """The best trusted designs within every budget that are not on the page: their masses and
    energies, for each kind of energy; if something else is compared, the negative of it.
    """
    left = rows.index[~rows["case_id"].isin([*ids])]
    fronts = []
    for each in counted if len(left) else ():
        part = _sound(each, left)
        mass, merit = part[each.names.mass].to_numpy(float), _merits(part, each.names)[0]
        best = next(layers(mass, merit, 1), np.zeros(0, int))
        fronts.append([mass[best].tolist(), merit[best].tolist()])
    return fronts


def _split(rows: Ints, axes: Floats, count: int, turn: int = 0) -> list[Ints]:
    """Rows in about ``count`` groups of similar ones: halved at the medians of the axes in turn."""
    if count < 2 or len(rows) < 2:
        return [rows]
    order = rows[np.argsort(axes[rows, turn % axes.shape[1]], kind="stable")]
    half = len(order) // 2
    parts = order[:half], order[half:]
    return [group for part in parts for group in _split(part, axes, count // 2, turn + 1)]


def _values(counted: Sequence[Counted], rows: DataFrame) -> dict[str, Floats]:
    """The values that bound the designs, row by row.

    "any" covers all designs, "sound" only the trusted ones: where the energy is "counted" up to a
    force of the columns, and "below" it.
    """
    names, least = counted[0].names, compared(rows)
    columns = LIMITS | {"mass": names.mass, "stroke": "counted_stroke_m", "depth": "depth_m"}
    columns |= {"width": "outer_width_m"}
    values = {name: rows[column].to_numpy(float) for name, column in columns.items()}
    values["gap"] = gap_behind(rows).to_numpy(float)
    never = (through_solid(rows) | rows["crossed"]).to_numpy(bool)
    last = len(counted)
    below = values[f"any below {last}"] = rows["absorbed_energy_J"].to_numpy(float)
    values[f"sound below {last}"] = np.where(never, np.nan, below)
    for k in reversed(range(last)):
        every = counted[k].rows
        energy = every.loc[rows.index, counted[k].names.energy].to_numpy(float)
        values[f"any counted {k}"] = energy
        below = values[f"any below {k}"] = np.where(np.isfinite(energy), energy, below)
        values[f"sound counted {k}"] = np.where(doubtful(every)[rows.index], np.nan, energy)
        values[f"sound below {k}"] = np.where(never, np.nan, below)
    if least is not None:
        values["any least"] = rows[least].to_numpy(float)
        values["sound least"] = np.where(doubtful(rows), np.nan, values["any least"])
    return values


def _corner(of: dict[str, Floats], forces: Sequence[float]) -> dict[str, Any]:
    """The group of these members as a design of the page, at least as good as each of them."""
    numbers = range(len(forces) + 1)

    def best(which: str) -> dict[str, Any]:
        energies = [of[f"{which} counted {k}"] for k in numbers]
        below = [_greatest(of[f"{which} below {k}"]) for k in (*numbers[1:], len(numbers))]
        return {
            "energies": [[_greatest(energy), None, None] for energy in energies],
            "perGram": [_greatest(energy / of["mass"]) for energy in energies],
            "stairs": _stairs(forces, below),
            "least": [_least(of[f"{which} least"]) if f"{which} least" in of else None, None, None],
        }

    return {
        **{name: _least(of[name]) for name in (*LIMITS, "mass", "gap")},
        "outer": [_greatest(of["width"]), _greatest(of["depth"])],
        "smallest": [_least(of["width"]), _least(of["depth"])],
        "sound": best("sound"),
        "any": best("any"),
        "ends": [None, None],
        "within": None,
        "strokes": [_least(of["stroke"]), *(0 for _ in forces)],
        "height": 0,
    }


def _greatest(values: Floats) -> float | None:
    finite = values[np.isfinite(values)]
    return float(finite.max()) if len(finite) else None


def _least(values: Floats) -> float | None:
    finite = values[np.isfinite(values)]
    return float(finite.min()) if len(finite) else None


def _stairs(forces: Sequence[float], most: Sequence[float | None]) -> list[list[float]] | None:
    """Force (N) and work (J) as steps: up to each of the forces the work is at most the work done
    when it is exceeded; beyond the last one, the work of the whole crush.
    """
    if None in most:
        return None
    works = np.maximum.accumulate(np.array(most, float))
    steps = np.repeat(works, 2)[1:-1] if len(forces) else works
    no_stroke = [0.0] * len(steps)  # a member has it from its stairs
    return [np.repeat(forces, 2).tolist() or [0.0], steps.tolist(), no_stroke]
