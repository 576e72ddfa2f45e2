"""Requirements for which no case has a value."""

from pathlib import Path

import pytest

from sweep.ranking.question import RankError
from sweep.running.run import run


@pytest.mark.parametrize(
    ("loading", "limit", "needed"),
    [
        ('base = "ribs"\nbase_span = "9 mm"', 'max_base_pressure = "1 kPa"', "a flat base"),
        ('platen = "contact"', 'max_target_acceleration = "9 g0"', "loading.target_mass"),
    ],
)
def test_a_requirement_of_which_no_case_has_a_value_is_refused(
    monkeypatch, tmp_path, loading, limit, needed
):
    monkeypatch.chdir(tmp_path)
    struck = f'[loading]\nmode = "impact"\nstriker_mass = "9 g"\nstriker_speed = "1 m/s"\n{loading}'
    (tmp_path / "mine.toml").write_text(f'name = "mine"\n{struck}\n[require]\n{limit}\n')
    with pytest.raises(RankError, match=f"^{limit}: not known of these cases; needed: {needed}"):
        run("mine.toml")
    assert not Path("results").exists()
