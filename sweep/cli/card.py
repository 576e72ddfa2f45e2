"""The verb `card`: the effective materials of the infills of a config."""

from argparse import Namespace
from pathlib import Path

from sweep.cli.refusals import ArgumentError, writing
from sweep.cli.terminal import hint, print_sheets, say
from sweep.config.faults import MisfitError
from sweep.config.grid import Config, expand
from sweep.effective.cell import infill_of
from sweep.effective.material import EffectiveMaterial
from sweep.effective.material import card as effective
from sweep.report.tables.card_sheet import card_sheet


def card(config: Config, arguments: Namespace) -> None:
    """Print the effective materials of the infills of a config, and write them with --to."""
    materials: dict[tuple[str, float, float], EffectiveMaterial] = {}
    refused: dict[str, None] = {}
    for case in expand(config):
        try:
            infill = infill_of(case)
            key = (infill.case.case_id, infill.angle, infill.gyration)
            if key not in materials:
                materials[key] = effective(case)
        except MisfitError as error:
            refused[str(error)] = None
    cards = list(materials.values())
    if not cards:
        raise ArgumentError("\n".join(refused))
    print_sheets([card_sheet(cards)])
    hint(f"left out: {line}" for line in refused)
    if arguments.to:
        from sweep.export.card import write_card

        path = Path(arguments.to)
        with writing(path.parent, path):
            say(write_card(cards, path))
