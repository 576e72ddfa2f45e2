"""What ours is compared with: beams in numpy, OpenSees, libraries that factor the same matrix."""
