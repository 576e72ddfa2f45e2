"""What a crush costs and where the time goes: `make bench` prints the table and draws the figure.

Every figure is the median of several repetitions in one run; the sides of a ratio are measured in
turn. Times are CPU times of one thread unless a row says otherwise.
"""
