"""Compilation without garbage collection and with a large stack chunk: a third of the time less."""

import functools
import gc

FRAME = 70_000  # words: more than half of a chunk of a megabyte


def undisturbed(compile_):
    """Compile without the garbage collector, which takes a sixth of the time and finds little, and
    in a frame that fills half of a chunk of Python's stack.

    The other half is room for all calls of the compiler. Else Python takes a small chunk from the
    system whenever a call needs one more and gives it back when that returns: as long again.
    """

    def compiled(*given):
        collects = gc.isenabled()
        gc.disable()
        try:
            return compile_(*given)
        finally:
            if collects:
                gc.enable()

    compiled.__code__ = compiled.__code__.replace(co_stacksize=FRAME)
    return functools.wraps(compile_)(compiled)
