"""Files that cannot be read are refused in our own words, never in the words of a library."""

import pytest

from sweep.config.faults import ConfigError, MisfitError
from sweep.config.load import load_config
from sweep.config.materials.material_file import read_record
from sweep.config.reading.text import foreign_text
from sweep.config.structures.structure_file import read_structure
from sweep.coupon.record import read_coupon

LIBRARY = ("codec", "Errno", "Exceeds", "recursion", "embedded", "field larger", "char ")
HEADER = b"# density_kg_m3: 1000\n# poisson: 0.4\nstrain,stress_Pa\n"


@pytest.mark.parametrize(
    ("content", "why"),
    [
        ("name = 1".encode("utf-16"), "not UTF-8 text; needed: a TOML file"),
        (b"a = " + b"[" * 5000, "not TOML"),
        (b"a = " + b"9" * 5000, "not TOML"),
        (None, "sweep.toml: cannot be read (No such file"),
        (b'[lattice]\nkind = "custom"\nfile = "a\\u0000.json"', "not the path of a file; needed"),
        (b'[lattice]\nkind = "custom"\nfile = "none.json"', "cannot be read (No such file or"),
        (b'[material]\nname = "a\\u0000.csv"', "there is no "),
    ],
)
def test_configs(content, why, tmp_path):
    path = tmp_path / "sweep.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(ConfigError) as refusal:
        load_config(path)
    assert why in str(refusal.value)
    assert not any(word in str(refusal.value) for word in LIBRARY)


ABSENT = "cannot be read (No such file or directory); needed: a"
LONG = "a value of more than 131,072 characters"
FILES = [
    *((read, None, ABSENT) for read in (read_record, read_coupon, read_structure)),
    *((read, "1".encode("utf-16"), "not UTF-8 text; ") for read in (read_record, read_structure)),
    (read_coupon, b"PK\x03\x04 of a workbook", "a workbook; needed: a csv file (in the spreadsh"),
    (read_coupon, b"\x81\x00 and so on", "no text; needed: a csv file"),
    *((read, HEADER + b"1" * 200000, LONG) for read in (read_record, read_coupon)),
    (read_structure, b"[" * 10**5, "not JSON"),
    (read_structure, b'{"walls": ' + b"9" * 5000 + b"}", "not JSON"),
    (read_structure, b'{\n"walls": }', "not JSON at line 2, column 10"),
]


@pytest.mark.parametrize(("read", "content", "why"), FILES)
def test_files(read, content, why, tmp_path):
    path = tmp_path / "file"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(MisfitError) as refusal:
        read(path)
    assert why in str(refusal.value)
    assert not any(word in str(refusal.value) for word in LIBRARY)


@pytest.mark.parametrize(
    "coding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"]
)
def test_text_of_other_programs_may_have_other_codings(coding, tmp_path):
    path = tmp_path / "export.csv"
    path.write_bytes("Déplacement [mm] – mm²\n".encode(coding))
    assert foreign_text(path, "a csv file") == "Déplacement [mm] – mm²\n"


def test_text_of_other_programs_is_bounded(tmp_path, monkeypatch):
    monkeypatch.setattr("sweep.config.reading.text.MOST_BYTES", 3_000_000)
    path = tmp_path / "export.csv"
    path.write_bytes(b"1" * 3_000_001)
    with pytest.raises(MisfitError, match="larger than 3 MB; needed: a csv file"):
        foreign_text(path, "a csv file")
