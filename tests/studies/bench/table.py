"""A table of figures: rows and columns by name, numbers with their printed form."""

from dataclasses import dataclass, field

from tests.studies.tables import head, line


@dataclass
class Table:
    """Values and texts by (row, column); rows in the order in which they were entered."""

    title: str
    columns: tuple[object, ...]
    values: dict[tuple[str, object], float] = field(default_factory=dict)
    texts: dict[tuple[str, object], str] = field(default_factory=dict)

    def put(self, row, column, value, beside=""):
        """Enter a value, with something in brackets."""
        self.values[row, column] = value
        self.texts[row, column] = number(value) + (f" ({beside})" if beside else "")

    def lack(self, row, why):
        """Say in the first column why there are no values."""
        self.texts[row, self.columns[0]] = why

    def row(self, name):
        """Values of a row by column."""
        return {column: value for (row, column), value in self.values.items() if row == name}

    def markdown(self):
        """Lines of the table under its title."""
        rows = dict.fromkeys(row for row, _ in self.texts)
        yield from head([self.title, *map(_name, self.columns)])
        for row in rows:
            yield line([row, *(self.texts.get((row, column), "") for column in self.columns)])


def number(value):
    """Three digits, or all before the point."""
    return f"{value:,.0f}" if abs(value) >= 99.95 else f"{value:.3g}"


def _name(column):
    return f"{column} x {column}" if isinstance(column, int) else str(column)
