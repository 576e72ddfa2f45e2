"""What a config leaves open: values that follow from others, from the loading, or from a slicer.

`resolve` completes a case. It takes the values that depend on the direction of the crush from
`direction`, the elements of a wall from `elements`, values of the solver from `solver_defaults`,
and those of standards from `drop_tests`. `printable` finds what does not print, `slicer_settings`
the settings that print a design.
"""
