"""The search for the best design.

`design_space` maps designs to points of a unit cube, `search` chooses the designs to simulate,
`optimize` searches for the answer to a question, and `finalists` simulates the best designs again.
"""
