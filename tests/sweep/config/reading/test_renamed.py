"""Keys of the release before are understood wherever a config may have them."""

import pytest

from sweep.config.grid import ConfigError, expand
from sweep.config.units import load_config

WARNING = 'solver.hinges is now solver.element, and "exact_beam" is now "cubic"'


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('[solver]\nhinges = "classical"', ["classical"]),
        ('[solver]\nhinges = "exact_beam"', ["cubic"]),
        ('[grid]\n"solver.hinges" = ["exact_beam", "classical"]', ["cubic", "classical"]),
        ('[grid]\nsolver.hinges = ["classical", "exact_beam"]', ["classical", "cubic"]),
        ('[[zip]]\n"solver.hinges" = ["classical", "exact_beam"]\n"lattice.cells" = [1, 2]',
         ["classical", "cubic"]),
    ],
)  # fmt: skip
def test_an_old_key_is_read_as_the_present_one(tmp_path, text, found):
    path = tmp_path / "old.toml"
    path.write_text(text, "utf-8")
    with pytest.warns(FutureWarning, match=WARNING):
        config = load_config(path)
    assert [case.solver.element for case in expand(config)] == found


@pytest.mark.parametrize(
    "text",
    [
        '[solver]\nhinges = "classical"\nelement = "cubic"',
        '[solver]\nelement = "cubic"\nhinges = "nonsense"',
        '[grid]\n"solver.hinges" = ["classical"]\n"solver.element" = ["cubic"]',
    ],
)
def test_an_old_key_beside_the_present_one_is_refused(tmp_path, text):
    path = tmp_path / "both.toml"
    path.write_text(text, "utf-8")
    with pytest.raises(ConfigError, match=r"solver\.hinges = .*: unknown key"):
        load_config(path)
