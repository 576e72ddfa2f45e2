"""The figures of the course report and the figures it proposes, each with a caption of numbers.

Run by `make figures`. Each file makes one figure: its `draw` simulates the cases, writes the
picture and returns the three parts of the caption: the report, our result, differences and their
reasons.
"""
