"""The fast compiler, made of the private parts of the Numba versions that `compile.choice` knows.

`kernel` is what a decorated function becomes, `passes` are the steps of Numba that remain, `abi`
passes arrays from kernel to kernel. `linking` joins kernels to one piece of machine code,
`outlined` leaves a separate kernel out of it, `sealed` keeps the result, and `precompile` compiles
several pieces at once.
"""
