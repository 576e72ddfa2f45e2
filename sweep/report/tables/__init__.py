"""Writes tables as text: a `sheet` is one table, of rankings (`sheets`), accuracy, materials or
searches.

`design_text` describes designs, `marks` marks doubtful results, `legend` explains marks and heads,
`requirement_notes` says which designs requirements exclude; `markdown` writes any sheet as
Markdown, `html` as HTML.
"""
