"""The question of a ranking, from the options of a command, else from the config of the results."""

import json
from argparse import Namespace
from collections.abc import Iterable
from typing import Any

from sweep.cli.refusals import ArgumentError
from sweep.ranking.question import Question, in_si

TOP, TOP_OF_A_BUDGET = 10, 3


def full_question(arguments: Namespace) -> Question:
    """The question of the options, completed from the config.

    The budgets of the config are used unless --budget or --by is given; its panel is used unless
    --panel is given, or --by without --budget if no requirement applies to a panel.
    """
    stored = stored_table(arguments.file, "rank")
    budgets, panel = stored.get("budgets"), stored.get("panel")
    per = arguments.per or stored.get("per") or "specimen"
    if arguments.by and not arguments.budget:
        budgets, panel = None, panel if per == "panel" else None
    question = question_of(arguments.budget or budgets, arguments.panel or panel)
    return question._replace(
        by=arguments.by,
        top=arguments.top or question.top,
        allowed_force=arguments.allowed_force,
        require=_required(arguments),
        per=per,
    )


def drop_heights(arguments: Namespace) -> list[float]:
    """The heights (m) that --drop-height gives."""
    if arguments.drop_height and not arguments.out:
        raise ArgumentError("--drop-height draws cushion curves into a folder: it needs --out DIR")
    return [*dict.fromkeys(in_si(text, "m") for text in arguments.drop_height or ())]


def stored_heights(file: str) -> list[float]:
    """The heights (m) of cushion curves in the config of a results file."""
    return [*dict.fromkeys(stored_table(file, "rank").get("drop_heights") or ())]


def question_of(budgets: Iterable[Any] | None, panel: Iterable[Any] | None) -> Question:
    """A question with these budgets and this panel; several budgets show fewer places each."""
    masses, sides = list(budgets or ()), list(panel or ())
    top = TOP_OF_A_BUDGET if len(masses) > 1 else TOP
    return Question(masses or None, sides or None, top=top)


def _required(arguments: Namespace) -> dict[str, Any]:
    """The requirements of the config, each replaced or dropped by its option."""
    from sweep.ranking.requirement_table import MEASURES

    options = {name: getattr(arguments, name) for name in MEASURES}
    requirements = stored_table(arguments.file, "require") | {k: v for k, v in options.items() if v}
    return {name: value for name, value in requirements.items() if value not in (None, "none")}


def stored_table(file: str, table: str) -> dict[str, Any]:
    """The table [rank] or [require] of the config stored in a results file."""
    from sweep.store.read import read_attributes

    try:
        config: dict[str, Any] = json.loads(read_attributes(file).get("config") or "{}")
    except ValueError:
        raise ArgumentError(f"{file} is damaged: the config in it is not JSON") from None
    return config.get(table) or {}
