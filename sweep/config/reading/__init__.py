"""From a TOML file to keys and values, with a sentence for whatever is not understood.

`reader` takes a document apart. `quantity` reads a number with its unit, `other_names` knows other
names of keys, and `unused_keys` says why a key has no effect. `examples` are the configs that come
with Crumple.
"""
