"""Time limits: one thread watches all cases that run in a process.

`simulate` lets it set `control[0]`, which Newton's method reads before each evaluation.

With a thread per case, every case would wait some milliseconds until a busy core starts its thread.
"""

import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

IDLE = 10.0  # seconds without a limit after which the thread ends


class Watch:
    """Calls a function if a block of code takes longer than its limit."""

    def __init__(self) -> None:
        self._clear()

    def _clear(self) -> None:
        self._process = os.getpid()
        self._changed = threading.Condition()
        self._limits: dict[object, tuple[float, Callable[[], None]]] = {}
        self._thread: threading.Thread | None = None
        self._next = 0.0  # time of the next check

    @contextmanager
    def limit(self, seconds: float, expire: Callable[[], None]) -> Iterator[None]:
        """Call `expire`, which must not raise, from another thread if the block takes longer."""
        if self._process != os.getpid():  # forked: the thread belongs to the parent process
            self._clear()
        key, due = object(), time.monotonic() + seconds
        try:
            with self._changed:
                self._limits[key] = due, expire
                if self._thread is None:
                    thread = threading.Thread(target=self._watch, daemon=True)
                    thread.start()
                    self._thread = thread
                elif due < self._next:
                    self._changed.notify()
            yield
        finally:
            with self._changed:
                self._limits.pop(key, None)

    def _watch(self) -> None:
        with self._changed:
            while True:
                now = time.monotonic()
                for key in [key for key, (due, _) in self._limits.items() if due <= now]:
                    self._limits.pop(key)[1]()
                self._next = min([now + IDLE, *(due for due, _ in self._limits.values())])
                self._changed.wait(self._next - now)
                if not self._limits and time.monotonic() >= self._next:
                    self._thread = None
                    return


WATCH = Watch()
