"""Predicts published crushes, and users' own; predictions are stored before the measured values."""
