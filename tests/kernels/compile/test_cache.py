"""The folder of machine code: its name, its place, and how many are kept."""

import os
import shutil
import time

import pytest

from kernels.compile.cache import FOLDERS_KEPT, fingerprint, open_cache, prune


@pytest.fixture
def package(tmp_path):
    """Folder with the sources of two modules."""
    folder = tmp_path / "kernels"
    folder.mkdir()
    (folder / "callee.py").write_text("OFFSET = 1.0")
    (folder / "caller.py").write_text("from kernels.callee import OFFSET")
    return folder


def test_fingerprint_follows_every_source(package):
    before = fingerprint(package)
    assert fingerprint(package) == before
    assert fingerprint(shutil.copytree(package, package.with_name("copy"))) != before

    (package / "caller.py").rename(package / "renamed.py")
    renamed = fingerprint(package)
    (package / "callee.py").write_text("")
    assert len({before, renamed, fingerprint(package)}) == 3


def test_cache_folder_is_where_it_was_asked_for(package, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    monkeypatch.delenv("CRUMPLE_CACHE_DIR", raising=False)
    assert open_cache(package).parent == tmp_path / "xdg" / "crumple"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert open_cache(package).parent == tmp_path / ".cache" / "crumple"
    monkeypatch.setenv("CRUMPLE_CACHE_DIR", str(tmp_path / "chosen"))
    assert open_cache(package).parent == tmp_path / "chosen"


def test_cache_folder_is_temporary_where_none_can_be_written(package, monkeypatch, tmp_path):
    (tmp_path / "file").touch()
    monkeypatch.setenv("CRUMPLE_CACHE_DIR", str(tmp_path / "file"))
    folder = open_cache(package)
    assert folder.is_dir()
    assert tmp_path not in folder.parents
    folder.rmdir()


def test_prune_keeps_what_is_new_or_in_use(tmp_path):
    ages = {f"kernels-{days:02d}": days for days in range(12)} | {"other": 99}
    for name, days in ages.items():
        (tmp_path / name).mkdir()
        os.utime(tmp_path / name, (time.time() - 86400 * days - 60,) * 2)
    prune(tmp_path)
    stay = [f"kernels-{days:02d}" for days in range(FOLDERS_KEPT)] + ["other"]
    assert sorted(path.name for path in tmp_path.iterdir()) == stay

    for number in range(FOLDERS_KEPT):
        (tmp_path / f"kernels-just-used-{number}").mkdir()
    prune(tmp_path)
    assert not (tmp_path / "kernels-07").exists()
    assert (tmp_path / "kernels-06").exists()
