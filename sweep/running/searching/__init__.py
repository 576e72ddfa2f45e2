"""The search for the best design.

`design_space` has the designs as points of a unit cube, `search` chooses which of them to simulate,
and `finalists` simulates the best ones again.
"""
