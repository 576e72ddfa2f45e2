"""The verb `new`: writes a config with comments, to be changed by its user."""

import json
from pathlib import Path
from textwrap import wrap

from sweep.cli.refusals import ArgumentError, writing
from sweep.cli.terminal import quoted
from sweep.design.infill import families
from sweep.whole_file import write_whole

KINDS = ("crush", "drop", "load")
WIDTH, COMMENT = 99, 37  # columns at which a line ends and a comment begins

HEAD = """\
#:schema {schema}
# {title}
#
{commands}
#
# Every quantity has a unit. Keys that are left out have defaults. configs/README.md of Crumple
# explains all of them. A line that begins with # is a comment: remove the # to use its key.
name = "{name}"

[lattice]
kind = "square"                      # {kinds}
width = "50 mm"                      # of the part, over centre lines
height = "12.5 mm"                   # its thickness, which is pressed
depth = "50 mm"                      # its other length, along the walls, out of the drawing

[material]
name = "ninjaflex"                   # crumple materials lists them; or your own .csv
# loss = 0.3                         # of the work of a cycle of a strip: assumed, 0.2 to 0.4

[loading]
"""
LOADINGS = {
    "crush": """\
mode = "crush"                       # a platen comes down and goes back up
strain = "60 %"                      # of the height
platen = "contact"                   # loose between plates; "glued": bonded to them
allowed_forces = ["500 N", "2 kN"]   # each adds a column to the results: energy up to it
# cycles = 2                         # pressed twice
""",
    "drop": """\
mode = "drop"                        # a rigid striker falls onto the lattice and rebounds
striker_mass = "400 g"               # of what falls onto the part
drop_height = "0.2 m"                # at first touch 2 m/s; its weight acts in the stroke too
platen = "contact"                   # loose between striker and support; "glued": bonded to them
# energy = "0.8 J"                   # instead of the height
""",
    "load": """\
mode = "force"                       # a dead load, applied suddenly and removed
force = "80 N"                       # on the part
platen = "contact"                   # loose between plates; "glued": bonded to them
release_time = "0.138 s"             # when the load is removed
duration = "0.2 s"                   # when the run ends
""",
}
TAIL = """\

[grid]                               # all combinations: 2 x 2 = 4 cases
"lattice.cell_size" = ["4 mm", "6 mm"]   # whole numbers of cells: the run says how many
"lattice.wall_thickness" = ["0.4 mm", "0.8 mm"]
# "lattice.kind" = ["square", "hex"]

[rank]
budgets = ["{budget}"]                   # greatest mass of the part
# panel = ["100 mm", "50 mm"]        # instead: an area tiled with separate parts of this size
"""
TITLES = {
    "crush": "Which design absorbs the most energy in a crush?",
    "drop": "Which design transmits the least force in an impact?",
    "load": "Which design deforms least under a load?",
}


SCHEMA = "crumple.schema.json"


def new(name: str, kind: str, out: str | None) -> Path:
    """Write the config of a kind of loading; return its path. An existing file is refused.

    The schema that the config names, for editors, is written beside it.
    """
    from sweep.config.reading.reader import NAME, NO_NAME

    name = name.removesuffix(".toml")
    if not NAME.fullmatch(name):
        raise ArgumentError(f'"{name}" is {NO_NAME}')
    path = Path(out or f"{name}.toml")
    if path.suffix != ".toml":
        raise ArgumentError(f"--out {path}; allowed: a file whose name ends in .toml")
    if path.exists():
        raise ArgumentError(f"{path} already exists; allowed: another name, or --out")
    with writing(path.parent, path):
        write_whole(path.with_name(SCHEMA), schema_text())
        return write_whole(path, template(name, kind, path))


def schema_text() -> str:
    """The keys of a config as a JSON schema."""
    from sweep.config.json_schema import json_schema

    return json.dumps(json_schema(), separators=(",", ":")) + "\n"


def template(name: str, kind: str, path: Path) -> str:
    """The text of a config."""
    file, results = quoted(str(path)), quoted(f"results/{name}.h5")
    verbs = {
        f"run {file} --dry-run": "how many cases, how long",
        f"run {file}": "simulate, then rank",
        f"show {results} 1": "pictures of the best design",
    }
    width = max(map(len, verbs))
    commands = "\n".join(f"#   crumple {verb:{width}}  {does}" for verb, does in verbs.items())
    others = "or " + ", ".join(family for family in families() if family != "square")
    kinds = f"\n{' ' * COMMENT}# ".join(wrap(others, WIDTH - COMMENT - 2))
    head = HEAD.format(title=TITLES[kind], kinds=kinds, schema=SCHEMA, name=name, commands=commands)
    return head + LOADINGS[kind] + TAIL.format(budget="12 g")
