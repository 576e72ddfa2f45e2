"""Reads a TOML document into keys and values, with a sentence for everything that is not
understood.

`reader` takes a document apart; `mapping` makes a document of a dict, `text` reads files of users.
`other_names` knows other names of keys, and `unused_keys` says why a key has no effect. `examples`
are the configs that come with Crumple.
"""
