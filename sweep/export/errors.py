"""The error of an export."""


class ExportError(ValueError):
    """What cannot be exported; the text is one sentence that says why, and what is allowed."""
