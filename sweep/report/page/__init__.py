"""A sweep as one HTML page that works without a network: tables, curves, shapes, sliders.

`gather` collects the data of the page from the designs of `selection`, `thinning` and `trails` make
curves and shapes small, `write` fills `page.html` with them. `rank.js` ranks as
`sweep.ranking.rank` does, for budgets, panels and forces that are chosen in the browser.
"""
