"""The length of the next step: a share of a row, or a number of rows.

A share that fails or is inaccurate is halved, and an easy one is doubled again. A failed attempt
costs more than a doubled share saves: after every failure more shares have to be accepted before a
share is doubled.
"""

from kernels.compile.jit import jit_exact

DOUBLING_ERROR = 0.1  # share of the allowed error: below it the next share may be twice as long
SPANNING_ERROR = 0.2  # the same, for static shares of a row and longer
MOST_PATIENCE = 63  # most shares to accept after a failure before one is doubled


@jit_exact
def _spanning(share, ratio):
    """Return a share that spans rows, halved until its error, quadratic in its length, is
    admissible.

    ratio: its error / the allowed one.
    """
    while share > 1.0 and ratio > 1.0:
        share, ratio = 0.5 * share, 0.25 * ratio
    return share


@jit_exact
def _fits(stage, progress, share):
    """Return whether a share is part of one row, or may span rows and ends before the stage does.

    Shares start at multiples of their own length, so that shares of a row end with it.
    """
    at = progress.row + progress.done
    return at % share == 0.0 and share <= stage.longest and at + share <= stage.steps


@jit_exact
def shorten(ratio, inaccurate, progress):
    """Shorten the share after a failure, or after an error ``ratio`` times the allowed one."""
    if not inaccurate:
        progress.failed += 1
        progress.patience = min(2 * progress.patience + 1, MOST_PATIENCE)
        progress.wait = progress.patience
    shorter = progress.share * 0.5 ** max(progress.failed, 1)  # faster by repeated failures
    progress.share = min(shorter, _spanning(progress.share, ratio))


@jit_exact
def adapt(ratio, iterations, stage, progress):
    """Complete a share; double the next one if this one was easy and a doubled one fits.

    ratio: its error / the allowed one. iterations: greatest number in an easy share.
    """
    most = DOUBLING_ERROR if stage.dynamic else SPANNING_ERROR
    easy = progress.share_iterations <= iterations and ratio < most
    progress.done, progress.failed = progress.done + progress.share, 0
    if progress.wait > 0:
        progress.wait -= 1
    elif easy and _fits(stage, progress, 2.0 * progress.share):
        progress.share *= 2.0
        progress.patience //= 2
    progress.share = _spanning(progress.share, ratio)
    while not _fits(stage, progress, progress.share):
        progress.share *= 0.5
