"""A measured crush of Khatri and Egan (2024) predicted: `across` the cells and `along` them."""
