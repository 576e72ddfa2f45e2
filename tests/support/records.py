"""Records of materials for tests."""

HEADER = "# density_kg_m3: 1200\n# poisson: 0.48\nstrain,stress_Pa\n"
