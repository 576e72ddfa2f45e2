"""Numba's cache of one function, with a check of every file that is read.

Numba trusts the files that it reads. Here every file ends with a seal, a digest of its content: if
they do not agree, the function is compiled again.
"""

import contextlib
import hashlib
import io
import uuid
from pathlib import Path

from numba.core.caching import FunctionCache, IndexDataCacheFile

SEAL_BYTES = 16


def seal(content):
    """Return the digest that a cache file ends with."""
    return hashlib.blake2b(content, digest_size=SEAL_BYTES).digest()


def is_sealed(path):
    """Return whether the file exists and ends with the digest of the content before it."""
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
    """Cache of one function. A file that cannot be read or written costs a compilation, never a
    result.
    """

    def __init__(self, function):
        super().__init__(function)
        self._cache_file = SealedFiles(
            cache_path=self._cache_path,
            filename_base=self._impl.filename_base,
            source_stamp=self._impl.locator.get_source_stamp(),
        )

    def load_overload(self, sig, target_context):
        """Return the cached code for a signature, or None."""
        try:
            return super().load_overload(sig, target_context)
        except Exception:  # noqa: BLE001  (whatever unpickling or linking foreign code can raise)
            return None

    def save_overload(self, sig, data):
        """Cache the code of a signature, if the disk has room for it."""
        with contextlib.suppress(OSError):
            super().save_overload(sig, data)
