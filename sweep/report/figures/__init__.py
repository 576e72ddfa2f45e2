"""Pictures: one file per kind of picture, each drawn into axes from tables alone."""
