"""The notebook of docs/: its cells run, and print the stored outputs."""

import re
from base64 import b64decode

import pytest

from tests.support.notebook import cells, executed
from tests.support.readme import NUMBER, ROOT

PATH = ROOT / "docs/notebook.ipynb"
CODE = [cell for cell in cells(PATH) if cell["cell_type"] == "code"]
TAG = re.compile(r"<[^>]*>")
LARGEST = 150_000  # bytes


@pytest.fixture(scope="module")
def outputs(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("notebook"))
        return executed(CODE)


def text_of(output, kind):
    text = "".join(output["text"] if kind == "stdout" else output["data"][kind])
    return TAG.sub(" ", text)


def kinds(output):
    return ["stdout"] if output["output_type"] == "stream" else list(output["data"])


@pytest.mark.parametrize("k", range(len(CODE)))
def test_cells_show_what_is_stored(outputs, k):
    stored, now = CODE[k]["outputs"], outputs[k]
    assert [kinds(output) for output in now] == [kinds(output) for output in stored]
    for one, other in zip(stored, now, strict=True):
        for kind in kinds(one):
            if kind == "image/png":
                assert b64decode(other["data"][kind]).startswith(b"\x89PNG")
                continue
            told, shown = text_of(one, kind), text_of(other, kind)
            assert re.sub(NUMBER, "#", told).split() == re.sub(NUMBER, "#", shown).split()
            numbers = [[float(n) for n in re.findall(NUMBER, text)] for text in (told, shown)]
            assert numbers[1] == pytest.approx(numbers[0], rel=0.01, abs=1e-12)


def test_cells_have_been_executed_in_order():
    assert [cell["execution_count"] for cell in CODE] == [*range(1, len(CODE) + 1)]
    assert sum(bool(cell["outputs"]) for cell in CODE) > 6
    assert PATH.stat().st_size < LARGEST
