"""Time limits: one thread watches all that runs in a process.

A thread for each case would let the case wait for milliseconds until a busy core has started it.
"""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

LONGEST = 3600.0  # seconds without a look


class Watch:
    """Calls what is to be done when a block has taken longer than it may."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._limits: dict[object, tuple[float, Callable[[], None]]] = {}
        self._thread: threading.Thread | None = None
        self._next = 0.0  # time of the next look

    @contextmanager
    def limit(self, seconds: float, expire: Callable[[], None]) -> Iterator[None]:
        """Let another thread call `expire` if the block takes longer than that."""
        key, due = object(), time.monotonic() + seconds
        with self._changed:
            self._limits[key] = due, expire
            if self._thread is None or not self._thread.is_alive():  # as after a fork
                self._thread = threading.Thread(target=self._look, daemon=True)
                self._thread.start()
            elif due < self._next:
                self._changed.notify()
        try:
            yield
        finally:
            with self._changed:
                self._limits.pop(key, None)

    def _look(self) -> None:
        with self._changed:
            while True:
                now = time.monotonic()
                for key in [key for key, (due, _) in self._limits.items() if due <= now]:
                    self._limits.pop(key)[1]()
                self._next = min([now + LONGEST, *(due for due, _ in self._limits.values())])
                self._changed.wait(self._next - now)
