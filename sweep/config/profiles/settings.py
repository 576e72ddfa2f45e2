"""The settings of a slicer's profile by their names in that slicer, as text.

It reads the .ini of PrusaSlicer and SuperSlicer, flat or a bundle of several presets, the .json of
OrcaSlicer and Bambu Studio, and the project inside a .3mf of either. Profiles may come from
anywhere: a limited number of bytes is unpacked, no path of an archive is used, and a parent is
looked for only by its bare name, in the folder of the profile.
"""

import json
import zipfile
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from sweep.config.faults import MisfitError
from sweep.config.reading.text import foreign_text
from sweep.numbers import text_in

NEEDED = (
    "a profile: .ini of PrusaSlicer or SuperSlicer, .json of OrcaSlicer or Bambu Studio, or a .3mf "
    "project of these"
)
MOST_BYTES = 8_000_000  # most bytes of the settings of a project; one printer takes 100 kB
MOST_ARCHIVE = 512_000_000  # bytes of a .3mf
MOST_ENTRIES = 100_000
INSIDE = {
    "Metadata/project_settings.config": "json",
    "Metadata/Slic3r_PE.config": "ini",
    "Metadata/Slic3r.config": "ini",
}
"""Where OrcaSlicer and Bambu Studio, PrusaSlicer and SuperSlicer keep the settings of a project."""
OF_SUPERSLICER = {"infill_extrusion_spacing", "infill_dense", "fill_smooth_width"}
GENERATIONS = 12  # most generations of parents
BROKEN = (zipfile.BadZipFile, zlib.error, RuntimeError, OSError, EOFError, ValueError, LookupError)
OF_CURA = (
    'of Cura, most of whose values are formulas of the program; write slicer = "cura" with '
    "pattern, infill and line_width"
)
CHOOSE = "name one behind a #, as in profile.ini#NAME, or export it alone (File > Export Config)"


class Settings(NamedTuple):
    """Settings by their names. program: "prusa", "superslicer" or "orca".

    missing: the name of a missing parent, which would set others; or empty. project: whether they
    belong to a project, whose objects may have others.
    """

    program: str
    values: dict[str, str]
    missing: str = ""
    project: bool = False


def read_settings(path: Path, preset: str = "") -> Settings:
    """The settings of a profile; preset: which print profile of a bundle. Raises `MisfitError` with
    the fault of a file.
    """
    if _is_archive(path):
        name, text = _of_project(path)
        if preset:
            raise MisfitError(f'a project has no presets, such as "{preset}"; allowed: no #')
        tables = _of_json(text, None, ()) if INSIDE[name] == "json" else _of_ini(text, "")
        return tables._replace(project=True)
    text = foreign_text(path, NEEDED)
    if text.lstrip().startswith("{"):
        if preset:
            raise MisfitError(f'one profile has no presets, such as "{preset}"; allowed: no #')
        return _of_json(text, path, ())
    return _of_ini(text, preset)


def _is_archive(path: Path) -> bool:
    """Whether a file is a ZIP, as a .3mf is; other files are read, or refused, as text."""
    try:
        with path.open("rb") as file:
            return file.read(4) == b"PK\x03\x04"
    except (OSError, ValueError):
        return False


def _of_project(path: Path) -> tuple[str, str]:
    """The name and the text of the settings in a .3mf."""
    if path.stat().st_size > MOST_ARCHIVE:
        raise MisfitError(f"larger than {text_in(MOST_ARCHIVE, 'MB')}; needed: {NEEDED}")
    try:
        with zipfile.ZipFile(path) as archive:
            entries = archive.namelist()
            if len(entries) > MOST_ENTRIES:
                raise MisfitError(f"an archive of more than {MOST_ENTRIES:,} files")
            name = next((name for name in INSIDE if name in entries), None)
            if name is None:
                wrong = "an archive without the settings of a slicer"
                raise MisfitError(f"{wrong} ({' or '.join(INSIDE)}); needed: {NEEDED}")
            with archive.open(name) as file:
                content = file.read(MOST_BYTES + 1)
    except MisfitError:
        raise
    except BROKEN:
        raise MisfitError(f"a broken archive; needed: {NEEDED}") from None
    if len(content) > MOST_BYTES:
        raise MisfitError(f"its {name} is larger than {text_in(MOST_BYTES, 'MB')}")
    return name, content.decode("utf-8", "replace")


def _of_json(text: str, path: Path | None, children: tuple[str, ...]) -> Settings:
    """The settings of a JSON profile over the settings of its parents in the same folder; path:
    None in a project, which has all of its settings.
    """
    try:
        document = json.loads(text)
    except (ValueError, RecursionError):
        raise MisfitError(f"no JSON, although it begins with a brace; needed: {NEEDED}") from None
    if not isinstance(document, dict):
        raise MisfitError(f"no profile, but a {type(document).__name__}; needed: {NEEDED}")
    texts = {str(name): _text(value) for name, value in document.items()}
    own = {name: text for name, text in texts.items() if text is not None}
    parent = own.get("inherits", "").strip()
    if path is None:
        return Settings("orca", own)
    if not parent or (beside := _beside(path, parent)) is None:
        return Settings("orca", own, parent)
    if parent in children or len(children) == GENERATIONS:
        raise MisfitError(f'its parent "{parent}" has itself as a parent')
    above = _of_json(foreign_text(beside, NEEDED), beside, (*children, parent))
    return Settings("orca", above.values | own, above.missing)


def _beside(path: Path, name: str) -> Path | None:
    """The profile with a name in the folder of another one; None if there is none."""
    if Path(name).name != name or "\\" in name or "\0" in name:
        return None
    beside = path.with_name(f"{name}.json")
    return beside if beside.is_file() else None


def _text(value: Any) -> str | None:
    """A value as text, with the values of several extruders between commas; None for an empty
    list.
    """
    if isinstance(value, list):
        texts = [str(item).strip() for item in value if isinstance(item, str | int | float)]
        return ",".join(texts) if texts else None
    return str(value) if isinstance(value, str | int | float) else None


def _of_ini(text: str, preset: str) -> Settings:
    """The settings of a flat .ini, or of one print profile of a bundle and its printer."""
    sections = _sections(text)
    if "setting_version" in sections.get(("metadata", ""), {}):
        raise MisfitError(OF_CURA)
    program = "superslicer" if _is_superslicer(text, sections) else "prusa"
    prints = {name: own for (kind, name), own in sections.items() if kind == "print"}
    if not prints:
        if preset:
            raise MisfitError(f'no bundle, and so without "{preset}"; allowed: no #')
        return Settings(program, sections.get(("", ""), {}))
    chosen = sections.get(("presets", ""), {})
    name = _profile_name(preset or chosen.get("print", ""), prints)
    printers = {name: own for (kind, name), own in sections.items() if kind == "printer"}
    printer = chosen.get("printer", "")
    if printer not in printers and len(visible := _visible(printers)) == 1:
        printer = visible[0]
    of_printer = _inherited(printer, printers, ()) if printer in printers else {}
    return Settings(program, of_printer | _inherited(name, prints, ()))


def _sections(text: str) -> dict[tuple[str, str], dict[str, str]]:
    """The sections of an .ini by kind and name: ("print", "0.20mm QUALITY"). Settings above the
    first one are in the section ("", ""); a project begins each line with a semicolon.
    """
    sections: dict[tuple[str, str], dict[str, str]] = {}
    now = ("", "")
    for line in text.splitlines():
        text_line = line.strip()
        if text_line.startswith("[") and text_line.endswith("]"):
            kind, _, name = text_line[1:-1].partition(":")
            now = (kind.strip(), name.strip())
            sections.setdefault(now, {})
            continue
        key, equals, value = text_line.removeprefix(";").partition("=")
        if equals and not text_line.startswith("#") and key.strip().isidentifier():
            sections.setdefault(now, {})[key.strip()] = value.strip().strip('"')
    return sections


def _is_superslicer(text: str, sections: Mapping[Any, Mapping[str, str]]) -> bool:
    """Whether SuperSlicer wrote an .ini, in which a percentage of a width refers to the nozzle."""
    own = any(not OF_SUPERSLICER.isdisjoint(section) for section in sections.values())
    return own or "superslicer" in text[:300].lower()


def _profile_name(name: str, prints: Mapping[str, Any]) -> str:
    """The name of the requested print profile."""
    if name in prints:
        return name
    visible = _visible(prints)
    if len(visible) == 1 and not name:
        return visible[0]
    some = ", ".join(f'"{one}"' for one in visible[:4])
    more = f" and {len(visible) - 4} more" if len(visible) > 4 else ""
    wrong = f'without "{name}"' if name else "of several print profiles"
    raise MisfitError(f"a bundle {wrong}; allowed: {some}{more}: {CHOOSE}")


def _visible(presets: Iterable[str]) -> list[str]:
    """The presets that a slicer shows; presets in asterisks, from which others inherit, are
    hidden.
    """
    return [name for name in presets if not (name.startswith("*") and name.endswith("*"))]


def _inherited(
    name: str, presets: Mapping[str, Mapping[str, str]], children: tuple[str, ...]
) -> dict[str, str]:
    """The settings of a preset of a bundle over the settings of its parents; later parents win."""
    if name in children or len(children) == GENERATIONS:
        raise MisfitError(f'its preset "{name}" has itself as a parent')
    own = presets[name]
    values: dict[str, str] = {}
    for parent in filter(None, map(str.strip, own.get("inherits", "").split(";"))):
        if parent in presets:
            values |= _inherited(parent, presets, (*children, name))
    return values | dict(own)
