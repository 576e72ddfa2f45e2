"""Runs a config from Python and returns its results."""

import os
from collections.abc import Callable
from pathlib import Path

from sweep.config.case import Case
from sweep.config.grid import Config
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.striker import Struck
from sweep.config.load import load_config
from sweep.ranking.merit import check_panel
from sweep.ranking.question import RankError
from sweep.ranking.requirements import check_modes
from sweep.report.results import Results
from sweep.running.sweep import run_sweep
from sweep.store.read import ONLY_MISSING, Rerun


def run(
    config: Config | str | os.PathLike[str],
    out: str | os.PathLike[str] | None = None,
    workers: int = 2,
    rerun: Rerun = ONLY_MISSING,
) -> Results:
    """Run the cases of a config that its results file does not hold; return the results of all.

    config : from `load_config`, or the path of a TOML file, or the name of an example. out : the
    results file, by default results/NAME.h5. Progress is shown, in a notebook as one line.
    """
    config = config if isinstance(config, Config) else load_config(config)
    check_question(config)
    path = Path(out or f"results/{config.name}.h5")
    run_sweep(config, path, workers, rerun=rerun)
    ids = [case.case_id for case in config.cases]
    question = {
        "budget": list(config.rank.budgets) or None,
        "panel": config.rank.panel,
        "require": config.require.model_dump(),
        "per": config.rank.per,
    }
    return Results(path, ids, question)


def check_question(config: Config) -> None:
    """Refuse what no case of a config can be asked for, before cases run: a requirement, or a panel
    that is smaller than half a specimen.
    """
    if config.rank.panel:
        check_panel(config.rank.panel, config.cases)
    if required := [name for name, limit in config.require if limit is not None]:
        check_modes(required, {case.loading.mode for case in config.cases})
        for name, (needed, has) in MEASURED.items():
            if name in required and not any(map(has, config.cases)):
                raise RankError(f"{name} needs {needed}, and there is none")


def _has_patch(case: Case) -> bool:
    """Whether the pressure on a patch of the base is measured."""
    loading, lattice = case.loading, case.lattice
    flat = isinstance(loading, Struck) and loading.base == "flat"
    return flat and not (case.along or lattice.endless or lattice.tied)


def _has_target(case: Case) -> bool:
    return isinstance(case.loading, Impact) and case.loading.target_mass is not None


MEASURED: dict[str, tuple[str, Callable[[Case], bool]]] = {
    "max_base_pressure": ("a flat base below walls across it, whose sides are free", _has_patch),
    "max_target_acceleration": ("loading.target_mass", _has_target),
}
"""Requirements of which some cases have no value: what they need, and whether a case has it."""
