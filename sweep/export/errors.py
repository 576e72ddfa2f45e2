"""The error of an export."""


class ExportError(ValueError):
    """A case that cannot be exported; the text is one sentence with the reason, and what is
    allowed.
    """
