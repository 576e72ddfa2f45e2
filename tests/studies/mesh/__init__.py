"""How many elements a wall needs: see `__main__`."""
