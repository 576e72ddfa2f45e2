"""Mutates inputs of all kinds, and records how the command line reacts.

An input may be used, or be refused in at most `LINES` lines, after at most `SECONDS` of processor
time. A call that gives no answer at all is given up after `PATIENCE`, since other programs may run.
"""

import contextlib
import io
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from sweep.__main__ import main
from sweep.report.tables.sheet import Sheet
from tests.studies.torture.reader import Reader
from tests.support.cluster import ROOT

SECONDS, PATIENCE, LINES = 5.0, 60.0, 12
USED, REFUSED, LONG, SLOW, RAISED = OUTCOMES = (
    "used", "refused", "more than 12 lines", "beyond 5 s", "traceback",
)  # fmt: skip
ALLOWED = {USED, REFUSED}
TOKENS = (
    *(b'"', b"'", b"[", b"]", b"{", b"}", b"=", b",", b"\n", b"\0", b"\xff", b"\xef\xbb\xbf"),
    *(b"nan", b"inf", b"-1", b"0", b"1e999", b"9" * 400, b"-0.0", b"true", b"mm", b"%", b"\x1b[2J"),
    *(b"[bold]", b"../../x", b"[grid]\n", b"\xc3\xa9", b"=1+1", b"1e-320", b'"0 mm"', b"#"),
)
PART = ("--part", "1000000/1000000")  # reads and expands all of a config, and runs none of it
LEFT_OUT = ("extreme", "search", "custom", "drawn")  # long, of another verb, of files beside them
NO_PART = b"the sweep has only"
STRIP = ("--gauge", "33 mm", "--area", "8 mm^2", "--density", "1210 kg/m^3", "--units", "force=N")


class Input(NamedTuple):
    """A file that a verb reads: its name, its content, and how the verb is called in its folder.

    beside: a file that names it, with its content.
    """

    name: str
    content: bytes
    words: tuple[str, ...]
    beside: tuple[str, str] | None = None


def inputs(results: Path) -> dict[str, list[Input]]:
    """The inputs to mutate, by kind. results: a results file."""
    configs = ROOT / "configs"
    tomls = [path for path in sorted(configs.glob("*.toml")) if path.stem not in LEFT_OUT]
    of_files = {path.stem: path.read_text("utf-8") for path in configs.glob("*.toml")}
    material = '[material]\nname = "m.csv"\n'
    of_part = ("run", "c.toml", *PART)
    return {
        "configs": [Input("c.toml", path.read_bytes(), of_part) for path in tomls],
        "structures": [
            Input(file, (configs / file).read_bytes(), of_part, ("c.toml", of_files[name]))
            for name, file in (("custom", "custom.json"), ("drawn", "drawn.csv"))
        ],
        "materials": [
            Input("m.csv", path.read_bytes(), of_part, ("c.toml", material))
            for path in sorted((configs / "materials").glob("*.csv"))
        ],
        "tests of strips": [
            Input("t.csv", strip(), ("materials", "fit", "t.csv", "--out", "m.csv", *STRIP))
        ],
        "results": [Input("r.h5", results.read_bytes(), ("status", "r.h5"))],
    }


def strip() -> bytes:
    """A strip that is pulled, held and let go, as a testing machine writes it."""
    time_s = np.linspace(0.0, 60.0, 61)
    way = np.interp(time_s, [0.0, 30.0, 40.0, 60.0], [0.0, 30.0, 30.0, 5.0])
    force = 60.0 * (1.0 - np.exp(-way / 15.0))
    rows = [f"{t:g},{u:.4f},{f:.4f}" for t, u, f in zip(time_s, way, force, strict=True)]
    return "\n".join(["time (s),displacement (mm),force (N)", *rows, ""]).encode()


def mutated(content: bytes, rng: np.random.Generator) -> bytes:
    """A content with up to four changes: bytes or lines less, more, other or in another place."""
    for _ in range(int(rng.integers(1, 5))):
        at = int(rng.integers(len(content) + 1))
        end = at + int(rng.integers(1, 20))
        lines = content.splitlines(keepends=True) or [b""]
        line = lines[int(rng.integers(len(lines)))]
        token = TOKENS[int(rng.integers(len(TOKENS)))]
        content = [
            content[:at] + token + content[at:],
            content[:at] + token + content[end:],
            content[:at] + content[end:],
            content[:at] + line + content[at:],
            content.replace(line, b"", 1),
            content.replace(line, line + line, 1),
            content[:at],
            content[:at] + rng.bytes(3) + content[at + 3 :],
        ][int(rng.integers(8))]
    return content


def outcome(folder: Path, words: tuple[str, ...]) -> str:
    """Reaction of the command line to words, in a folder; notes on accepted input may be longer."""
    said, started = io.TextIOWrapper(io.BytesIO()), time.process_time()
    with (
        contextlib.chdir(folder),
        contextlib.redirect_stderr(said),
        contextlib.redirect_stdout(io.TextIOWrapper(io.BytesIO())),
    ):
        try:
            status: object = main(words)
        except SystemExit as stop:
            status = stop.code
        except Exception:  # noqa: BLE001  (that is what the study looks for)
            return RAISED
    said.flush()
    if time.process_time() - started > SECONDS:
        return SLOW
    if status == 0 or NO_PART in said.buffer.getvalue():
        return USED
    return LONG if said.buffer.getvalue().count(b"\n") > LINES else REFUSED


def fuzz(
    folder: Path, results: Path, count: int, found: Callable[[str, Path], None], seed: int = 1
) -> dict[str, Counter[str]]:
    """How often inputs of each kind, `count` in all, had which outcome.

    found: is called with each outcome that is not allowed, and its file.
    """
    rng, counts, kinds = np.random.default_rng(seed), {}, inputs(results)
    with Reader(outcome, PATIENCE, SLOW) as reader:
        for kind, seeds in kinds.items():
            counts[kind] = Counter()
            for number in range(count // len(kinds)):
                given = seeds[number % len(seeds)]
                (folder / given.name).write_bytes(mutated(given.content, rng))
                if given.beside:
                    (folder / given.beside[0]).write_text(given.beside[1], "utf-8")
                what = reader.outcome(folder, given.words)
                counts[kind][what] += 1
                if what not in ALLOWED:
                    found(what, folder / given.name)
    return counts


def sheet(counts: dict[str, Counter[str]]) -> Sheet:
    """The table of `fuzz`."""
    rows = [[kind, *(str(each[outcome]) for outcome in OUTCOMES)] for kind, each in counts.items()]
    return Sheet("Mutated inputs", ["inputs", *OUTCOMES], rows)


def is_sound(counts: dict[str, Counter[str]]) -> bool:
    """Whether every input was used or refused, in time and briefly."""
    return all(each.keys() <= ALLOWED for each in counts.values())
