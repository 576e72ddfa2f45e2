"""Tables, Markdown and pictures of results; the only home of matplotlib.

`publish` writes the files of a sweep or a case; every other module makes one kind of them.
"""
