"""The course report's figures and what it wished to add, each a picture and a caption of numbers.

Run by `make figures`. A file is a figure: its `draw` simulates what it needs, writes the picture
and returns the caption's three parts: what the report showed, what we see, where and why they
differ.
"""
