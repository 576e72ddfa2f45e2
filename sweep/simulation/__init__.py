"""A case in, a result out: `simulate` runs the march, `summary` measures what came of it."""
