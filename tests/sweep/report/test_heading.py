"""What stands above a ranking."""

import pytest

from sweep.__main__ import main
from sweep.result import absorbed_energy_column
from tests.support.specimens import summary, write


@pytest.mark.parametrize(
    ("mode", "told"),
    [
        ("displacement", "Energy is counted until the force of a specimen exceeds 0.05 kN."),
        ("force", "The force of 0.05 kN has no effect: without a crush no energy is ranked."),
        ("impact", "The force of 0.05 kN has no effect: without a crush no energy is ranked."),
    ],
)
def test_what_an_allowed_force_is_for_is_told(capsys, tmp_path, mode, told):
    row = {absorbed_energy_column(50.0): 0.01, "loading_mode": mode}
    main(["rank", write(tmp_path / "trial.h5", summary(row)), "--allowed-force", "0.05 kN"])
    assert told in capsys.readouterr().out
