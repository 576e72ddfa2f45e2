"""Contact and friction of walls in space.

`pairs` lists pairs that are near, `touching` measures them; `contact` has the energy, `friction`
the slip; `mirror` adds the images of a quarter, `thickness` lets squeezed walls thicken, and
`admissible` limits a move.
"""
