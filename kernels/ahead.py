"""Compiles all that a run needs beforehand, in several processes at once.

Which kernels meet arguments of which types is found out by a rehearsal: the run once as plain
Python, for which it must be a small one. What is compiled is kept (`cache`), and found there by the
run itself.
"""

import gc
import os
import pickle
import signal
import subprocess
import sys
from contextlib import suppress
from types import ModuleType

from numba.core.typing.typeof import Purpose, typeof

from kernels.cache import is_lasting
from kernels.jit import Kernel, rehearsal
from kernels.separate import Address, elsewhere

PROCESSES = 3  # more would wait for the largest kernel


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
            types = tuple(typeof(value, Purpose.argument) for value in args)
            returns = typeof(returned, Purpose.argument)
            self.noted[Address(kernel.__module__, kernel.__name__, types, returns)] = kernel
        return returned


def rehearse(run):
    """Return the addresses of what ``run()`` would compile, the largest first."""
    found = Rehearsal()
    token = rehearsal.set(found)
    try:
        run()
    finally:
        rehearsal.reset(token)
    return sorted(found.noted, key=lambda address: -_size(found.noted[address], set()))


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
    """Compile what ``run()`` needs. What fails here is compiled when it is called."""
    count = min(os.cpu_count() or 1, PROCESSES)
    if count == 1 or not is_lasting():
        return
    claims, offer = os.pipe()
    helpers = [_start(claims) for _ in range(count)]
    try:
        with open(offer, "wb") as numbers:
            addresses = rehearse(run)
            numbers.write(bytes(range(len(addresses))))
        for helper in helpers:
            with suppress(BrokenPipeError), helper.stdin as told:
                pickle.dump(addresses, told)
        for helper in helpers:
            helper.wait()
    finally:
        os.close(claims)
        for helper in helpers:
            helper.kill()
            helper.wait()


def _start(claims):
    """Start a process that is told all addresses, and takes from the pipe ``claims`` which one to
    compile next.
    """
    path = os.pathsep.join(folder or os.getcwd() for folder in sys.path)
    return subprocess.Popen(
        [sys.executable, "-P", "-c", f"from kernels.ahead import help_out; help_out({claims})"],
        stdin=subprocess.PIPE,
        pass_fds=[claims],
        env=os.environ | {"PYTHONPATH": path},
    )


def help_out(claims):
    """Compile what it is told, one after the other until all are taken, and end the process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # whoever started this ends it
    gc.disable()
    addresses = pickle.load(sys.stdin.buffer)
    elsewhere.set({(a.module, a.name, a.args): a.returns for a in addresses})
    while claim := os.read(claims, 1):
        addresses[claim[0]].compiled()
    os._exit(0)
