"""Writes files for other programs: a part to print, an outline, curves, shapes. One file per
format.

`export.py` chooses the format by the ending of the file's name. `design.py` and `outline.py`
rebuild the printed design from a results file. `solid.py` makes a closed body of it, and refuses a
body whose volume does not match the mass. `page.py` writes the page of a sweep with such files.
"""
