"""The planar lattice as a problem of the solver: walls with two coordinates a node, and joints.

`problem` has its data and lists its verbs; the code of a verb is in the file of its topic.
"""
