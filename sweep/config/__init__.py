"""The config of a sweep: tables of keys with units, read from TOML into cases."""
