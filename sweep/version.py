"""Versions of what is installed; that of Crumple is written in pyproject.toml, and only there."""

from importlib.metadata import PackageNotFoundError, version


def installed_version(package: str) -> str:
    """Version of a package; "unknown" where it is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"


__version__ = installed_version("crumple")
