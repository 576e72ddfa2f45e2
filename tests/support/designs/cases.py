"""Cases for tests of a config."""

from sweep.config.case import Case, Loading


def pressed(**loading):
    """A case under a platen that moves."""
    return Case(loading=Loading(mode="displacement", **loading))
