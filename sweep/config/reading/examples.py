"""The configs that come with Crumple: examples that run by name, such as `smoke`."""

from os import PathLike
from pathlib import Path

FOLDER = Path(__file__).parents[3] / "configs"


def examples() -> list[str]:
    """Names of all examples, with their folders, such as `accuracy/crush`."""
    paths = [path.relative_to(FOLDER) for path in FOLDER.rglob("*.toml")]
    return sorted(path.with_suffix("").as_posix() for path in paths)


def find_config(name: str | PathLike[str]) -> Path:
    """The file at this path, or else the example of this name if there is one."""
    path = Path(name)
    if path.is_file() or path.as_posix() not in examples():
        return path
    return FOLDER / f"{path.as_posix()}.toml"
