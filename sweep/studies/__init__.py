"""Studies that come with Crumple.

`khatri_egan` predicts a measured crush across the cells, `khatri_egan_along` crushes along them,
and `course_report` draws the figures of a course report.
"""
