"""Distances, collisions, near pairs, and the areas and extents of what is drawn."""
