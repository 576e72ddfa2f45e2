"""The cost of a crush: `make bench` prints the tables of docs/speed.md.

Every figure is the median of several repetitions in one run; the sides of a ratio are measured in
turn. Times are CPU times of one thread unless a row says otherwise.
"""
