"""The measurements of starts by `make bench`."""

from kernels.compile.cache import cache_home
from sweep.__main__ import main
from sweep.config.case import Case
from sweep.running.warming import real_simulate
from sweep.store.read import read_summary
from tests.studies.bench import starts


def test_a_start_is_a_whole_run_in_a_process_of_its_own(tmp_path):
    first, wall, used = starts.run(cache_home(), tmp_path / "smoke.h5")
    assert 0.0 < first < wall
    assert 0.0 < used < 3.0 * wall  # with two workers
    assert (read_summary(tmp_path / "smoke.h5")["status"] == "converged").all()


def test_starts_find_first_nothing_and_then_what_the_first_has_compiled(monkeypatch):
    folders = []
    monkeypatch.setattr(starts, "run", lambda cache, out: folders.append(cache) or (1.0, 2.0, 3.0))
    found = starts.table()
    assert found.values == {
        (name, column): value
        for name in starts.CACHES
        for column, value in zip(found.columns, (1.0, 2.0, 3.0), strict=True)
    }
    assert len(folders) == 2
    assert len(set(folders)) == 1


def test_code_that_cannot_be_kept_is_told(capsys, monkeypatch):
    monkeypatch.setattr("kernels.compile.cache.is_lasting", lambda: False)
    assert main(["warm"]) == 2
    assert (
        "CRUMPLE_CACHE_DIR, else the user's cache folder, is not a writable folder"
        in capsys.readouterr().err
    )
    monkeypatch.setattr("kernels.compile.cache.is_cold", lambda *_: True)
    monkeypatch.setattr("kernels.compile.cache.warmed_up", lambda _: None)
    real_simulate([Case.of()])
    assert "for this run alone: CRUMPLE_CACHE_DIR, else" in capsys.readouterr().err
