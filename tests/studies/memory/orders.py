"""Which answers change: the order of the designs of a sweep, with and without each part."""

from sweep.ranking.scenes import by_scene
from sweep.report.tables.sheet import Sheet
from tests.studies.memory.variants import PARTS, changed
from tests.studies.rankings.orders import CONFIGS, cases_of, compared, merits

ELASTIC = "elastic"


def variants(folder, parts=PARTS):
    """Every case of the configs, without and with each part: (config, part) -> cases."""
    found = {}
    for name, cases in cases_of(folder).items():
        found[name, ELASTIC] = [changed(case, {}) for case in cases]
        for part, keys in parts.items():
            found[name, part] = [changed(case, keys) for case in cases]
    return found


def lost(rows):
    """Energy per gram that is not returned."""
    return (rows["absorbed_energy_J"] - rows["returned_energy_J"]) / rows["mass_g"]


def table(summaries, parts=PARTS):
    """Correlations of all scenes; summaries: (config, part) -> rows in the order of the cases."""
    heads, body = ["config", "scene", "designs", *parts], []
    for name in CONFIGS:
        elastic = summaries[name, ELASTIC].reset_index(drop=True)
        for label, scene in by_scene(elastic).items():
            row = [name, label, str(len(scene))]
            for part in parts:
                rows = summaries[name, part].reset_index(drop=True).loc[scene.index]
                rho, same = compared(merits(scene), merits(rows))
                row.append(f"{rho:.2f}{'' if same else ' *'}")
            body.append(row)
    notes = (
        "Spearman's correlation of the order of designs with that of elastic walls, by energy per",
        "gram until densification (crushes), least strain (dead loads), least force (impacts).",
        "*: another design is the best.",
    )
    return Sheet("Orders with and without memory", heads, body, notes=notes)


def by_loss(summaries, part):
    """The same for the lost energy per gram, compared with the absorbed one, with one part."""
    heads = ["config", "scene", "absorbed against lost", "best by lost is best by absorbed"]
    body = []
    for name in CONFIGS:
        rows = summaries[name, part].reset_index(drop=True)
        for label, scene in by_scene(rows).items():
            if scene["loading_mode"].iloc[0] != "displacement":
                continue
            rho, same = compared(scene["absorbed_energy_J"] / scene["mass_g"], lost(scene))
            body.append([name, label, f"{rho:.2f}", "yes" if same else "no"])
    return Sheet(f"Absorbed or lost, {part}", heads, body)
