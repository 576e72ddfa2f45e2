"""A process for calls of a function; where it gives no answer, another one begins."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from multiprocessing import TimeoutError as Late
from multiprocessing import get_context


class Reader(AbstractContextManager["Reader"]):
    """Calls of a function of a module, whose value is `silence` after `patience` (s)."""

    def __init__(self, function: Callable[..., str], patience: float, silence: str) -> None:
        self._function, self._patience, self._silence = function, patience, silence

    def __enter__(self) -> "Reader":
        self._begin()
        return self

    def __exit__(self, *_: object) -> None:
        self._pool.terminate()

    def outcome(self, *arguments: object) -> str:
        """The value of the function."""
        try:
            return self._pool.apply_async(self._function, arguments).get(self._patience)
        except Late:
            self._pool.terminate()
            self._begin()
            return self._silence

    def _begin(self) -> None:
        """Start a process; its imports are not timed."""
        self._pool = get_context("spawn").Pool(1)
        self._pool.apply(repr, (self._function,))
