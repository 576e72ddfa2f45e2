"""Small drawings: their size, their direction, and omitted drawings."""

from xml.etree import ElementTree

from sweep.report import thumbnail as module
from sweep.report.thumbnail import SIZE, thumbnail
from tests.support.results.specimens import squeezed_cell, tube


def drawn(frames):
    svg = ElementTree.fromstring(thumbnail(frames))
    return svg.attrib | svg[0].attrib


def test_the_shape_at_rest_is_drawn_upright():
    """A cell of 10 mm with walls of 1 mm; y of an SVG points down."""
    found = drawn(squeezed_cell())
    assert found["d"] == "M0 0l1000 0 0 1000 -1000 0 0 -1000"
    assert found["viewBox"] == "0 0 11.0 11.0"
    assert found["width"] == found["height"] == str(SIZE)
    assert found["transform"] == "matrix(.01 0 0 -.01 0.5 10.5)"


def test_of_a_print_that_stands_its_plan_is_drawn():
    assert drawn(tube())["d"] == "M0 0l100 0 0 100 -100 0 0 -100"


def test_nothing_and_too_much_are_left_out(monkeypatch):
    assert thumbnail({}) == ""
    monkeypatch.setattr(module, "MOST", 30)
    assert thumbnail(squeezed_cell()) == ""
