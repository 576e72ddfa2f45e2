"""Keys by their names in the last release, which still work in this one, with a warning."""

import warnings
from typing import Any

from sweep.config.case import TABLES

RENAMED = {"solver.hinges": ("solver.element", {"exact_beam": "cubic"})}
"""The present key of an old one, and its values that have another name now."""


def present(document: dict[str, Any]) -> dict[str, Any]:
    """A document of TOML with the present names of all keys.

    An old key beside its present one is left as it is, for the reader to refuse.
    """
    return {
        name: _present(value, f"{name}." if name in TABLES else "")
        for name, value in document.items()
    }


def _present(value: Any, prefix: str) -> Any:
    if isinstance(value, list):
        return [_present(item, prefix) if isinstance(item, dict) else item for item in value]
    if not isinstance(value, dict):
        return value
    found: dict[str, Any] = {}
    for name, inner in value.items():
        old = f"{prefix}{name}"
        key, values = RENAMED.get(old, ("", {}))
        if key and key.removeprefix(prefix) not in value:
            warnings.warn(_sentence(old), FutureWarning, stacklevel=2)
            found[key.removeprefix(prefix)] = _translated(inner, values)
        else:
            found[name] = _present(inner, f"{old}.")
    return found


def _translated(value: Any, values: dict[str, str]) -> Any:
    if isinstance(value, list):
        return [_translated(item, values) for item in value]
    return values.get(value, value) if isinstance(value, str) else value


def _sentence(old: str) -> str:
    key, values = RENAMED[old]
    others = ", ".join(f'"{one}" is now "{other}"' for one, other in values.items())
    return f"{old} is now {key}, and {others}; the old names end with the next release"
