"""What counts for designs that a striker hits."""

from sweep.ranking.rank import ranked
from sweep.report.sheets import legend, ranking_sheets
from tests.support.specimens import summary

NAN = float("nan")


def struck(force, energy, **other):
    """A row of a design under a striker."""
    hit = {"loading_mode": "impact", "stroke_m": NAN, "striker_mass_g": 50.0}
    speed = {"striker_speed_m_per_s": (2e3 * energy / 50.0) ** 0.5, "impact_energy_J": energy}
    return hit | speed | {"peak_force_N": force, "absorbed_energy_J": energy} | other


def test_under_a_striker_the_least_force_wins():
    """Every design takes all the energy, to a little more or less."""
    table = summary(
        struck(60.0, 0.1, mass_g=1.0, stroke_left_m=2e-3, rebound_share=0.4),
        struck(40.0, 0.1, mass_g=1.2),
        struck(70.0, 0.1, mass_g=1.4),
        struck(90.0, 0.2, mass_g=1.0),
    )
    ranking = ranked(table)
    designs = ranking.table
    assert list(designs["scene"]) == [
        *["struck by 50 g at 2 m/s (100 mJ), glued platens"] * 3,
        "struck by 50 g at 2.828 m/s (200 mJ), glued platens",
    ]
    assert list(designs["peak_force_N"]) == [40.0, 60.0, 70.0, 90.0]
    assert list(designs["pareto"]) == [True, True, False, True]
    assert set(designs["ranked_by"]) == {ranking.by} == {"peak_force_N"}
    first, _ = ranking_sheets(ranking, table)
    assert first.title.endswith("least force first")
    assert first.heads[2:] == ["force N", "sink %", "left mm", "rebound %"]
    assert first.rows[1][1:] == ["1.00", "60.0", "0", "2.00", "40"]
    assert "rebound: share" in legend(ranking)
