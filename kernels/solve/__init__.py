"""The method: a step's minimum, the march through a loading, its integrators and energy book."""
