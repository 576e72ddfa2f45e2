"""Records of materials for tests."""

from sweep.config.materials.material_file import available, locate, read_record

HEADER = "# density_kg_m3: 1200\n# poisson: 0.48\nstrain,stress_Pa\n"
RUBBERS = [name for name in available() if not read_record(locate(name)).plasticity]
