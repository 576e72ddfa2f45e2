"""Shapes of an SVG file with their transforms, in the length that its page gives them."""

import sys

import numpy as np
import pytest

from sweep.config.drawings.svg import PIXEL, read_svg
from sweep.config.faults import MisfitError

LINE = '<line x1="0" y1="0" x2="10" y2="5"/>'
XLINK = 'xmlns:xlink="http://www.w3.org/1999/xlink"'


def written(path, inner, page=""):
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {XLINK} {page}>{inner}</svg>')
    return path


def test_shapes_and_transforms_are_read_with_y_upwards(tmp_path):
    inner = (
        f'<defs><g id="bar">{LINE}</g></defs><g transform="translate(1 2) scale(2)">'
        '<use xlink:href="#bar" x="3"/></g><polyline points="0,0 4,0 4,4"/>'
        '<rect x="20" y="0" width="4" height="2"/><circle cx="40" cy="0" r="2"/>'
        '<path d="m 60 0 h 4 v 4 q 4 0 4 4 z" /><g display="none"><line x2="99" y2="99"/></g>'
    )
    lines = read_svg(written(tmp_path / "a.svg", inner))
    ends = lines.ends
    assert ends[0] == pytest.approx(np.array([[7.0, -2.0], [27.0, -12.0]]))
    assert ends[1:3].tolist() == [[[0, 0], [4, 0]], [[4, 0], [4, -4]]]
    assert ends[3:7, 0] == pytest.approx(np.array([[20, 0], [24, 0], [24, -2], [20, -2]]))
    ring = ends[7:39]
    assert np.linalg.norm(ring - [40, 0], axis=2) == pytest.approx(2.0, rel=1e-3)
    assert ends[-1].tolist() == [[68, -8], [60, 0]]
    assert ends.max() < 90.0


@pytest.mark.parametrize(
    "hidden",
    [
        '<line x2="9" y2="9" visibility="hidden"/>',
        '<g style="visibility:collapse"><line x2="9" y2="9"/></g>',
        '<style>.no {visibility: hidden}</style><line class="no" x2="9" y2="9"/>',
        '<line x2="9" y2="9" opacity="0"/>',
        '<line x2="9" y2="9" stroke-opacity="0.0"/>',
        '<line x2="9" y2="9" stroke-width="0px"/>',
        '<symbol id="s"><line x2="9" y2="9"/></symbol>',
        '<defs><marker id="m"><line x2="9" y2="9"/></marker></defs>',
    ],
)
def test_what_is_hidden_is_no_wall(tmp_path, hidden):
    wall = LINE.replace("/>", ' stroke="black"/>')
    lines = read_svg(written(tmp_path / "a.svg", hidden.replace("x2", "stroke='red' x2") + wall))
    assert lines.ends.tolist() == [[[0.0, 0.0], [10.0, -5.0]]]


def test_what_is_filled_needs_no_stroke(tmp_path):
    """Editors write a width of 0 for shapes that are only filled."""
    filled = '<rect width="9" height="9" style="fill:#000;stroke:none;stroke-width:0"/>'
    assert len(read_svg(written(tmp_path / "a.svg", filled)).ends) == 4


def test_what_is_faint_or_thin_is_a_wall(tmp_path):
    thin = '<line x2="9" y2="9" stroke="red" stroke-width="0.01" opacity="0.05"/>'
    assert len(read_svg(written(tmp_path / "a.svg", thin)).ends) == 1


def test_beside_strokes_what_is_only_filled_is_left_out(tmp_path):
    """A style sheet or a group may say so too; the black fill of CSS is no stroke."""
    line = '<line x1="0" y1="0" x2="10" y2="5" {}/>'
    filled = '<rect width="9" height="9" style="fill:#fff;stroke:none"/><circle r="4"/>'
    style = "<style>.wall {stroke: red}</style>"
    for strokes in (line.format('stroke="red"'), f"<g stroke='red'>{line.format('')}</g>",
                    style + line.format('class="wall"')):  # fmt: skip
        assert len(read_svg(written(tmp_path / "a.svg", filled + strokes)).ends) == 1
    assert len(read_svg(written(tmp_path / "a.svg", filled + LINE)).ends) > 1 + 4


@pytest.mark.parametrize(
    ("page", "unit"),
    [
        ("", None),
        ('width="50mm"', PIXEL),
        ('viewBox="0 0 50 50"', None),
        ('width="100%" viewBox="0 0 50 50"', None),
        ('width="100" height="50" viewBox="0 0 50 25"', 2 * PIXEL),
        ('width="100mm" height="10mm" viewBox="0 0 50 25"', 0.4e-3),
        ('width="2in" height="100%" viewBox="0 0 50 25"', 50.8e-3 / 50),
        ('width="72pt" viewBox="0 0 72 25"', 25.4e-3 / 72),
    ],
)
def test_the_page_gives_the_unit(tmp_path, page, unit):
    lines = read_svg(written(tmp_path / "a.svg", LINE, page))
    assert lines.unit == pytest.approx(unit)
    assert lines.ends.tolist() == [[[0.0, 0.0], [10.0, -5.0]]]


TENFOLD = [f'<g id="a{k + 1}">' + f'<use xlink:href="#a{k}"/>' * 10 + "</g>" for k in range(6)]


@pytest.mark.parametrize(
    ("inner", "text"),
    [
        ("<g>", "not XML at line 1"),
        ('<g id="a"><use xlink:href="#a"/></g>', "that are used again"),
        (f'<g id="a0">{LINE}</g>{"".join(TENFOLD)}', "that are used again"),
        ("<g>" * 5000 + "</g>" * 5000, "can read"),
    ],
)
def test_damage_and_bombs_are_told(tmp_path, inner, text):
    with pytest.raises(MisfitError, match=text):
        read_svg(written(tmp_path / "a.svg", inner))


def test_a_missing_package_is_told(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "svgelements", None)
    with pytest.raises(MisfitError, match=r"needs the package svgelements: pip install"):
        read_svg(written(tmp_path / "a.svg", LINE))


def test_circles_that_mark_joints_are_left_out_aloud(tmp_path):
    marks = '<circle r="0.5"/><circle cx="10" cy="5" r="0.5"/>'
    lines = read_svg(written(tmp_path / "a.svg", marks + LINE + '<circle cx="10" cy="5" r="9"/>'))
    assert np.abs(lines.ends[1:] - [10.0, -5.0]).max() == pytest.approx(9.0)
    assert len(lines.ends) > 1 + 32
    assert "2 x small circle around the end of a line, a mark of a joint" in lines.notes[0]
