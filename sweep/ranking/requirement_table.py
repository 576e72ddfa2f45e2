"""The requirements on a part, one in each row: the quantity and the words for it.

Rankings, sentences, options of the command line and the page take them from here; `Require` in
`config/question.py` has the keys of a config. No heavy imports, as every command reads this.
"""

from typing import Any, NamedTuple


class Measure(NamedTuple):
    """The quantity that a requirement limits.

    unit: in SI. shown: the unit that people read. kind: of quantity, in the help of an option.
    shared: whether the values of the specimens of a panel add up. least: the limit is a least
    value; else it is a greatest one. noun: the value in words. none: why nothing fulfils it.
    unknown: why a value is unknown. example: a limit. about: the meaning of the option, before the
    example. step_error: column of the error of load steps, as a share of the value in a crush;
    empty without one.
    """

    unit: str
    shown: str
    kind: str
    shared: bool
    noun: str
    none: str
    example: str
    about: str = "required"
    least: bool = False
    unknown: str = "not measured"
    step_error: str = ""

    @property
    def limit(self) -> str:
        """The requirement in words, with a place for its limit: "force at most {}"."""
        return f"{self.noun} at {'least' if self.least else 'most'} {{}}"

    @property
    def far(self) -> str:
        """A value beyond the limit, in words."""
        return "too little" if self.least else "too much"

    def share_missed(self, value: Any, limit: float) -> Any:
        """By what share of its limit a value misses it; negative if it does not."""
        return 1.0 - value / limit if self.least else value / limit - 1.0


MEASURES = {
    "max_force": Measure(
        *("N", "N", "FORCE"),
        shared=True,
        noun="force",
        none="None transmits less than {}; the least is {}",
        example="60 N",
        about="required, while the usable energy is absorbed",
        unknown="time steps are too long for peaks (solver.time_step)",
        step_error="peak_step_error",
    ),
    "max_deceleration": Measure(
        *("m/s^2", "g0", "ACCELERATION"),
        shared=False,
        noun="deceleration",
        none="None stops the striker with less than {}; the least is {}",
        example="80 g0",
        about="required, of the striker, filtered",
        unknown="rows are too far apart for loading.filter_class",
    ),
    "max_base_pressure": Measure(
        *("Pa", "kPa", "PRESSURE"),
        shared=False,
        noun="base pressure",
        none="None presses on the base with less than {}; the least is {}",
        example="200 kPa",
        about="required, on a patch of the base, loading.base_patch wide",
        unknown="a lattice along its cells, on ribs or with tied sides has none",
    ),
    "max_target_acceleration": Measure(
        *("m/s^2", "g0", "ACCELERATION"),
        shared=False,
        noun="acceleration of the target",
        none="None accelerates the target by less than {}; the least is {}",
        example="40 g0",
        about="required, of a base that moves freely",
        unknown="loading.target_mass is not given",
    ),
    "max_mass": Measure(
        *("kg", "g", "MASS"),
        shared=True,
        noun="mass",
        none="None weighs less than {}; the lightest weighs {}",
        example="2 g",
    ),
    "min_absorbed": Measure(
        *("J", "J", "ENERGY"),
        shared=True,
        noun="usable energy",
        none="None absorbs as much as {}; the most is {}",
        example="1.5 J",
        least=True,
        step_error="load_step_error",
    ),
    "max_stroke": Measure(
        *("m", "mm", "LENGTH"),
        shared=False,
        noun="stroke",
        none="None needs less stroke than {}; the least is {}",
        example="8 mm",
    ),
}
"""By their keys in [require]; `Mode.requires` has those that apply to a kind of loading."""
