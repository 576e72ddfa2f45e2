"""Reads files of materials: `material_file` the measured curve, `material_header` the numbers and
sources in the comment lines above it; `plausibility` detects mistaken units.
"""
