"""Values that a config leaves open, and that follow from standards or from a slicer.

`drop_tests` has the masses and heights of standard drop tests, `slicer_settings` the settings of a
slicer that print a design.
"""
