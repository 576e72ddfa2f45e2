"""Lengths of steps: shorter after failures and errors, longer again where they are easy."""

from types import SimpleNamespace

import numpy as np

from kernels.solve import march, newton, outcomes


class Shares:
    """Shares of a step from a ``share`` on, rejected and accepted at will, in plain Python."""

    def __init__(self, share, accuracy=np.inf):
        longest = 4 if accuracy < np.inf else 1
        self.stage = march.Stage(
            16, 1.0, False, 0.0, 0.0, 0.0, 1.0, accuracy=accuracy, longest=longest
        )
        self.progress = np.zeros(1, march.PROGRESS)[0]
        self.progress.share = share
        self.descent = np.zeros(1, newton.DESCENT)[0]

    def reject(self, outcome, ratio=0.0):
        """Reject a share for its outcome, with an error so many times the allowed one."""
        problem = SimpleNamespace(roll_back=lambda step: None)
        state = SimpleNamespace(x=np.zeros(1))
        workspace = SimpleNamespace(x0=np.zeros(1), evaluation=SimpleNamespace(u=np.zeros(1)))
        reject = getattr(march._reject, "__wrapped__", march._reject)
        reject(outcome, ratio, problem, None, state, workspace, self.descent, self.progress)

    def accept(self, ratio=0.0):
        """Accept a share, which is easy."""
        accept = getattr(march._next_share, "__wrapped__", march._next_share)
        accept(ratio, 100, self.stage, self.descent, self.progress)
        rows = int(self.progress.done)
        self.progress.row, self.progress.done = self.progress.row + rows, self.progress.done - rows

    @property
    def reported(self):
        """How a march ends here, of shares that are too short."""
        reported = getattr(march._reported, "__wrapped__", march._reported)
        return reported(outcomes.UNRESOLVED, self.progress)


def test_after_each_failure_more_shares_are_accepted_before_one_is_doubled():
    """1, then 3; easy steps bring it back."""
    shares, lengths = Shares(2.0**-4), []
    for fails in (True, False, True, False, False, False, False, False, False, False):
        if fails:
            shares.reject(outcomes.ITERATIONS)
            shares.progress.done = 0.0
        else:
            shares.accept()
        lengths.append(int(-np.log2(shares.progress.share)))
    assert lengths == [5, 5, 6, 6, 6, 6, 5, 5, 4, 4]


def test_steps_span_rows_only_if_they_have_an_accuracy():
    """Steps of an eighth of a row to four rows, and shorter ones where the stage ends."""
    for accuracy, longest in ((1e-3, 4.0), (np.inf, 1.0)):
        shares, lengths = Shares(0.125, accuracy), []
        while shares.progress.row < shares.stage.steps:
            lengths.append(float(shares.progress.share))
            shares.accept()
        assert sum(lengths) == shares.stage.steps
        assert lengths[:5] == [0.125, 0.125, 0.25, 0.5, 1.0]
        assert max(lengths) == longest


def test_a_step_that_spans_rows_is_shortened_by_its_error():
    """It gets the length that a quadratic error allows, rejected or not; if rejected, at most
    half.
    """
    for ratio, share in ((0.5, 2.0), (3.0, 2.0), (5.0, 1.0), (1e9, 1.0)):
        shares = Shares(4.0, accuracy=1e-3)
        shares.reject(outcomes.INACCURATE, ratio)
        assert shares.progress.share == share
    for ratio, share in ((0.5, 4.0), (3.0, 2.0), (100.0, 1.0)):
        shares = Shares(4.0, accuracy=1e-3)
        shares.accept(ratio)
        assert shares.progress.share == share


def test_shares_too_short_for_round_off_are_reported_by_what_shortened_them():
    """They are reported even if some of them were accepted; a whole step is not short."""
    shares = Shares(1.0)
    assert shares.reported == outcomes.UNRESOLVED
    shares.reject(outcomes.NOT_FINITE)
    shares.accept()
    shares.reject(outcomes.UNRESOLVED)
    assert shares.reported == outcomes.NOT_FINITE
    shares.progress.share = 1.0
    shares.accept()
    assert shares.reported == outcomes.UNRESOLVED
