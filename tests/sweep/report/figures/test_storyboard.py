"""Which shapes of a case are drawn, and their titles."""

import pandas
import pytest

from sweep.report.figures.storyboard import (
    crushes,
    design_and_scene,
    headline,
    last_loaded,
    path_of,
    shots,
    stacked,
    turns,
)
from tests.support.results.specimens import squeezed_cell, summary, there_and_back, under_dead_load


def captions(heights, release=None):
    return [text for _, text in shots(squeezed_cell(heights=heights), release)]


@pytest.mark.parametrize(
    ("heights", "release", "said"),
    [
        ((10.0, 9.955, 9.84), None, ["0 %", "0.45 %", "1.6 %"]),  # small strains: two digits
        ((10.0, 5.0, 7.0), None, ["0 %", "50 %", "30 %"]),  # not let go
        ((10.0, 5.0), None, ["0 %", "50 %"]),
        ((10.0, 10.01, 9.0), None, ["0 %", "10 %"]),  # rest is no negative strain
        ((10.0, 5.0, 10.01), 0.01, ["0 %\n0 ms", "50 %\n10 ms", "released\n20 ms"]),
        (
            *((10.0, 4.0, 5.0, 5.5, 10.0), 0.03),  # also as it stands when let go
            ["0 %\n0 ms", "60 %\n10 ms", "45 %\n30 ms", "released\n40 ms"],
        ),
    ],
)
def test_captions_are_strains_and_of_a_load_that_is_removed_times(heights, release, said):
    assert captions(heights, release) == said


def test_even_strains_on_the_way_down_then_the_end():
    frames, texts = zip(*shots(squeezed_cell()), strict=True)
    assert frames == (0, 1, 2, 4, 5, 7)
    assert texts == ("0 %", "10 %", "20 %", "40 %", "50 %", "released")


def test_what_flies_off_is_drawn_while_it_is_near():
    frames = squeezed_cell(heights=(10.0, 5.0, 10.0, 10.0, 10.0))
    frames["position_m"][3:, :, 1] += [[4e-3], [6e-3]]
    assert [frame for frame, _ in shots(frames, release=0.01)] == [0, 1, 3]
    frames["position_m"][2:, :, 1] += 6e-3  # gone at once
    assert [frame for frame, _ in shots(frames, release=0.01)] == [0, 1]


def test_load_goes_where_the_way_first_turns_or_the_force_ends():
    assert last_loaded(under_dead_load(), {"loading_mode": "force"}) == 20
    once = there_and_back()
    again = pandas.concat([once, once[1:]], ignore_index=True)
    again.loc[21:, "strain"] *= 1.0 + 1e-15
    assert again["strain"].argmax() > 20
    for history in (once, again):
        assert last_loaded(history, {"loading_mode": "displacement"}) == 20


def test_a_platen_turns_after_its_pause():
    """Twice 20 rows down, 5 at rest, 20 up; then halted while it moves up or down again."""
    once = there_and_back()
    held = pandas.concat([once[:21], *[once[20:21]] * 5, once[21:]])
    twice = pandas.concat([held, held[1:]], ignore_index=True)
    assert crushes(twice) == [(20, 25, 45), (65, 70, 90)]
    assert crushes(twice[:31]) == [(20, 25, 30)]
    assert crushes(twice[:61]) == [(20, 25, 45)]
    assert crushes(twice[:11]) == [(10, 10, 10)]
    row = {"loading_mode": "displacement"}
    assert turns(twice, row) == {25: "reversal", 45: "cycle 2", 70: "reversal"}
    assert turns(twice[:24], row) == {}


@pytest.mark.parametrize(
    ("row", "design"),
    [
        ({"cells_y": 2}, "square, 3 x 2 cells, wall 0.8 mm, ninjaflex"),
        (
            {"lattice_kind": "stars", "infill_share": 0.204},
            "stars, 20.4 % infill, wall 0.8 mm, nin",
        ),
    ],
)
def test_headline_names_cells_or_share_wall_material_and_scene(row, design):
    (row,) = summary(row).to_dict("records")
    assert headline(row).startswith(design)
    assert headline(row).endswith("ninjaflex\ncrushed to 50 %, glued platens")


def test_a_long_scene_takes_more_lines_of_a_headline():
    row = {"lattice_kind": "square", "striker": "edge, 60 deg, tip 1 mm, at 50 %", "material": "x"}
    row |= {"loading_mode": "impact", "striker_mass_g": 1360.0, "target_mass_g": 1360.0}
    (row,) = summary(row).to_dict("records")
    design, scene = design_and_scene(row)
    first, *others = headline(row).split("\n")
    assert (first, " ".join(others)) == (design, scene)
    assert len(others) == 2
    assert max(map(len, others)) <= 80


def test_negligible_energies_are_no_parts():
    _, _, parts = stacked(there_and_back(), {"loading_mode": "displacement"})
    assert list(parts) == ["bend_J", "dissipated_friction_J"]


def test_path_of_a_platen_goes_on_as_it_turns_and_others_have_time():
    history = there_and_back()
    place, label = path_of(history, {"loading_mode": "displacement"})
    assert place.iloc[-1] == pytest.approx(8.0)
    assert place.is_monotonic_increasing
    assert label.endswith("mm")
    time, label = path_of(history, {"loading_mode": "impact"})
    assert (time.iloc[-1], label) == (pytest.approx(40.0), "time, ms")
