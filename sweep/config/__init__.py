"""What a user writes: tables of keys with units, read from TOML into the cases of a sweep."""
