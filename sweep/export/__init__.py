"""Files for other programs: a part to print, an outline, curves, shapes. One file per format.

`export.py` knows which ending asks for which format; `design.py` and `outline.py` rebuild what was
drawn from a results file; `solid.py` makes it a body, whose volume is compared with the mass.
"""
