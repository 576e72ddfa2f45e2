"""Studies that come with Crumple: a measured crush predicted, the figures of a course report."""
