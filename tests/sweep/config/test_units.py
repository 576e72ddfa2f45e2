"""From TOML to a sweep in SI: quantities and their units, files that are none, light imports."""

import subprocess
import sys
from pathlib import Path

import pint
import pytest

from sweep.config.units import ConfigError, load_config, quantity

PINT = pint.UnitRegistry()


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("0.8 mm", "m", 0.8e-3),
        ("0.8mm", "m", 0.8e-3),
        ("400 um", "m", 0.4e-3),
        ("0.5 in", "m", 0.0127),
        ("2 oz", "kg", 0.0566990462500),
        ("1 lb", "kg", 0.45359237),
        ("100 mm/min", "m/s", 0.1 / 60),
        ("5 1/s", "1/s", 5.0),
        ("5/s", "1/s", 5.0),
        ("1e-4 s", "s", 1e-4),
        ("12 MPa", "Pa", 12e6),
        ("12 N/mm^2", "Pa", 12e6),
        ("1.19 g/cm^3", "kg/m^3", 1190.0),
        ("1 kgf", "N", 9.80665),
    ],
)
def test_quantities(text, unit, value):
    assert quantity(text, unit) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("unit", "si"),
    [
        *[(length, "m") for length in ("inch", "foot", "thou", "ft")],
        *[(mass, "kg") for mass in ("ounce", "pound", "oz", "lb")],
        *[(force, "N") for force in ("kgf", "lbf")],
        *[(stress, "Pa") for stress in ("psi", "bar", "GPa")],
        ("km/hour", "m/s"),
    ],
)
def test_units_are_those_of_pint(unit, si):
    standard = PINT.Quantity(1.0, unit).m_as(si)
    assert quantity(f"1 {unit}", si) == pytest.approx(standard, rel=1e-12)


@pytest.mark.parametrize("text", ["4 %%", "4 % %"])
def test_percent_is_written_once(text):
    with pytest.raises(ConfigError, match="unknown unit"):
        quantity(text, "1")
    assert quantity("5 %/s", "1/s") == 0.05


@pytest.mark.parametrize(
    "text", ["25", "g", "", "25 N", "25 gg", "nan g", "1e999 g", "3 ((", "1 1/0"]
)
def test_bad_quantities_are_refused_in_one_line(text):
    with pytest.raises(ConfigError, match=r'allowed: a mass with a unit, such as "25 g"') as caught:
        quantity(text, "kg")
    assert len(str(caught.value).splitlines()) == 1


def test_not_toml(lines, tmp_path):
    (line,) = lines("hello world")
    assert line.startswith(f"{tmp_path / 'sweep.toml'}: not TOML (Expected '='")


def test_missing_file(tmp_path):
    with pytest.raises(ConfigError, match=r"no\.toml: cannot be read \(No such file"):
        load_config(tmp_path / "no.toml")
    with pytest.raises(
        ConfigError, match=r'^\{"name": "a"\} is no path; needed: the path of a TOML'
    ):
        load_config({"name": "a"})


def test_not_text(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ConfigError, match="not TOML"):
        load_config(path)


CONFIGS = Path(__file__).parents[3] / "configs"


def test_a_refused_config_loads_nothing_heavy(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('[lattice]\nwidth = "1 kg"')
    heavy = ["numpy", "scipy", "pandas", "numba", "dask", "h5py", "matplotlib", "shapely"]
    script = f"""
import sys
from sweep.config.units import ConfigError, load_config
try:
    load_config({str(path)!r})
except ConfigError:
    print(*[name for name in {heavy} if sys.modules.get(name)])
"""
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=CONFIGS.parent,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == ""
