"""The terms of the energy, one file each, in the symbols of kernels/README.md.

There are two patterns. *Terms of walls* (`stretch`, `bend` with `section`, `kelvin_voigt`) depend
on the deformation of each element alone. Their `evaluate` returns the energy and writes its
derivatives in strain and turns, the resultants of the sections, from which `elements` makes
gradient and Hessian. `rayleigh` starts from that Hessian. *Other terms* have two verbs: `evaluate`
returns the energy and adds the gradient, `hessian` adds to the matrix (`inertia`, `damping` by
mass, `spring`, `fold`, `contact`, `friction`). `loads` are linear. `contact_near_joints` prepares
`contact`, and `profile` is contact with rigid profiles. The material laws are in `kernels.laws`.
"""
