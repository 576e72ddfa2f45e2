"""What a material with a memory changes: losses, rates, orders of designs, and its price."""
