"""What is drawn: families of infill, the network of walls, its area, walls sized for a mass."""
