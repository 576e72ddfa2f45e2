"""What is drawn: families of infill, the network of walls, and its printed area.

`infill/` has one file for each family; `sizing` finds the cells or the wall that give a mass.
"""
