"""Files of materials: the measured curve, and the numbers and sources in its header."""
