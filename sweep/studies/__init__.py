"""Studies that ship: a measured crush predicted, and the figures of the course report."""
