"""Compiled kernels: arrays and floats in SI in, arrays and floats out."""
