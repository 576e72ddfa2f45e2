"""The effective material of an endless infill: elastic constants, buckling stress, density."""
