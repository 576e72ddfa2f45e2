"""A case in, a result out: the march, and the measures that are read off it."""
