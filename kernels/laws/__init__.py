"""Laws of a material point, and the barrier.

A material law (`law`) maps the strain and the material's memory to a potential, its slope and its
tangent. `fibre` is the law of all points in walls of the plane; `elastic`, `relaxation`,
`softening` and `yielding` are its parts, and `one_point` evaluates it at a single point. `sheet` is
the law of walls in space, with three strains; `separable` finds its function of one stretch.
`relaxing_sheet` is the law of a sheet with memory, in the strains of `log_strain`.

`power` takes powers of four numbers at a time, for the stretch of bent fibres. `barrier` is no
material law either but, like one, a function of one number with its derivatives; it is here because
`elastic` needs it, as contacts and folds do (`kernels.terms`, `kernels.plates`).
"""
