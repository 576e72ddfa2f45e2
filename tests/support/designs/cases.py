"""Cases for tests of a config."""

from sweep.config.case import Case


def pressed(**loading):
    """A case under a platen that moves."""
    return Case.of(loading=dict(mode="displacement", **loading))
