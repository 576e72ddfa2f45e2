"""Reads a TOML document into keys and values, with a sentence for everything that is not
understood.

`toml_file` makes a document of a file, `mapping` of a dict, and `reader` takes it apart; `text`
reads files of users. `other_names` knows other names of keys, and `keys_without_effect` the
reasons. `examples` are the configs that come with Crumple.
"""
