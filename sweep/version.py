"""Versions of installed packages. The version of Crumple is stated only in pyproject.toml."""

from importlib.metadata import PackageNotFoundError, version


def installed_version(package: str) -> str:
    """Version of a package; "unknown" if it is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"


__version__ = installed_version("crumple")
