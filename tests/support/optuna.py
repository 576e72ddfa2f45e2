"""The parts of Optuna that docs/questions.md uses, with three trials: the ends of ranges and their
middle.

Names and arguments agree with Optuna 4; any further use by the page fails here.
"""

from contextlib import suppress

SHARES = (0.0, 0.5, 1.0)


class TrialPruned(Exception):  # noqa: N818  its name in Optuna
    """A trial without a value."""


class Trial:
    """Numbers and choices at a share of their range."""

    def __init__(self, share):
        self.share, self.params = share, {}

    def suggest_float(self, name, low, high):
        """A number."""
        return self.params.setdefault(name, low + self.share * (high - low))

    def suggest_int(self, name, low, high):
        """A whole number."""
        return self.params.setdefault(name, low + round(self.share * (high - low)))

    def suggest_categorical(self, name, choices):
        """One of the choices."""
        number = min(int(self.share * len(choices)), len(choices) - 1)
        return self.params.setdefault(name, choices[number])


class Study:
    """The best of three trials."""

    def __init__(self, best):
        self.best = best

    def optimize(self, objective, n_trials):
        """Try the shares; a pruned trial has no value."""
        assert n_trials > 0
        tried = []
        for trial in map(Trial, SHARES):
            with suppress(TrialPruned):
                tried.append((objective(trial), trial.params))
        self.best_value, self.best_params = self.best(tried, key=lambda pair: pair[0])


def create_study(direction):
    return Study({"maximize": max, "minimize": min}[direction])
