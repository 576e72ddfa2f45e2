"""From a TOML file to keys and values, with a sentence for whatever is not understood."""
