"""The tables of a config that pose a question about the results: they enter no case and no id."""

from typing import Literal

from sweep.config.kinds.table import Acceleration, Energy, Force, Length, Mass, Stress, Table


class Rank(Table):
    """Defaults of a ranking: budgets of mass (kg), and the panel that specimens fill (m).

    per: to which allowed forces and requirements apply. drop_heights: of cushion curves (m).
    """

    budgets: tuple[Mass, ...] = ()
    panel: tuple[Length, Length] | None = None
    drop_heights: tuple[Length, ...] = ()
    per: Literal["specimen", "panel"] = "specimen"


class Require(Table):
    """The requirements that a design must fulfil to have a place in a ranking."""

    max_force: Force | None = None
    max_deceleration: Acceleration | None = None
    max_base_pressure: Stress | None = None
    max_target_acceleration: Acceleration | None = None
    max_mass: Mass | None = None
    min_absorbed: Energy | None = None
    max_stroke: Length | None = None


QUESTION: dict[str, type[Table]] = {"rank": Rank, "require": Require}
