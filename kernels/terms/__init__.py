"""The terms of the energy, one file each: energy, gradient, Hessian, in the symbols of the paper.

A material law (`law`, `elastic`) maps a strain and what the material remembers to a potential, its
slope and its tangent; `stretch` and `bend` evaluate it at the sections of the walls.
"""
