"""The planar lattice as a problem for the solver: walls with two coordinates a node, and joints.

`problem` has its data and its verbs; a verb's code is in the file of its topic.
"""
