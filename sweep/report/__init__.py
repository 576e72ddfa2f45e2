"""Tables, Markdown, pictures and pages of results; the only home of matplotlib.

`publish` writes the files of a sweep or a case, `page` a sweep as one HTML page; every other module
makes one kind of file.
"""
