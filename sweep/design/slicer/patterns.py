"""Infills as slicers print them: the table of slicers, of their patterns, and of matching families.

A new pattern is a row of `PATTERNS` and its names in `PROGRAMS`; a new slicer is a row of these.

A line of width w and height h has rounded sides. PrusaSlicer and its derivatives lay lines at a
distance s = w - h (1 - pi/4), so that a line fills h s; Cura lays them w apart and extrudes w h.
With a share r of infill, the parallel lines of a pattern are at a distance of n s / r, where n is
the number of its directions; from flat to flat a hexagon of the honeycomb measures 2 s / r. Walls
of m lines side by side are m s thick. OrcaSlicer (`fill_multiline`) lays them m times as far apart,
so that the share stays the same; Cura (`infill_multiplier`) does not change their distance, so that
the extruded share is m r.

In a layer of honeycomb the walls of one direction are printed twice, side by side, and each layer
is turned by 60 degrees: a wall is 2 s, s, s thick in turn, its mean thickness is 4 s / 3, its mean
second moment 10/3 s^3 / 12. Paths cut corners, so that (4 - r) s / 3 is extruded per length.

OrcaSlicer's lateral lattice and lateral honeycomb are prisms whose axis lies in the layers, which
are stacked up the drawing: where a layer cuts a wall that is inclined by an angle a from the print
axis, it has a line, and the wall is s cos(a) thick. The lattice has lines at a distance of 2 s / r
that move by z tan(45 deg) with the height z, and as many that move by -z tan(45 deg). The honeycomb
has single lines, 4/3 s / r apart, over two thirds of its height, and over one third pairs that part
by z tan(60 deg) until they meet their neighbours: regular hexagons. Of several lines side by side
it leaves out those that overlap, which is not offered. (`FillLateralLattice` and
`FillLateralHoneycomb` with their default angles, `src/libslic3r/Fill/FillRectilinear.cpp` of
OrcaSlicer at commit 0210c8ac.)

No numpy here, so that a wrong config is refused at once.
"""

from math import cos, pi, radians, sqrt
from typing import NamedTuple

from sweep.design.surfaces.names import SHEETS

WIDTH_PER_NOZZLE = 1.125
OVERLAP = 0.25  # of a line: how far infill reaches into the perimeters
ROUNDED = 1.0 - pi / 4.0


class Pattern(NamedTuple):
    """A pattern that is the same in all layers, or whose axis lies in them.

    family: of `design.infill`, or "" for parallel lines. spacing: distance of its parallel walls
    x r / s, with a share r of infill. side: the unit of the family over that distance. opening:
    clear width of the narrowest cell over that distance. turn: of the family's drawing at a fill
    angle of 0, rad. middle: of the drawing, in the unit of the family. wall: mean thickness over s;
    gyration: radius of gyration of the section over the value of a rectangle of the mean thickness.
    corners: thickness / s that paths save in the mean by cutting corners, per share of infill.
    multiline: whether walls may be several lines. slopes: angles of its walls from the print axis,
    rad, if its axis lies in the layers.
    """

    family: str
    spacing: float
    side: float
    opening: float
    turn: float = 0.0
    middle: tuple[float, float] = (0.0, 0.0)
    wall: float = 1.0
    gyration: float = 1.0
    corners: float = 0.0
    multiline: bool = True
    slopes: tuple[float, ...] = ()

    @property
    def is_even(self) -> bool:
        """Whether it has cells, between walls of one thickness."""
        return self.family != "" and len(self.slopes) < 2

    @property
    def most(self) -> float:
        """Share of infill, of a single line, at which cells are twice as wide as their walls."""
        thickest = max(map(cos, self.slopes), default=self.wall)
        return 0.5 * self.opening * self.spacing / thickest


PATTERNS = {
    "grid": Pattern("square", 2, 1.0, 1.0),
    "triangles": Pattern("triangle", 3, 2.0 / sqrt(3.0), 2.0 / 3.0),
    "stars": Pattern("kagome", 3, 1.0 / sqrt(3.0), 1.0 / 3.0),
    "honeycomb": Pattern(
        "hex",
        2,
        1.0 / sqrt(3.0),
        1.0,
        turn=radians(-30.0),
        middle=(sqrt(0.75), 1.0),
        wall=4.0 / 3.0,
        gyration=sqrt((10.0 / 3.0) / (4.0 / 3.0) ** 3),
        corners=1.0 / 3.0,
        multiline=False,
    ),
    "alignedrectilinear": Pattern("", 1, 1.0, 1.0),
    "lateral-lattice": Pattern(
        "diamond",
        sqrt(2.0),
        sqrt(2.0),
        1.0,
        middle=(0.5, 0.0),
        wall=sqrt(0.5),
        multiline=False,
        slopes=(radians(45.0),),
    ),
    "lateral-honeycomb": Pattern(
        "hex",
        4.0 / 3.0,
        1.0 / sqrt(3.0),
        1.0,
        middle=(sqrt(0.75), 1.0),
        wall=2.0 / 3.0,
        multiline=False,
        slopes=(0.0, radians(60.0)),
    ),
}
"""Patterns by their names in PrusaSlicer; those that it does not have, in OrcaSlicer."""


class SheetPattern(NamedTuple):
    """A pattern whose lines follow, in each layer, a sheet of `design.surfaces`.

    sheet: its name. period: of the sheet x r / s, with a share r of infill and lines s. turns:
    whether the fill angle turns it; if not, and at 45 degrees, its axes lie along the axes of the
    part.
    """

    sheet: str
    period: float
    turns: bool = True


class Program(NamedTuple):
    """A slicer.

    title: its name for people. patterns: patterns that it prints as prisms, its own name -> the
    name in `PATTERNS`. sheets: patterns that it prints as sheets, by its own name. rounded: whether
    it counts lines with round sides. nozzles: default width of a line, in nozzles. lines: the most
    that it lays side by side in a wall. spreads: whether walls of several lines are further apart,
    so that the share of infill stays the same. reads: whether it reads settings from a .3mf.
    """

    title: str
    patterns: dict[str, str]
    sheets: dict[str, SheetPattern]
    rounded: bool = True
    nozzles: float = WIDTH_PER_NOZZLE
    lines: int = 1
    spreads: bool = True
    reads: bool = True


PROGRAMS = {
    "prusa": Program(
        "PrusaSlicer",
        {name: name for name, pattern in PATTERNS.items() if not pattern.slopes},
        {"gyroid": SheetPattern("gyroid", 2.0 * pi / 2.44)},
    ),
    "orca": Program(
        "OrcaSlicer",
        {
            "grid": "grid",
            "triangles": "triangles",
            "tri-hexagon": "stars",
            "honeycomb": "honeycomb",
            "alignedrectilinear": "alignedrectilinear",
            "lateral-lattice": "lateral-lattice",
            "lateral-honeycomb": "lateral-honeycomb",
        },
        {
            "gyroid": SheetPattern("gyroid", 2.0 * pi / 2.44),
            "tpmsd": SheetPattern("schwarz_d", 2.0 * pi / 2.1),
        },
        lines=10,
    ),
    "cura": Program(
        "Cura",
        {"grid": "grid", "triangles": "triangles", "trihexagon": "stars"},
        {"gyroid": SheetPattern("gyroid", 2.41, turns=False)},
        rounded=False,
        nozzles=1.0,
        lines=10,
        spreads=False,
        reads=False,
    ),
}
"""Numbers of sheets as read in the sources of libslic3r (`DensityAdjust`, `CorrectionAngle`) and of
CuraEngine.
"""
SLICERS = {name: program.patterns for name, program in PROGRAMS.items()}
"""Slicer -> its patterns: their own names -> the names in `PATTERNS`."""


SHEET_PATTERNS = {name for program in PROGRAMS.values() for name in program.sheets}
"""Patterns of slicers that are sheets."""


def is_sheet(name: str) -> bool:
    """Whether a lattice of this name, a kind or the pattern of a slicer, is a sheet."""
    return name in SHEETS or name in SHEET_PATTERNS


def is_lateral(name: str) -> bool:
    """Whether the layers of a lattice of this name are stacked up the drawing."""
    return name in PATTERNS and PATTERNS[name].slopes != ()


def family_of(name: str) -> str:
    """The family of a slicer's pattern, empty for parallel lines; other names unchanged."""
    names = {own: pattern for patterns in SLICERS.values() for own, pattern in patterns.items()}
    return PATTERNS[names[name]].family if name in names else name


class Likeness(NamedTuple):
    """A pattern of PrusaSlicer that matches a family of `design.infill`.

    angle: fill angle at which it lies as the family is drawn, rad. unit: of the pattern's family in
    the unit of this family.
    """

    pattern: str
    angle: float = 0.0
    unit: float = 1.0

    @property
    def distance(self) -> float:
        """Distance of the parallel walls in the unit of the family."""
        return self.unit / PATTERNS[self.pattern].side


LIKE = {
    ("square", None): Likeness("grid"),
    ("diamond", None): Likeness("grid", radians(45.0), sqrt(0.5)),
    ("triangle", None): Likeness("triangles"),
    ("kagome", None): Likeness("stars"),
    ("hex", "pointy"): Likeness("honeycomb", radians(30.0)),
    ("hex", "flat"): Likeness("honeycomb"),
}
"""By family and orientation."""
NEAREST = {"brick": "square", "circle": "hex", "reentrant": "hex"}
"""Families that no slicer draws -> one like them that slicers draw; not all have one."""

TURNS = "it turns from layer to layer", "alignedrectilinear"
TWISTS = "its walls turn with the height, which would need prisms that turn", "honeycomb"
LEVELS = "its walls wander from layer to layer, which would need its level surface", "honeycomb"
CELLS = "its walls are inclined and meet along lines, which would need their joints", "honeycomb"
CUBES = CELLS[0], "triangles"
TREES = "it changes from layer to layer", "grid"
LOOPS = "its loops do not meet, and only the top and the bottom hold them", "grid"
PATHS = "it is one winding path without joints", "grid"
NO_PRISMS = {
    "rectilinear": TURNS,
    "line": TURNS,
    "lines": TURNS,
    "zigzag": TURNS,
    "monotonic": TURNS,
    "tpmsfk": LEVELS,
    "3dhoneycomb": CELLS,
    "crosshatch": TWISTS,
    "cubic": CUBES,
    "cubicsubdiv": CUBES,
    "adaptivecubic": CUBES,
    "supportcubic": CUBES,
    "quartercubic": CUBES,
    "tetrahedral": CUBES,
    "lightning": TREES,
    "cross3d": TREES,
    "concentric": LOOPS,
    "cross": PATHS,
    "hilbertcurve": PATHS,
    "archimedeanchords": PATHS,
    "octagramspiral": PATHS,
}
"""Patterns that no model here has, by their `bare` names: why, and the nearest prism."""


def bare(name: str) -> str:
    """A name in lower case, without blanks, dashes and underscores."""
    return "".join(letter for letter in name.lower() if letter not in " -_")


class InfillLines(NamedTuple):
    """How an infill is laid; lengths in m.

    pattern: as in `PATTERNS`. distance: of its parallel walls. angle: of the first ones from the
    width, rad. line: m s, thickness of the lines of one wall. inset: where they end within the
    sides of the box, and within its bottom and top.
    """

    pattern: str
    distance: float
    angle: float
    line: float
    inset: tuple[float, float]

    @property
    def share(self) -> float:
        """Share of infill r, as the slicer counts."""
        return share_of(self.pattern, self.distance, self.line)


def line_of(slicer: str, width: float, height: float) -> float:
    """Mean thickness (m) of a line of this width and height: s, or w for Cura."""
    return width - height * ROUNDED if PROGRAMS[slicer].rounded else width


def width_of(slicer: str, line: float, height: float) -> float:
    """Width (m) of a line with this mean thickness: the inverse of `line_of`."""
    return line + height * ROUNDED if PROGRAMS[slicer].rounded else line


def distance_of(pattern: str, share: float, line: float) -> float:
    """Distance (m) of the parallel walls of a pattern; line: thickness of the lines of a wall."""
    return PATTERNS[pattern].spacing * line / share


def share_of(pattern: str, distance: float, line: float) -> float:
    """Share of infill at a distance (m) of the parallel walls: the inverse of `distance_of`."""
    return PATTERNS[pattern].spacing * line / distance


def spread_lines(slicer: str, lines: int) -> int:
    """How many times further apart walls of several lines are than walls of one line."""
    return lines if PROGRAMS[slicer].spreads else 1


def lines_at_most(slicer: str, pattern: str) -> int:
    """The most lines side by side in a wall of a pattern, by its name in `PATTERNS`."""
    return PROGRAMS[slicer].lines if PATTERNS[pattern].multiline else 1
