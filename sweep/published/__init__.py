"""Predicts published crushes, and users' own; predictions are stored before the measured values.

`table` has the rows, `predict` computes their predictions, `curve` and `quantity` read measured
values.
"""
