"""From a TOML file to keys and values, with a sentence for whatever is not understood.

`reader` takes a document apart. `unclosed` finds the fault where it is no TOML, `renamed` and
`other_names` know other names of keys, and `unused_keys` says why a key has no effect. `examples`
are the configs that come with Crumple.
"""
