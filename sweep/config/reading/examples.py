"""The configs that come with Crumple: examples that run by name, such as `smoke`."""

from os import PathLike
from pathlib import Path

FOLDER = Path(__file__).parents[3] / "configs"


def examples() -> list[str]:
    """Names of all examples, with their folders, such as `accuracy/crush`."""
    paths = [path.relative_to(FOLDER) for path in FOLDER.rglob("*.toml")]
    return sorted(path.with_suffix("").as_posix() for path in paths)


def find_config(name: str | PathLike[str]) -> Path:
    """The file at this path, or with this name and the ending .toml, or else the example.

    The name of a results file stands for its config.
    """
    path = Path(name)
    if path.is_file() and path.suffix != ".h5":
        return path
    bare = path.name.removesuffix(".h5") if path.suffix == ".h5" else path.as_posix()
    own = Path(f"{bare}.toml")
    if own.is_file():
        return own
    return FOLDER / own if bare in examples() else path
