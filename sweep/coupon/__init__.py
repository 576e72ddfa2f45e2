"""A user's own test of a printed strip or puck, and the material that follows from it."""
