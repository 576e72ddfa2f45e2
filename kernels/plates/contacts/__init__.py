"""Walls that touch in space.

`pairs` lists what is near, `touching` measures it; `contact` has the energy, `friction` the slip;
`mirror` adds the images of a quarter, `thickness` follows squeezed walls, and `admissible` limits a
move.
"""
