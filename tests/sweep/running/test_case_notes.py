"""A run says in which cases a relaxing material loses nothing, and in which one period represents a
wide panel.
"""

import pytest

from sweep.config.case import Case
from sweep.ranking.merit import check_panel
from sweep.ranking.question import RankError
from sweep.running.case_notes import sentences_on_lossless, sentences_on_periods
from sweep.running.sweep import run_sweep
from sweep.simulation.simulate import simulate
from tests.support.designs.tables import material_with
from tests.support.results import standin

SLOW = material_with(relaxation_times=(2.0, 60.0), relaxation_shares=(0.2, 0.1), reference_time=1.0)


@pytest.mark.parametrize(
    ("loading", "time"),
    [
        ({"strain": 0.5, "speed": 0.1}, 0.125),
        ({"strain": 0.5, "speed": 0.1, "hold_time": 2.0}, 2.125),
        ({"mode": "impact", "striker_speed": 2.5}, 0.01),
        ({"force": 2.0, "duration": 0.3}, 0.3),
    ],
)
def test_time_of_a_loading(loading, time):
    case = Case.of(loading=loading)
    assert case.loading.loaded_for(case.height) == pytest.approx(time)


@pytest.mark.parametrize(("rate", "lines"), [(1e-5, 1), (1e-3, 0), (0.1, 0), (20.0, 0), (100.0, 1)])
def test_only_what_is_far_from_all_times_is_told(rate, lines):
    """Times of 1.2 over the rate: 1.2e5 s, 1200 s, 12 s, 60 ms and 12 ms; limits: 6000 s, 20 ms."""
    case = Case.of(material=SLOW, loading=dict(mode="displacement", strain_rate=rate))
    assert len(sentences_on_lossless([case])) == lines
    assert "longest" in "".join(sentences_on_lossless([case])) or rate > 1e-4


def test_a_sweep_tells_before_it_runs(tmp_path, capsys):
    struck = Case.of(material=SLOW, loading=dict(mode="impact", striker_speed=2.5))
    crush = struck.changed(loading={"mode": "displacement"})
    told = "1 of 2 cases last less than a hundredth of the shortest material.relaxation time (0.01"
    for line in (told, ""):
        run_sweep([struck, crush], tmp_path / "trial.h5", simulate=standin.simulate)
        err = capsys.readouterr().err
        assert err.count("relaxation time") == len(line[:1])
        assert line in err


def test_elastic_walls_and_a_measured_loss_are_never_told():
    short = dict(mode="impact", striker_speed=100.0)
    cases = [Case.of(loading=short, material=material) for material in ({}, {"loss": 0.4})]
    assert sentences_on_lossless(cases) == []


def test_what_is_told_is_true():
    """Walls whose branches are a hundred times slower than the crush lose 1 % of its work at
    most.
    """
    shares = []
    for rate in (0.6, 1200.0):
        loading = dict(mode="displacement", strain=0.3, strain_rate=rate)
        lines = sentences_on_lossless([case := Case.of(material=SLOW, loading=loading)])
        assert len(lines) == (rate > 1.0)
        shares.append(simulate(case).summary["lost_share"])
    elastic = simulate(Case.of(loading=loading)).summary["lost_share"]
    assert shares[0] - elastic > 0.03
    assert shares[1] - elastic < 0.01


def tied(friction):
    return Case.of(
        lattice={"sides": "periodic"},
        loading={"strain": 0.5, "platen": "contact"},
        contact={"friction": friction},
    )


def test_fixed_and_free_periods_are_told_apart():
    others = [Case.of(), tied(0.3), tied(0.0), tied(0.4)]
    fixed, free = sentences_on_periods(others)
    assert fixed.startswith("2 of 4 cases are one period of a wide panel")
    assert "its width is fixed" in fixed
    assert free.startswith("1 of 4 cases")
    assert "its width is free" in free
    assert sentences_on_periods([Case.of()]) == []


def test_periods_fill_a_panel_of_any_size():
    check_panel(("1 mm", "1 mm"), [tied(0.3)])
    with pytest.raises(RankError, match="smaller than half of a specimen"):
        check_panel(("1 mm", "1 mm"), [Case.of(), tied(0.3)])
