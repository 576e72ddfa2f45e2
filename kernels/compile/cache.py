"""The cache folder of machine code, named by a hash of all kernel sources.

Numba's own cache checks only the file of the compiled function, so that an edited callee in another
file leaves the old code running. Here the folder is named by a hash of all kernel sources, their
place, the compiler, the versions and the processor: a change of any of them leads to another
folder. The place counts because Numba keeps code by path: a second checkout compiles its own.
"""

import atexit
import contextlib
import hashlib
import os
import platform
import shutil
import tempfile
import time
from pathlib import Path

import llvmlite
import llvmlite.binding
import numba
import numpy as np
from platformdirs import user_cache_path

from kernels.compile.choice import compiler

FOLDER = "kernels-"  # and the hash of the sources
FOLDERS_KEPT = 8
SECONDS_KEPT = 7 * 24 * 3600.0


def fingerprint(sources):
    """Return the hash (16 hex digits) of the place of the kernel sources, their text, the compiler,
    the versions and the processor.
    """
    digest = hashlib.blake2b(str(sources.absolute()).encode(), digest_size=8)
    versions = [compiler(), numba.__version__, llvmlite.__version__, np.__version__]
    machine = [platform.python_version(), platform.machine(), llvmlite.binding.get_host_cpu_name()]
    digest.update("\0".join(versions + machine).encode())
    for path in sorted(path for path in sources.rglob("*.py") if path.is_file()):
        content, name = path.read_bytes(), path.relative_to(sources).as_posix()
        digest.update(f"\0{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


def cache_home():
    """Return CRUMPLE_CACHE_DIR if it is set, else the system's cache folder for programs."""
    if chosen := os.environ.get("CRUMPLE_CACHE_DIR"):
        return Path(chosen).absolute()
    return user_cache_path("crumple", appauthor=False)


def last_used(folder):
    """Return the time (s) at which a process last started with this folder; 0 if it has just been
    removed.
    """
    try:
        return folder.stat().st_mtime
    except OSError:
        return 0.0


def prune(home):
    """Remove the folders of other sources, except the newest and those used in the last week.

    A process that still uses a removed folder loses nothing: it creates the folder again.
    """
    folders = sorted(home.glob(f"{FOLDER}*"), key=last_used, reverse=True)
    for folder in folders[FOLDERS_KEPT:]:
        if last_used(folder) < time.time() - SECONDS_KEPT:
            shutil.rmtree(folder, ignore_errors=True)


def open_cache(sources):
    """Return the folder for the machine code of these sources, or a temporary one if it is not
    writable.
    """
    try:
        home = cache_home()
        folder = home / f"{FOLDER}{fingerprint(sources)}"
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
        os.utime(folder)
    except (OSError, RuntimeError):  # not writable; a user without a home
        folder = Path(tempfile.mkdtemp(prefix="crumple-kernels-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    else:
        prune(home)
    return folder


def is_lasting():
    """Return whether other processes can use the cached code, which a temporary folder would not
    keep.
    """
    return Path(numba.config.CACHE_DIR).name.startswith(FOLDER)


def _mark(name):
    return Path(numba.config.CACHE_DIR) / f"{name}.warm"


def is_cold(name):
    """Return whether some code of this name may have to be compiled, as it was never warmed up."""
    return not (numba.config.DISABLE_JIT or _mark(name).exists())


def warmed_up(name):
    """Record that all code of this name is in the cache."""
    with contextlib.suppress(OSError):
        _mark(name).touch()


numba.config.CACHE_DIR = str(open_cache(Path(__file__).parents[1]))
