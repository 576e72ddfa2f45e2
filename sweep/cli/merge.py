"""The verb `merge`: combines the results of several runs of one sweep, such as a job array, in one
file.
"""

from collections.abc import Iterable
from pathlib import Path

from sweep.cli.refusals import ArgumentError
from sweep.cli.terminal import hint, say
from sweep.numbers import counted
from sweep.store.read import exists, read_attributes, read_summary
from sweep.store.write import Writer


def merge(out: str, files: list[str]) -> None:
    """Copy the rows of ``files`` into the results file ``out``, which may exist."""
    if missing := [file for file in files if not exists(file)]:
        raise ArgumentError(f"{missing[0]} does not exist")
    if any(Path(file).resolve() == Path(out).resolve() for file in files):
        raise ArgumentError(f"{out} is to be written, and cannot be one of the files that are read")
    about = read_attributes(files[0])
    if others := {read_attributes(file).get("config") for file in files} - {about.get("config")}:
        hint([f"the files are of {len(others) + 1} configs; {out} keeps the config of {files[0]}"])
    merged = [*files, out] if exists(out) else files
    parts, count = _parts(str(read_attributes(file).get("part", "")) for file in merged)
    about = {name: value for name, value in about.items() if name != "part"}
    if len(parts) < count:
        about["part"] = ", ".join(parts)
        hint([f"these files have {about['part']} of a sweep of {count} parts"])
    with Writer(out, attributes=about) as writer:
        writer.fold(files=files)
    say(f"{out}: {counted(len(read_summary(out)), 'case')}")
    run = f"      crumple run CONFIG --out {out}: what is missing, if anything"
    hint([f"next: crumple rank {out}", run])


def _parts(texts: Iterable[str]) -> tuple[list[str], int]:
    """The parts of a sweep, such as "1/3", that files have, in their order, and the number of all
    parts. texts: the attribute `part` of each file; a file without it may have the whole sweep.
    """
    parts: set[str] = set()
    for text in texts:
        if not text:
            return [], 0
        parts |= {*text.split(", ")}
    numbers = {part: [int(number) for number in part.split("/")] for part in parts}
    return sorted(parts, key=numbers.__getitem__), max(count for _, count in numbers.values())
