"""Laws of one strain: the material at a point, and the barrier.

A material law (`law`) maps a strain and what the material remembers to a potential, its slope and
its tangent. All scenes have that of `fibre`; `elastic`, `relaxation`, `softening` and `yielding`
are its parts.
"""
