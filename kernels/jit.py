"""How kernels are compiled and where the machine code is kept: the only file that knows Numba.

``@jit`` is for arithmetic; ``@jit_exact`` keeps every rounding as written, for collision detection,
distances, tests of a sign or a pivot, and sums of the energy book (fast-math destroys exact zeros
and compensated sums); ``@jit_owning`` is exact too and may make arrays. All release the GIL, so
that threads run side by side.

Numba's own cache has two faults that would cost results, not only time. It looks at the file of the
compiled function alone, so that an edited callee in another file leaves the old code running: here
the folder is named by a hash of all kernel sources, the versions and the processor. And it trusts
what it reads: here every file ends with a seal, and what does not fit its seal is compiled again.
"""

import atexit
import contextlib
import functools
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
from numba.core.caching import FunctionCache, IndexDataCacheFile

FOLDERS_KEPT = 8
SECONDS_KEPT = 7 * 24 * 3600.0
SEAL_BYTES = 16


def fingerprint(sources):
    """Hash (16 hex) of all kernel sources in a folder and of what compiles and runs them."""
    digest = hashlib.blake2b(digest_size=8)
    versions = [numba.__version__, llvmlite.__version__, np.__version__]
    machine = [platform.python_version(), platform.machine(), llvmlite.binding.get_host_cpu_name()]
    digest.update("\0".join(versions + machine).encode())
    for path in sorted(path for path in sources.glob("*.py") if path.is_file()):
        content = path.read_bytes()
        digest.update(f"\0{path.name}\0{len(content)}\0".encode() + content)
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
    folders = sorted(home.glob("kernels-*"), key=last_used, reverse=True)
    for folder in folders[FOLDERS_KEPT:]:
        if last_used(folder) < time.time() - SECONDS_KEPT:
            shutil.rmtree(folder, ignore_errors=True)


def open_cache(sources):
    """Folder for the machine code of these sources; a temporary one if that is not writable."""
    try:
        home = cache_home()
        folder = home / f"kernels-{fingerprint(sources)}"
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
    """Cache of one function. What cannot be read or written costs a compilation, never a result."""

    def __init__(self, function, kind):
        super().__init__(function)
        self._cache_file = SealedFiles(
            cache_path=self._cache_path,
            filename_base=f"{self._impl.filename_base}-{kind}",
            source_stamp=self._impl.locator.get_source_stamp(),
        )

    def load_overload(self, sig, target_context):
        """Kept code for a signature, or None."""
        try:
            return super().load_overload(sig, target_context)
        except Exception:  # noqa: BLE001  (whatever unpickling or linking foreign code can raise)
            return None

    def save_overload(self, sig, data):
        """Keep the code of a signature, if it can be."""
        with contextlib.suppress(OSError):  # a full disk, a folder taken away
            super().save_overload(sig, data)


class Kernel:
    """A function for other kernels to call.

    A wrapper for calls from Python costs as much to compile as the function itself: it is made at
    the first such call, as `entry`.
    """

    def __init__(self, function, options):
        bare = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        self._inner = _dispatcher(function, options | bare, "bare")
        self._numba_type_ = numba.types.Dispatcher(self._inner)
        self.options = options
        functools.update_wrapper(self, function)

    @functools.cached_property
    def entry(self):
        """The dispatcher of the function with its wrapper."""
        return _dispatcher(self.__wrapped__, self.options, "entry")

    def __call__(self, *args):
        """Call it from Python."""
        return self.entry(*args)

    def __getattr__(self, name):
        return getattr(self._inner, name)


def _dispatcher(function, options, kind):
    """Numba's dispatcher, with the sealed cache.

    A constant argument gets no version of its own, which Numba would compile for every one.
    """
    dispatcher = numba.njit(nogil=True, error_model="numpy", **options)(function)
    typed = dispatcher.get_call_template
    dispatcher.get_call_template = lambda args, kws: typed(
        [numba.types.unliteral(a) for a in args], kws
    )
    dispatcher._cache = SealedCache(function, kind)
    return dispatcher


def compiler(fastmath, owning=False, inline="never"):
    """Decorator that compiles a function for the argument types it meets, and keeps the code.

    Without ``owning`` the code counts no references, which costs four times the arithmetic of an
    assembly; such a function may read and fill arrays but must not make or return any. ``inline``
    writes it out in its caller, for the few that would otherwise be optimised at every level.
    """
    options = {"fastmath": fastmath, "_nrt": owning, "inline": inline}

    def decorate(function):
        if numba.config.DISABLE_JIT:
            return function
        return Kernel(function, options)

    return decorate


numba.config.CACHE_DIR = str(open_cache(Path(__file__).parent))


def is_cold():
    """Return whether nothing is kept yet for these sources: the first call will compile."""
    return not any(Path(numba.config.CACHE_DIR).rglob("*.nbi"))


jit = compiler({"contract", "reassoc", "nsz", "arcp"})
jit_exact = compiler(False)
jit_owning = compiler(False, owning=True)
jit_inlined = compiler(False, owning=True, inline="always")
