"""Writes tables, pictures and pages of results; the only home of matplotlib.

`publish` writes the files of a sweep or a case: `tables` as text, `figures`, and `page`, a sweep as
one HTML page.
"""
