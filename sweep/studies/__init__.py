"""Studies in the package: the prediction of a measured crush, the figures of the course report."""
