"""Reads a user's config: tables of keys with units, from TOML or a dict, into the cases of a sweep.

`load` reads a sweep, `reading` takes a document apart, `units` converts quantities to SI, `keys`
lists the keys and `json_schema` writes them for editors. `axis` and `grid` expand a grid into
`cases`; `case` is one case with its id, completed from the `kinds` of its tables, and `changes`
replaces some of its values. `question` has the tables that rank results, `faults` the errors.
`drop_tests` has the drops of standards, `slicer_settings` what a slicer prints a design with;
`materials`, `structures`, `drawings` and `profiles` read files of their own.
"""
