"""Files of materials: `material_file` reads the measured curve, `material_header` the numbers and
sources in the comment lines above it.
"""
