"""The square grid as a solid body: plane finite elements with true walls, to judge the network by.

Everything here is in mm, N and MPa, so that energies are in mJ.
"""
