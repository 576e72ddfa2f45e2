"""The error of an export."""

from sweep.config.faults import ReportedError


class ExportError(ReportedError, ValueError):
    """A case that cannot be exported; the text is one sentence with the reason, and what is
    allowed.
    """
