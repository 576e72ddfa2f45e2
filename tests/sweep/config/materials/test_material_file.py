"""Records of materials: stated values win, unusable ones are refused by name."""

import pytest

from sweep.config.materials.material_file import (
    FOLDER,
    RecordError,
    UnknownMaterialError,
    locate,
    read_record,
    stress_at,
)
from tests.support.designs.tables import material_with
from tests.support.materials.records import HEADER

CURVE = "0.01,1e5\n0.1,9e5\n"


def test_a_stretch_is_one_more_than_a_strain(own_record):
    text = HEADER.replace("strain", "stretch") + "1,0\n1.1,9e5\n7.5,8e6\n"
    assert read_record(own_record(text)).strain == (0.0, 0.1, 6.5)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("strain,stress_Pa\n0.01,1\n0.1,2\n", "needs the lines # density_kg_m3"),
        ("# density_kg_m3: 1.2 g/cm^3\n# poisson: 0.4\nstrain,stress_Pa\n0,0\n1,1\n", "density_kg"),
        (HEADER.replace("_Pa", "_bar") + "0.01,1\n", "first row must read .*units: strain_perc"),
        (HEADER + "0.01,1,3\n", "two numbers"),
        (HEADER + "0.01,soft\n0.1,2\n", "two numbers, but one is .0.01,soft."),
        (HEADER + "0.01,nan\n0.1,2\n", r"\(0.01, nan\); allowed: finite"),
        (HEADER + "0.02,1\n0.01,2\n", "a strain of 0.01 after 0.02; .* must increase"),
        (HEADER + "-1.0,-1\n0.1,2\n", "a strain of -1; .* from above -1"),
        (HEADER + "0.01,1\n0.02,2\n", "reach a strain of 0.04"),
        (HEADER + "0.01,-1\n0.5,2\n", "positive at 1 % strain, not -1 Pa"),
        (HEADER + "0,5e6\n0.1,6e6\n", "a stress of 5e.06 Pa at a strain of 0; .* 0 at the origin"),
        (HEADER + "0.1,1e6\n0.5,-3e6\n", "a stress of -3e.06 Pa .* positive in tension"),
        (HEADER + "-0.5,1e5\n0.1,1e6\n", "a stress of 100000 Pa .* negative in compression"),
        (HEADER, "reach a strain"),
        (HEADER + "0.1,6e5\n35,8e6\n", "strain of 35, which is 3500 %: .*write strain_percent"),
        (HEADER + "0.02,0.5\n0.1,1.6\n", "modulus of 17.5 Pa; .*in MPa. write stress_MPa"),
        (HEADER + "0.02,5e11\n0.1,2e12\n", "modulus of .* Pa; allowed: 0.1 MPa to 1000 GPa$"),
        (HEADER.replace("1200", "1.2") + CURVE, "density: 1.2 .* in g/cm3. write # density_g_cm3"),
        ("# modulus_Pa: 17 .. 21\n" + HEADER + CURVE, "modulus: 17 .* write # modulus_MPa"),
        ("# density_g_cm3: 1.2\n" + HEADER + CURVE, "density is stated twice; needed: once"),
        ("# loss: 38\n" + HEADER + CURVE, "# loss: 38; allowed: .*at most 0.8; 38 % is 0.38"),
        ("# loss: 0.3 (0.2 .. 0.9)\n" + HEADER + CURVE, "# loss: 0.9; allowed: above 0, at most"),
        ("# softening_r: 1\n# softening_m_Pa: 1e5\n" + HEADER + CURVE, "# softening_r: 1; allo"),
    ],
)
def test_unusable_records_are_refused_by_name(own_record, text, message):
    with pytest.raises(RecordError, match=f"own.csv: .*{message}"):
        read_record(own_record(text))


def test_heads_may_name_their_unit(own_record):
    """The same curve in percent and MPa, with its density in g/cm3, as data sheets have them."""
    pairs = [(0.02, 5e5), (0.05, 1e6), (0.1, 1.6e6), (1.5, 6e6)]
    text = "# density_g_cm3: 1.2 (1.19 .. 1.22)\n# poisson: 0.48\n# modulus_MPa: 19 +- 2\n"
    for head, size in (("stress_MPa", 1e6), ("stress_kPa", 1e3), ("stress_GPa", 1e9)):
        rows = "".join(f"{100 * e:g},{s / size:.9g}\n" for e, s in pairs)
        record = read_record(own_record(f"{text}strain_percent,{head}\n{rows}"))
        assert list(zip(record.strain, record.stress, strict=True)) == pairs
    assert (record.density, record.modulus) == (1200.0, 19e6)
    assert record.ranges == {"density": (1190.0, 1220.0), "modulus": (17e6, 21e6)}


def test_the_modulus_is_the_secant_between_one_and_four_percent(own_record):
    """With the origin implied, and rows of compression left alone."""
    path = own_record(HEADER + "-0.2,-9e5\n0.02,3e4\n0.06,1.1e5\n")
    assert read_record(path).modulus == pytest.approx((7e4 - 1.5e4) / 0.03)


def test_stress_is_straight_between_the_points_and_ends_with_them():
    strain, stress = (-0.1, 0.02, 0.06), (-1e5, 3e4, 1.1e5)
    found = [stress_at(at, strain, stress) for at in (0.0, 0.01, 0.02, 0.05, 0.06)]
    assert found == pytest.approx([0.0, 1.5e4, 3e4, 9e4, 1.1e5])
    with pytest.raises(RecordError, match=r"ends below a strain of 0\.07"):
        stress_at(0.07, strain, stress)


def test_own_file_is_looked_for_in_its_folder_and_shipped_ones_are_not(tmp_path):
    (tmp_path / "mine.csv").touch()
    assert locate("mine.csv", tmp_path) == tmp_path / "mine.csv"
    assert locate("cheetah", tmp_path) == FOLDER / "cheetah.csv"
    for name in ("mine", "yours.csv"):
        with pytest.raises(UnknownMaterialError, match=f'"{name}" is no material; allowed: .*chee'):
            locate(name, tmp_path)


PLASTIC = "# density_kg_m3: 1200\n# poisson: 0.35\n# modulus_Pa: 2e9\n# yield_stress_Pa: 4e7\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (PLASTIC + "strain,stress_Pa\n0.1,1e6\n", "yields has no curve"),
        (PLASTIC.replace("# modulus_Pa: 2e9\n", ""), "yields needs the line # modulus_Pa"),
        (PLASTIC + "# fracture_strain: 2.5\n", "# fracture_strain: 2.5; .* 1; 2.5 % is 0.025"),
        ("# fracture_strain: 0.1\n" + HEADER + "0.1,1e6\n", "fracture_strain needs the line # y"),
    ],
)
def test_unusable_plastics_are_refused_by_name(own_record, text, message):
    with pytest.raises(RecordError, match=f"own.csv: .*{message}"):
        read_record(own_record(text))


def test_a_material_with_a_yield_stress_yields_unless_told_otherwise(own_record):
    path = own_record(PLASTIC + "# hardening_Pa: 1e7\n# fracture_strain: 0.05\n")
    material = material_with(name=str(path))
    assert (material.stretch, material.bend, material.fibres) == ("linear", "fibres", 7)
    assert (material.modulus, material.yield_stress, material.hardening) == (2e9, 4e7, 1e7)
    assert material.fracture_strain == 0.05
    assert material.curve_strain == ()
    other = material_with(name=str(path), yield_stress=3e7, bend="section")
    assert (other.yield_stress, other.hardening, other.fibres) == (3e7, 1e7, None)
