"""The study of lattice.sides: how fast few cells tend to a wide panel, free-sided and periodic."""
