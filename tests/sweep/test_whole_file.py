"""Files that are written as a whole or not at all."""

import pytest

from sweep.whole_file import whole, write_whole


def begin(path):
    """Write half of a file."""
    with whole(path) as file:
        file.write_text("half")
        raise OSError("the disk is full")


def test_a_text_replaces_the_old_one_and_its_lines_end_alike(tmp_path):
    path = tmp_path / "new" / "table.csv"
    for text in ("a,b\n", "Ü\n1\n"):
        assert write_whole(path, text) == path
        assert path.read_bytes() == text.encode()
    assert [*path.parent.iterdir()] == [path]


def test_an_interrupted_file_leaves_the_old_one_and_no_trace(tmp_path):
    path = write_whole(tmp_path / "table.csv", "old")
    for unwritten in (path, tmp_path / "new" / "deep" / "picture.png"):
        with pytest.raises(OSError, match="full"):
            begin(unwritten)
    assert [*tmp_path.rglob("*")] == [path]
    assert path.read_text() == "old"


def test_a_link_leads_to_the_new_file(tmp_path):
    path, link = write_whole(tmp_path / "table.csv", "old"), tmp_path / "link.csv"
    link.symlink_to(path)
    write_whole(link, "new")
    assert link.is_symlink()
    assert path.read_text() == "new"
