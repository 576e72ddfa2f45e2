"""Which test notices a wrong sign, and how soon: see `__main__`."""
