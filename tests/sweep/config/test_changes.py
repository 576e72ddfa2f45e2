"""Cases changed to other values: which are replaced, which computed anew, which stay."""

import json

import pytest

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError

CRUSH, LOSS = dict(loading=dict(strain=0.5)), dict(material=dict(loss=0.4))
SIZE, WIDE = dict(cell_size=4e-3), dict(width=50e-3)
SLICED = dict(slicer="prusa", pattern="grid", infill=0.2)
THIN, FOUR, HEAVY = dict(wall_thickness=0.6e-3), dict(cells_x=4, cells_y=4), dict(mass=1e-3)
LINES = dict(perimeters=1, line_width=0.4e-3)
DROP = dict(energy=1.0, striker_mass=0.1, duration=0.05)


def test_a_change_completes_the_case_anew():
    case = Case.of(axes={"lattice.cells": 3})
    pressed = case.changed(loading=dict(mode="displacement", strain=0.5))
    assert pressed == Case.of(**CRUSH, axes=case.axes)
    assert pressed.solver != case.solver
    assert case.changed() == case


def test_a_key_of_another_kind_is_refused():
    with pytest.raises(RefusedError, match="a key of DeadLoad"):
        Case.of().changed(**CRUSH)


FALL = dict(striker_mass=0.1, striker_speed=3.0, duration=0.05)
FAST = dict(strain=0.5, speed=1.0, quasi_static=True)
SHARE, CHEETAH = dict(infill=0.2), dict(name="cheetah")
LATTICES = [
    (HEAVY, THIN, THIN),
    (THIN, HEAVY, HEAVY),
    (HEAVY, FOUR, HEAVY | FOUR),
    (LINES | SHARE, THIN | FOUR, LINES | THIN | FOUR),
    (FOUR, SHARE, SHARE),
    (FOUR, SIZE, SIZE),
    (SIZE, FOUR, FOUR),
    (SIZE, SHARE, SHARE),
    (SIZE, WIDE, SIZE | WIDE),
    (FOUR | THIN, SLICED, SLICED),
    (SLICED, dict(slicer=None, kind="hex"), dict(kind="hex")),
    (SLICED, HEAVY, dict(slicer="prusa", pattern="grid") | HEAVY),
]


@pytest.mark.parametrize(
    ("given", "change", "same"),
    [
        *(tuple(dict(lattice=table) for table in tables) for tables in LATTICES),
        (CRUSH, dict(loading=dict(strain=0.3)), dict(loading=dict(strain=0.3))),
        (CRUSH, dict(loading=dict(stroke=0.004)), dict(loading=dict(stroke=0.004))),
        (CRUSH, dict(lattice=dict(height=0.02)), CRUSH | dict(lattice=dict(height=0.02))),
        (CRUSH | LOSS, dict(lattice=WIDE), CRUSH | LOSS | dict(lattice=WIDE)),
        (CRUSH | LOSS, dict(loading=dict(speed=1.0)), LOSS | dict(loading=FAST)),
        (CRUSH, dict(loading=dict(mode="impact") | DROP), dict(loading=DROP)),
        (dict(loading=DROP), dict(loading=dict(energy=2.0)), dict(loading=DROP | dict(energy=2.0))),
        (dict(loading=DROP), dict(loading=dict(striker_speed=3.0)), dict(loading=FALL)),
        (CRUSH, dict(material=CHEETAH), CRUSH | dict(material=CHEETAH)),
        (dict(lattice=HEAVY), dict(material=CHEETAH), dict(lattice=HEAVY, material=CHEETAH)),
    ],
)
def test_what_a_new_value_replaces_is_gone(given, change, same):
    changed, anew = Case.of(**given).changed(**change), Case.of(**same)
    for table in ("lattice", "material", "loading"):
        assert getattr(changed, table) == getattr(anew, table)


@pytest.mark.parametrize("lattice", [HEAVY, dict(kind="gyroid", mass=1e-4)])
def test_walls_stay_if_their_mass_is_taken_away(lattice):
    heavy = Case.of(lattice=lattice)
    walls = heavy.changed(lattice=dict(mass=None, imperfection=0.02)).lattice
    assert (walls.mass, walls.wall_thickness) == (None, heavy.lattice.wall_thickness)


def test_a_memory_that_a_change_adds_has_its_constants():
    """The constants are those in the file of the material."""
    case = Case.of(loading=dict(mode="displacement"))
    relaxing, direct = case.changed(**LOSS), Case.of(**LOSS)
    assert relaxing.material.reference_time == direct.material.reference_time
    softening = case.changed(material={"softening_r": 1.5, "softening_m": 1e5})
    assert softening.material.softening_beta == 0.1
    assert relaxing.changed(material={"loss": None}).material.loss is None


def test_another_file_brings_another_structure(tmp_path):
    walls = {"nodes_mm": [[0, 0], [9, 0], [0, 9]], "walls": [[0, 1], [1, 2]]}
    for name, nodes in (("a", walls["nodes_mm"]), ("b", [[0, 0], [5, 0], [0, 9]])):
        (tmp_path / f"{name}.json").write_text(json.dumps(walls | {"nodes_mm": nodes}))
    for kind in ("custom", "drawn"):
        one, other = (
            Case.of(lattice={"kind": kind, "file": str(tmp_path / f"{name}.json")}) for name in "ab"
        )
        assert one.lattice.width != other.lattice.width
        changed = one.changed(lattice={"file": str(tmp_path / "b.json")})
        assert changed.case_id == other.case_id
