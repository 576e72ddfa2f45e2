"""The legend of a ranking: what marks and heads of columns mean."""

from sweep.ranking.rank import ranked
from sweep.report.tables.legend import (
    ELASTIC,
    LOADED,
    LOSSY,
    MIXED,
    PLASTIC,
    SECOND,
    legend,
)
from sweep.report.tables.requirement_notes import STRUCK_PANEL
from tests.support.results.specimens import summary


def test_legend_explains_what_is_shown():
    crushed = summary({"absorbed_energy_at_50N_J": 0.1})
    assert "are counted until densification" in legend(ranked(crushed))
    assert "are counted until the force exceeds 50 N" in legend(ranked(crushed, allowed_force=50.0))
    assert "are counted to the end of the stroke" in legend(ranked(crushed, by="absorbed_energy_J"))
    assert "sink" not in legend(ranked(crushed))
    loaded = summary({"loading_mode": "force", "force_N": 5.0})
    assert legend(ranked(loaded)).splitlines()[1:] == [LOADED]


def test_strain_at_which_a_crush_ended_unpacked_is_that_of_the_crush():
    packed = {"peak_strain": 0.5}
    assert '">' not in legend(ranked(summary(packed)))
    unpacked = packed | {"densification_strain": float("nan")}
    said = legend(ranked(summary(packed, unpacked)))
    assert '"> 50": no densification before the end of the crush, at 50 %.' in said


def test_all_specimens_of_a_panel_are_struck_at_once():
    struck = {"loading_mode": "impact", "striker_mass_g": 50.0, "striker_speed_m_per_s": 1.0}
    panel = ("130 mm", "50 mm")
    assert STRUCK_PANEL in legend(ranked(summary(struck), panel=panel))
    assert STRUCK_PANEL not in legend(ranked(summary(struck)))
    assert STRUCK_PANEL not in legend(ranked(summary({}), panel=panel))


def test_legend_says_what_takes_the_energy_that_does_not_come_back():
    relaxing = {"material_memory": "relaxes", "material": "mine"}
    struck = {"loading_mode": "impact", "striker_mass_g": 50.0, "striker_speed_m_per_s": 1.0}
    for common in ({}, struck):
        said = legend(ranked(summary(common, common)))
        assert said.endswith(ELASTIC)
        assert max(map(len, f"{said}\n{MIXED}\n{PLASTIC}\n{SECOND}".splitlines())) <= 100
        assert legend(ranked(summary(common | relaxing))).endswith(LOSSY)
        assert legend(ranked(summary(common, common | relaxing))).endswith(MIXED)
        yielding = common | {"material_memory": "yields"}
        assert legend(ranked(summary(yielding))).endswith(PLASTIC)
        assert legend(ranked(summary(yielding, common | relaxing))).endswith(LOSSY)
    pulled = summary({"absorbed_energy_at_50N_J": 0.1})
    assert ELASTIC not in legend(ranked(pulled, allowed_force=50.0))
