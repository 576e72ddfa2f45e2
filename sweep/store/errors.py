"""The error of all modules that read and write results files."""

from sweep.config.faults import ReportedError


class StoreError(ReportedError):
    """A results file that cannot be read or written; the text is one line."""
