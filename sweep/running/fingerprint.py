"""Fingerprint of a process, equal in processes that compute the same numbers: source, versions,
compiler.
"""

import hashlib
import platform
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from kernels.compile import choice
from sweep.result import MODEL_VERSION
from sweep.version import installed_version

SOURCES = [Path(file).parents[1] for file in (choice.__file__, __file__)]
PACKAGES = ("numba", "llvmlite", "numpy", "scipy")
NONE = "unknown"

Fingerprint = Mapping[str, str]


class OtherSourceError(Exception):
    """A worker with other source or other versions; the text says what differs."""


@cache
def fingerprint() -> Fingerprint:
    """The fingerprint of this process: name -> hash or version."""
    python = ".".join(platform.python_version_tuple()[:2])
    common = {"source": source_hash(*SOURCES), "model version": str(MODEL_VERSION)}
    common |= {"Python": python, "compiler": choice.compiler()}
    return common | {package: installed_version(package) for package in PACKAGES}


def source_hash(*folders: Path) -> str:
    """Hash (12 hex) of the modules in some folders, and of their names."""
    digest = hashlib.blake2b(digest_size=6)
    for folder in folders:
        for path in sorted(folder.rglob("*.py")):
            content, name = path.read_bytes(), path.relative_to(folder).as_posix()
            digest.update(f"{folder.name}/{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


def differences(theirs: Fingerprint, ours: Fingerprint) -> str:
    """The differences in words; "" if there are none."""
    names = [name for name in ours if theirs.get(name) != ours[name]]
    return ", ".join(f"{name} {theirs.get(name, NONE)} (this run: {ours[name]})" for name in names)


def checked(expected: Fingerprint, task: Callable[..., Any], *arguments: Any) -> Any:
    """The result of a task on a worker, if this process has the fingerprint of the run."""
    if wrong := differences(fingerprint(), expected):
        raise OtherSourceError(wrong)
    return task(*arguments)
