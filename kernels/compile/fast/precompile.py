"""Compiles the kernels of a run before it starts, in several processes at once.

A rehearsal finds out which kernels are called with arguments of which types: a small run in plain
Python. What is compiled is kept (`cache`), where the run itself finds it.
"""

import gc
import os
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from queue import SimpleQueue
from threading import Thread
from types import ModuleType

from numba.core.typing.typeof import Purpose, typeof

from kernels.compile.cache import is_lasting
from kernels.compile.fast.kernel import Kernel, rehearsal
from kernels.compile.fast.outlined import Version, foreseen

PROCESSES = 3  # more would wait for the largest kernel, a march: a third of the whole
PROGRAM = """
import signal, sys
signal.signal(signal.SIGINT, signal.SIG_IGN)
sys.path[:] = {path}
from {home} import help_out
help_out()
"""


class Rehearsal:
    """Runs kernels as plain Python and notes those that would be compiled: what Python calls, and
    what is separate.
    """

    def __init__(self):
        self.noted = {}
        self._inside = False

    def __call__(self, kernel, args):
        """Run a kernel; return what it does."""
        outside, self._inside = not self._inside, True
        try:
            returned = kernel.__wrapped__(*args)
        finally:
            self._inside = not outside
        if outside or kernel.is_separate:
            met = tuple(typeof(value, Purpose.argument) for value in args)
            returns = typeof(returned, Purpose.argument)
            self.noted[Version(kernel.__module__, kernel.__name__, met, returns)] = kernel
        return returned


def rehearse(run):
    """Return the versions of kernels that ``run()`` would compile, the largest first."""
    found = Rehearsal()
    token = rehearsal.set(found)
    try:
        run()
    finally:
        rehearsal.reset(token)
    return sorted(found.noted, key=lambda version: -_size(found.noted[version], set()))


def _size(kernel, counted):
    """Return the bytes of Python's code of a kernel and of all that is linked into it."""
    counted.add(kernel)
    function, names = kernel.__wrapped__, kernel.__wrapped__.__code__.co_names
    named = [function.__globals__.get(name) for name in names]
    modules = [value for value in named if isinstance(value, ModuleType)]
    total = len(function.__code__.co_code)
    for callee in named + [vars(module).get(name) for module in modules for name in names]:
        if isinstance(callee, Kernel) and not callee.is_separate and callee not in counted:
            total += _size(callee, counted)
    return total


def compile_ahead(run):
    """Compile what ``run()`` needs, or some of it: what fails here is compiled when it is called,
    and reports its error there.
    """
    count = min(len(os.sched_getaffinity(0)), PROCESSES)
    if count == 1 or not is_lasting():
        return
    with suppress(Exception), ThreadPoolExecutor(count) as threads, ExitStack() as held:
        helpers = [held.enter_context(_helper()) for _ in range(count)]
        versions, idle = rehearse(run), SimpleQueue()
        for helper in helpers:
            _send(helper, versions)
            idle.put(helper)

        def compile_one(version):
            helper = idle.get()
            with suppress(OSError):  # it was killed: the others go on
                _send(helper, version)
                helper.stdout.read(1)
            idle.put(helper)

        list(threads.map(compile_one, versions))


@contextmanager
def _helper():
    """A process that does `help_out`, for as long as it is wanted."""
    path = [folder or os.getcwd() for folder in sys.path]
    with subprocess.Popen(
        [sys.executable, "-P", "-c", PROGRAM.format(path=path, home=__name__)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as process:
        try:
            yield process
        finally:
            process.kill()


def _send(helper, what):
    helper.stdin.write(pickle.dumps(what))
    helper.stdin.flush()


def help_out():
    """Receive all versions, then those to compile, one after the other; report each that is done.
    End when nobody sends any more.
    """
    received = SimpleQueue()

    def listen():
        try:
            while True:
                received.put(pickle.load(sys.stdin.buffer))
        finally:
            os._exit(0)

    Thread(target=listen, daemon=True).start()
    gc.disable()
    foreseen.set({(v.module, v.name, v.args): v.returns for v in received.get()})
    while True:
        version = received.get()
        with suppress(Exception):
            version.compiled()
        os.write(sys.stdout.fileno(), b".")
