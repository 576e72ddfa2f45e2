"""Refuses requirements that cannot apply to the cases of a sweep, before a case runs."""

from collections.abc import Callable, Mapping, Sequence

from sweep.config.case import Case
from sweep.config.kinds.striker import WithStriker
from sweep.ranking.question import Quantity
from sweep.ranking.requirements import check_modes, limits, unknown_of


def check_required(require: Mapping[str, Quantity | None] | None, cases: Sequence[Case]) -> None:
    """Refuse a requirement for which none of these cases has a value."""
    required = limits(require)
    check_modes(required, {case.loading.mode for case in cases})
    for name, (needed, has) in MEASURED.items():
        if name in required and cases and not any(map(has, cases)):
            raise unknown_of(name, required[name], "these cases", needed)


def _has_patch(case: Case) -> bool:
    """Whether the pressure on a patch of the base is measured."""
    loading, lattice = case.loading, case.lattice
    flat = isinstance(loading, WithStriker) and loading.base == "flat"
    return flat and not (case.along or lattice.endless or lattice.tied_sides)


MEASURED: dict[str, tuple[str, Callable[[Case], bool]]] = {
    "max_base_pressure": ("a flat base below walls across it, whose sides are free", _has_patch),
    "max_target_acceleration": ("loading.target_mass", lambda case: case.loading.base_moves),
}
"""Requirements for which some cases have no value: the condition in words, and whether a case meets
it.
"""
