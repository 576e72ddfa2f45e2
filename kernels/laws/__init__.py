"""Laws of a material point, and the barrier.

A material law (`law`) maps a strain and what the material remembers to a potential, its slope and
its tangent. `fibre` is the law of all points in walls of the plane; `elastic`, `relaxation`,
`softening` and `yielding` are its parts, `one_point` runs it alone. `sheet` is the law of walls in
space, of three strains (`separable`), and `relaxing_sheet` the one with memory, in logarithmic
strains (`log_strain`). `barrier` is that of contacts and folds.
"""
