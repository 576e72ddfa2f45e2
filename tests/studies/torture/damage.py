"""Damages a results file in many ways, and records how its readers react.

Each damaged copy is read as a whole in a process of its own, which is given up after `PATIENCE`.
"""

from collections import Counter
from contextlib import ExitStack
from hashlib import sha256
from pathlib import Path

import numpy as np

from sweep.report.tables.sheet import Sheet
from sweep.store.hdf5 import About, seal_blocks
from sweep.store.parts import new_part
from sweep.store.read import (
    StoreError,
    open_whole,
    read_attributes,
    read_case,
    read_runs,
    read_summary,
)
from tests.studies.torture.reader import Reader

PATIENCE = 10.0  # seconds
ZEROS = 16  # bytes
TOLD, HARMLESS, SILENT, RAISED, SILENCE = OUTCOMES = (
    "told", "harmless", "silently other", "traceback", "no answer",
)  # fmt: skip
ALLOWED = {TOLD, HARMLESS}


def flip(content: bytearray, at: int, rng: np.random.Generator) -> None:
    """Flip one bit."""
    content[at] ^= 1 << int(rng.integers(8))


def overwrite(content: bytearray, at: int, rng: np.random.Generator) -> None:
    """Write other bytes over a few."""
    content[at : at + ZEROS] = rng.bytes(min(ZEROS, len(content) - at))


def erase(content: bytearray, at: int, _: np.random.Generator) -> None:
    """Write zeros over a few bytes."""
    content[at : at + ZEROS] = bytes(min(ZEROS, len(content) - at))


def truncate(content: bytearray, at: int, _: np.random.Generator) -> None:
    """Cut the end off."""
    del content[at:]


KINDS = {
    "a bit flipped": flip,
    "16 bytes random": overwrite,
    "16 bytes zero": erase,
    "end cut off": truncate,
}


def everything(path: Path) -> str:
    """Digest of all that can be read of a results file."""
    summary, digest = read_summary(path), sha256()
    ids = list(summary["case_id"])
    digest.update(summary.to_csv().encode() + repr(sorted(read_attributes(path).items())).encode())
    for run in read_runs(path, ids):
        digest.update(
            run.history.to_numpy().tobytes() + read_case(path, run.case_id).to_json().encode()
        )
        for name, array in sorted(run.frames.items()):
            digest.update(name.encode() + array.tobytes())
    return digest.hexdigest()


def outcome(path: Path, whole: str) -> str:
    """Reaction of a reader to a file whose digest was `whole`."""
    try:
        return HARMLESS if everything(path) == whole else SILENT
    except StoreError:
        return TOLD
    except Exception:  # noqa: BLE001  (that is what the study looks for)
        return RAISED


def damage(path: Path, count: int, seed: int = 1) -> dict[str, Counter[str]]:
    """How often each kind of damage, `count` times each, had which outcome.

    Half of the damages are in the first sixth of the file, where HDF5 keeps most of its own.
    """
    copy = path.with_name("damaged.h5")
    return _damage(path.read_bytes(), copy, copy, everything(path), (count, seed))


def damage_part(path: Path, folder: Path, count: int, seed: int = 2) -> dict[str, Counter[str]]:
    """The same for a part with the rows of a results file, as a run seals it; in an empty
    folder.
    """
    copy, part = folder / "damaged.h5", new_part(folder / "damaged.h5", 1, 1).path
    part.parent.mkdir()
    with ExitStack() as stack:
        seal_blocks(part, open_whole(path, stack), About(last=1), packed=False)
    counts = _damage(part.read_bytes(), part, copy, everything(copy), (count, seed))
    return {f"part: {name}": found for name, found in counts.items()}


def _damage(
    content: bytes, copy: Path, path: Path, whole: str, how: tuple[int, int]
) -> dict[str, Counter[str]]:
    """Outcomes for damaged copies of some content, which are read under a path.

    whole: digest of the undamaged content. how: count and seed.
    """
    (count, seed), counts = how, {}
    rng = np.random.default_rng(seed)
    with Reader(outcome, PATIENCE, SILENCE) as reader:
        for name, hurt in KINDS.items():
            counts[name] = Counter()
            for number in range(count):
                hurtable = bytearray(content)
                hurt(hurtable, int(rng.integers(len(content) // (6 if number % 2 else 1))), rng)
                copy.write_bytes(hurtable)
                counts[name][reader.outcome(path, whole)] += 1
    copy.unlink()
    return counts


def sheet(counts: dict[str, Counter[str]]) -> Sheet:
    """The table of `damage`."""
    rows = [
        [name, *(str(found[outcome]) for outcome in OUTCOMES)] for name, found in counts.items()
    ]
    return Sheet(
        "Damaged copies of a results file, and of a part of one", ["damage", *OUTCOMES], rows
    )


def is_sound(counts: dict[str, Counter[str]]) -> bool:
    """Whether every damage was reported, or changed no data that are read."""
    return all(found.keys() <= ALLOWED for found in counts.values())
