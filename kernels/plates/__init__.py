"""The problem of walls as plates, crushed along the print axis: its terms."""
