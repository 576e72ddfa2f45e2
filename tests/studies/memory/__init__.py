"""Effects of a material with a memory: losses, rates, orders of designs, and its cost."""
