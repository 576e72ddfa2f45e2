"""Numba's cache of one function, with a check of every file that is read.

Numba trusts what it reads. Here every file ends with a seal, a digest of its content: if they do
not agree, the function is compiled again.
"""

import contextlib
import hashlib
import io
import uuid
from pathlib import Path

from numba.core import types
from numba.core.caching import FunctionCache, IndexDataCacheFile

from kernels.compile.reference import Reference

SEAL_BYTES = 16
PACKAGE = __name__.rsplit(".", 3)[0] + "."


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
        """Keep the code of a signature, if it can be.

        It cannot on a full disk, or where numba cannot pickle it: the call from Python of some
        separate kernels.
        """
        if not all(map(is_of_kernels, sig)):
            return
        with contextlib.suppress(OSError, TypeError):
            super().save_overload(sig, data)
