"""Tables as text: a `sheet` is one table, of rankings (`sheets`), accuracy, materials or searches.

`design_text` describes designs, `legend` what marks and heads mean, `requirement_notes` what
requirements exclude; `markdown` writes any sheet as Markdown.
"""
