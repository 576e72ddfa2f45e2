"""Plates that move on the page: its program draws them as `shaded.faces` does."""

import json
from base64 import b64decode
from pathlib import Path

import numpy as np
import pytest
from py_mini_racer import MiniRacer

from sweep.report.figures import shaded
from sweep.report.page import gather
from sweep.report.page.trails import moving_faces
from tests.support.results.specimens import tube

SCRIPT = Path(gather.__file__).with_name("plots.js")
LAID = np.array([[0.0, 0.0], [1e-3, 0.0]])
ASK = """
const told = (moving, table) =>
  faces(moving, (node) => table[node]).map(({ corners, shade }) => ({ corners, shade }));
"""


def read(moving):
    """Positions (f, n, 3) in mm."""
    counts = np.frombuffer(b64decode(moving["position"]), "<u2").reshape(-1, moving["nodes"], 3)
    return np.array(moving["low"]) + moving["step"] * counts


def on_the_page(moving, frame):
    with MiniRacer() as engine:
        engine.eval(SCRIPT.read_text("utf-8") + ASK)
        table = read(moving)[frame].tolist()
        text = engine.eval(f"JSON.stringify(told({json.dumps(moving)}, {json.dumps(table)}))")
    return json.loads(text)


def crumpled():
    """A tube whose nodes are moved at random, with one more that no quad has."""
    frames = tube()
    position = np.concatenate([np.zeros((3, 1, 3)), frames["position_m"]], axis=1)
    moved = 2e-4 * np.random.default_rng(3).normal(size=position.shape)
    return {**frames, "position_m": position + moved, "quads": frames["quads"] + 1}


def test_positions_can_be_read_back_and_unused_nodes_are_left_out():
    frames = crumpled()
    moving = moving_faces(frames, [1.0, 2.0, None], LAID[:1])
    np.testing.assert_allclose(read(moving), 1e3 * frames["position_m"][:, 1:], atol=1e-4)
    assert (moving["force"], moving["plates"][2]) == ([1.0, 2.0, None], [0.0, 1600.0])


@pytest.mark.parametrize("frame", [0, 2])
def test_the_page_sees_the_faces_that_pictures_have(frame):
    moving = moving_faces(crumpled(), [None] * 3, LAID)
    quads, position = np.array(moving["quads"]), read(moving)[frame]
    both = np.concatenate([position, position + np.array([1.0, 0.0, 0.0])])
    expected = shaded.faces(both, np.concatenate([quads, quads + len(position)]))
    found = on_the_page(moving, frame)
    np.testing.assert_allclose([face["corners"] for face in found], expected.corners, atol=1e-9)
    np.testing.assert_allclose([face["shade"] for face in found], expected.shades, atol=1e-9)


def test_colours_go_from_the_first_to_the_last_and_platens_span_all_pieces():
    moving = moving_faces(tube(), [None] * 3, LAID)
    assert np.ptp(np.array(moving["ring"]), axis=0) == pytest.approx([2.2, 1.2])
    with MiniRacer() as engine:
        engine.eval(SCRIPT.read_text("utf-8"))
        colours = json.dumps(moving["colours"])
        found = [engine.eval(f"shadeColour({colours}, {shade})") for shade in (0, 0.5, 1)]
    assert found == ["rgb(22,40,60)", "rgb(85,120,155)", "rgb(223,233,243)"]
