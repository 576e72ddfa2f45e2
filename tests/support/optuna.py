"""The parts of Optuna that docs/questions.md uses, with three trials: the ends of ranges and their
middle.

Names and arguments agree with Optuna 4; any further use by the page fails here.
"""

SHARES = (0.0, 0.5, 1.0)


class TrialPruned(Exception):  # noqa: N818  its name in Optuna
    """A trial without a value."""


class Trial:
    """Numbers and choices at a share of their range."""

    def __init__(self, share):
        self.share, self.params = share, {}

    def suggest_float(self, name, low, high):
        """A number."""
        return self._keep(name, low + self.share * (high - low))

    def suggest_int(self, name, low, high):
        """A whole number."""
        return self._keep(name, low + round(self.share * (high - low)))

    def suggest_categorical(self, name, choices):
        """One of the choices."""
        return self._keep(name, choices[min(int(self.share * len(choices)), len(choices) - 1)])

    def _keep(self, name, value):
        self.params[name] = value
        return value


class Study:
    """The best of three trials."""

    def __init__(self, sign):
        self.sign, self.best_params, self.best_value = sign, None, None

    def optimize(self, objective, n_trials):
        """Try the shares; a pruned trial has no value."""
        assert n_trials > 0
        for share in SHARES:
            trial = Trial(share)
            try:
                value = objective(trial)
            except TrialPruned:
                continue
            if self.best_value is None or self.sign * value > self.sign * self.best_value:
                self.best_params, self.best_value = trial.params, value


def create_study(direction):
    return Study({"maximize": 1.0, "minimize": -1.0}[direction])
