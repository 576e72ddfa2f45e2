"""Where machine code is kept: a cache that is never stale and never trusted blindly.

Numba's own cache has two faults that would cost results, not only time. It looks at the file of the
compiled function alone, so that an edited callee in another file leaves the old code running: here
the folder is named by a hash of all kernel sources, the versions and the processor. And it trusts
what it reads: here every file ends with a seal, and what does not fit its seal is compiled again.
"""

import atexit
import contextlib
import hashlib
import io
import os
import platform
import shutil
import tempfile
import time
import uuid
from pathlib import Path

import llvmlite
import llvmlite.binding
import numba
import numpy as np
from numba.core import types
from numba.core.caching import FunctionCache, IndexDataCacheFile

from kernels.compile.reference import Reference

FOLDER = "kernels-"  # and the hash of the sources
FOLDERS_KEPT = 8
SECONDS_KEPT = 7 * 24 * 3600.0
SEAL_BYTES = 16
PACKAGE = __name__.rsplit(".", 2)[0] + "."


def fingerprint(sources):
    """Hash (16 hex) of all kernel sources below a folder and of what compiles and runs them."""
    digest = hashlib.blake2b(digest_size=8)
    versions = [numba.__version__, llvmlite.__version__, np.__version__]
    machine = [platform.python_version(), platform.machine(), llvmlite.binding.get_host_cpu_name()]
    digest.update("\0".join(versions + machine).encode())
    for path in sorted(path for path in sources.rglob("*.py") if path.is_file()):
        content, name = path.read_bytes(), path.relative_to(sources).as_posix()
        digest.update(f"\0{name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


def cache_home():
    """CRUMPLE_CACHE_DIR if it is set, else `crumple` in the user's cache directory."""
    chosen = os.environ.get("CRUMPLE_CACHE_DIR")
    if chosen:
        return Path(chosen).absolute()
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "crumple"


def last_used(folder):
    """Time (s) when a process last started on this folder; 0 when it has just been removed."""
    try:
        return folder.stat().st_mtime
    except OSError:
        return 0.0


def prune(home):
    """Remove folders of other sources, but neither the newest nor those used in the last week.

    A process that still runs on a removed folder loses nothing: it makes the folder anew.
    """
    folders = sorted(home.glob(f"{FOLDER}*"), key=last_used, reverse=True)
    for folder in folders[FOLDERS_KEPT:]:
        if last_used(folder) < time.time() - SECONDS_KEPT:
            shutil.rmtree(folder, ignore_errors=True)


def open_cache(sources):
    """Folder for the machine code of these sources; a temporary one if that is not writable."""
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


def seal(content):
    """Digest that a cache file ends with."""
    return hashlib.blake2b(content, digest_size=SEAL_BYTES).digest()


def is_sealed(path):
    """True if the file is there and ends with the digest of what comes before."""
    try:
        content = Path(path).read_bytes()
    except OSError:
        return False
    return content[-SEAL_BYTES:] == seal(content[:-SEAL_BYTES])


def is_of_kernels(kind):
    """Whether what an argument type stands for is in the sources that name the folder: the verbs of
    a named tuple from elsewhere may change, and nobody would see it.
    """
    if isinstance(kind, Reference):
        return is_of_kernels(kind.kind)
    if not isinstance(kind, types.BaseTuple):
        return True
    home = getattr(kind, "instance_class", tuple).__module__
    return home.startswith(("builtins", PACKAGE)) and all(map(is_of_kernels, kind))


class SealedFiles(IndexDataCacheFile):
    """Numba's index and data files, each closed by a seal that is checked before it is unpickled.

    Unsealed files count as absent (numba's pickles end before the seal, so its readers ignore it).
    """

    @contextlib.contextmanager
    def _open_for_write(self, filepath):
        with super()._open_for_write(filepath) as file:
            content = io.BytesIO()
            yield content
            file.write(content.getvalue() + seal(content.getvalue()))

    def _load_index(self):
        return super()._load_index() if is_sealed(self._index_path) else {}

    def _load_data(self, name):
        if not is_sealed(self._data_path(name)):
            raise FileNotFoundError(name)  # which numba answers with a compilation
        return super()._load_data(name)

    def _data_name(self, number):
        # Numbers alone could let two processes that start together store the code of two
        # signatures under one name.
        return super()._data_name(number).replace(".nbc", f"-{uuid.uuid4().hex[:12]}.nbc")


class SealedCache(FunctionCache):
    """Cache of one function. What cannot be read or written costs a compilation, never a result.

    ``kind``: of its code, if there are several.
    """

    def __init__(self, function, kind=""):
        super().__init__(function)
        self._cache_file = SealedFiles(
            cache_path=self._cache_path,
            filename_base=self._impl.filename_base + kind,
            source_stamp=self._impl.locator.get_source_stamp(),
        )

    def load_overload(self, sig, target_context):
        """Kept code for a signature, or None."""
        if not all(map(is_of_kernels, sig)):
            return None
        try:
            return super().load_overload(sig, target_context)
        except Exception:  # noqa: BLE001  (whatever unpickling or linking foreign code can raise)
            return None

    def save_overload(self, sig, data):
        """Keep the code of a signature, if it can be."""
        if not all(map(is_of_kernels, sig)):
            return
        with contextlib.suppress(OSError):  # a full disk, a folder taken away
            super().save_overload(sig, data)


def is_lasting():
    """Return whether what is kept is there for other processes: in no temporary folder."""
    return Path(numba.config.CACHE_DIR).name.startswith(FOLDER)


def _mark(name):
    return Path(numba.config.CACHE_DIR) / f"{name}.warm"


def is_cold(*names):
    """Return whether something may have to be compiled, as none of these was ever warmed up."""
    return not (numba.config.DISABLE_JIT or any(_mark(name).exists() for name in names))


def warmed_up(name):
    """Note that all code of this name is kept."""
    with contextlib.suppress(OSError):
        _mark(name).touch()


numba.config.CACHE_DIR = str(open_cache(Path(__file__).parents[1]))
