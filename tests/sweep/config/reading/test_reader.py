"""From the tables of a file to a sweep: keys, types, axes; one line for each mistake, no more."""

import json

import pytest

from sweep.config.axis import Interval
from sweep.config.case import Case
from sweep.config.faults import ConfigError
from sweep.config.grid import expand
from sweep.config.materials.material_file import available
from sweep.config.reading import reader
from tests.support.designs.structures import BEAM


def test_config_that_says_nothing_of_its_cases_is_the_seed(load, tmp_path):
    (case,) = expand(load("[lattice]"))
    assert case == Case.of()
    assert load("[lattice]").name == "sweep"
    config = load('name = "armour-2"')
    assert (config.name, config.path) == ("armour-2", tmp_path / "sweep.toml")


def test_the_nearest_of_many_unknown_keys_are_not_searched(load, monkeypatch):
    searched = []
    monkeypatch.setattr(reader, "meant", lambda name, names: searched.append(name) or ("", "none"))
    with pytest.raises(ConfigError, match="unknown key"):
        load("[lattice]\n" + "\n".join(f"key{k} = 1" for k in range(2 * reader.SEARCHED)))
    assert len(searched) == reader.SEARCHED


def test_an_axis_of_strains_may_have_numbers_and_shares(load):
    text = '[grid]\nloading.strain = ["40 %", 0.5, "60 %"]\n[[exclude]]\nloading.strain = "50 %"'
    assert [case.axes["loading.strain"] for case in expand(load(text))] == [0.4, 0.6]


@pytest.mark.parametrize(
    ("table", "number", "percent"),
    [
        ("[material]\nloss = {}", "0.4", '"40 %"'),
        ("[material]\nrelaxation_times = ['1 s']\nrelaxation_shares = {}", "[0.1]", '["10 %"]'),
        ("[material]\nrelaxation = [{{time = '1 s', share = {}}}]", "0.1", '"10%"'),
        ("[material]\nname = 'pla'\nfracture_strain = {}", "0.025", '"2.5 %"'),
        ("[grid]\nlattice.imperfection = {}", "[0.0, 0.02]", '["0 %", 0.02]'),
        ("[loading]\nmode = 'displacement'\nstrain = {}", "0.3", '"30 %"'),
    ],
)
def test_every_share_is_a_number_or_in_percent(load, table, number, percent):
    ids = [[case.case_id for case in expand(load(table.format(v)))] for v in (number, percent)]
    assert ids[0] == ids[1]
    assert ids[0] != [case.case_id for case in expand(load("[lattice]"))]


def test_own_material_is_found_beside_the_config(load, last_refused, tmp_path):
    header = "# density_kg_m3: 1100\n# poisson: 0.4\nstrain,stress_Pa\n"
    (tmp_path / "mine.csv").write_text(header + "0.01,1e5\n0.05,4e5\n1,2e6\n")
    text = '[grid]\nmaterial.name = ["ninjaflex", "mine.csv"]\n'
    mine = expand(load(f'{text}material.density = ["1 g/cm^3"]'))[1]
    assert (mine.material.name, mine.material.density) == ("mine", 1000.0)
    assert mine.axes["material.name"] == "mine"
    assert len(expand(load(f'{text}[[exclude]]\nmaterial.name = "mine.csv"'))) == 1
    (tmp_path / "mine.csv").write_text("strain;stress_Pa\n0,01;1e5\n")
    assert last_refused('[material]\nname = "mine.csv"', "# density_kg_m3:", "# poisson:")


def test_numbers_of_a_material_are_not_called_defaults(refused):
    key = 'material.yield_stress = 4.5e+07 Pa in the file of "pla"'
    assert refused('[material]\nname = "pla"\nloss = 0.3', key, "none if loss is given")


def test_rank_is_in_si(load):
    text = 'budgets = ["20 g", "1 oz"]\npanel = ["100 mm", "2 in"]\ndrop_heights = ["1 ft"]'
    rank = load(f"[rank]\n{text}").rank
    assert rank.budgets == pytest.approx((0.02, 0.028349523125))
    assert rank.panel == pytest.approx((0.1, 0.0508))
    assert rank.drop_heights == pytest.approx((0.3048,))


def test_requirements_are_in_si_and_in_no_id(load):
    text = 'max_force = "60 N"\nmax_deceleration = "10 g0"\nmin_absorbed = "20 mJ"'
    config = load(f'[require]\n{text}\n[rank]\nper = "panel"\npanel = ["1 in", "2 in"]')
    found = config.require.model_dump(exclude_none=True)
    assert found == {"max_force": 60.0, "max_deceleration": 98.0665, "min_absorbed": 0.02}
    assert config.rank.per == "panel"
    assert [case.case_id for case in expand(config)] == [Case.of().case_id]


LENGTH = '"0.8 mm", above 0'
SIZE = f"{LENGTH}, at most 1000 m"
CELLS = "a whole number, at least 1, at most 1000"
UNKNOWN = "unknown key; the nearest is"
UNREAD = 'has no effect with this lattice.kind; needed: "custom" or "drawn"'
TWO = "[grid]\nlattice.cells = [2, 3]\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[lattice]\nwall_thicknes = "0.8 mm"', [f"{UNKNOWN} lattice.wall_thickness"]),
        ("[lattice]\nwidth = 12.5", ["bare number", SIZE]),
        ('[lattice]\nwidth = "1 mmm"', ['unknown unit "mmm"', SIZE]),
        ('[lattice]\ndepth = "-8 mm"', ["out of range", SIZE]),
        ('[lattice]\nwidth = "1e30 m"', ["out of range", SIZE]),
        ("[lattice]\ncells_x = true", ["wrong type", CELLS]),
        ("[lattice]\ncells_y = 3.0", ["wrong type", CELLS]),
        ('[lattice]\nkind = "hex"\nfile = "a.svg"', [UNREAD]),
        ('[loading]\nmode = "impact"\nmass = "1 kg"', [f"{UNKNOWN} loading.striker_mass"]),
        ('[loading]\nmode = "displacement"\nstrain = "150 %"', ['"20 %", above 0, below 100 %']),
        ("[loading]\nstrain = 60", ["out of range", '"20 %", above 0, below 1', '"60 %"']),
        ('[material]\nname = "ninjaflx"', ["unknown material", *available(), ".csv"]),
        ('[material]\nname = "mine.csv"', ["there is no ", "/mine.csv", *available()]),
        ("[material]\nloss = [0.2, 0.4]", ["[grid]", "at most 0.8"]),
        ('[rank]\nper = "panel"', ["no rank.panel", '"specimen"']),
        ('[rank]\npanel = ["1 mm"]', ["too few", "2 values", LENGTH]),
        ('[require]\nmax_forces = "3 N"', [f"{UNKNOWN} require.max_force"]),
        ('[require]\nmax_deceleration = "80 g"', ["another kind", '"80 g0"', "g is a gram"]),
        ("[loading]\nload_steps = 3\n[solver]\nload_steps = 4", ["loading.load_steps = 3"]),
        ("[grid]\nlattice.cells = []", ["no values", "a list", CELLS]),
        ("[grid]\nlattice.cells = 3", ["not a list", CELLS]),
        ('[grid]\nloading.allowed_forces = [["1 N"]]', ["no axis", "one value"]),
        (f"{TWO}[[zip]]\nlattice.cells_x = [2, 3]", ["in [grid] too", "one of them"]),
        ('[[zip]]\nloading.force = ["1 N"]\nlattice.cells = [1, 2]', ["loading.force has 1"]),
        (f"{TWO}[[exclude]]\nlattice.cell = 2", [f"{UNKNOWN} lattice.cells"]),
        ("[[exclude]]\nlattice.cells = []", ["is empty", "one value"]),
    ],
)
def test_one_fault_is_one_line(last_refused, text, words):
    assert last_refused(text, *words)


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        ('[latice]\nwidth = "1 mm"', 'latice = {"width": "1 mm"}', f"{UNKNOWN} lattice"),
        ("lattice = 3", "lattice = 3", "not a table; allowed: a table [lattice]"),
        ("zip = 3", "zip = 3", "[[zip]]"),
        ('name = "a/b"', 'name = "a/b"', "letters, digits, dots, dashes, underscores"),
        ("[contact]\nfriction = nan", "contact.friction = NaN", "not finite"),
        ("[grid]\nlattice.cells = [[2, 3]]", "[grid] lattice.cells = [2, 3]", "in a list"),
        ("[[exclude]]", "[[exclude]] = {}", "is empty; allowed: at least one key"),
        ('[[exclude]]\nrank.budgets = ["2 g"]', '[[exclude]] rank.budgets = "2 g"', "unknown key"),
    ],
)
def test_one_fault_is_one_line_by_its_own_key(refused, text, key, words):
    assert refused(text, key, words)


def test_all_faults_are_told_at_once(lines):
    told = lines(
        '[lattice]\nwall_thickness = "3 mm"\n'
        '[material]\nname = "x"\n'
        '[contact]\nfriction = -1\nmodel = "foo"\n'
        '[grid]\nsolver.tol = [1]\nloading.force = ["1 N", 2]'
    )
    assert [line.split(" = ")[0] for line in told] == [
        *("material.name", "contact.friction", "contact.model"),
        *("[grid] solver.tol", "[grid] loading.force", "lattice.wall_thickness"),
    ]


def test_what_may_only_follow_from_a_fault_is_not_told(lines):
    (line,) = lines('[lattice]\ncels = 1\nwall_thickness = "3 mm"')
    assert "lattice.cels" in line
    assert len(lines('[material]\nloss = 40\n[lattice]\nwall_thickness = "3 mm"')) == 2


@pytest.mark.parametrize(
    "text",
    [
        '[material]\nloss = 40\n[loading]\nstrain_rate = "0.1 1/s"',
        '[grid]\nmaterial.loss = [30]\nloading.strain_rate = ["1 1/s", "2 1/s"]',
        '[material]\ndensity = 1200\nname = "pla"\n[lattice]\nmass = "99 g"',
        '[material]\nbend = "linaer"\n[solver]\nbend_measure = "tangent"',
    ],
)
def test_what_may_only_follow_from_a_fault_of_the_material_is_not_told(lines, text):
    (line,) = lines(text)
    assert "material." in line


def test_a_share_without_its_unit_is_understood(lines):
    """So that the other faults are told beside it; percent or a share, 30 could be both."""
    text = '[lattice]\ninfill = {}\n[loading]\nmode = "crush"\nforce = "3 N"'
    share, idle = lines(text.format("0.3"))
    assert share.startswith("lattice.infill = 0.3: a bare number; allowed: a share in percent")
    assert idle.startswith('loading.force = "3 N": has no effect')
    (percent,) = lines(text.format("30"))
    assert percent.startswith("lattice.infill = 30: a bare number")


def test_branches_are_stated_once(refused):
    branches = '[material]\nrelaxation = [{time = "1 s", share = 0.1}]'
    twice = f'{branches}\nrelaxation_times = ["5 s"]\nrelaxation_shares = [0.3]'
    key = 'material.relaxation = [{"time": "1 s", "share": 0.1}]'
    assert refused(twice, key, "material.relaxation_times", "one of them")
    assert refused(f"{branches}\nloss = 0.3", "material.loss = 0.3", "one of loss and relaxation")


def test_a_strain_above_one_needs_its_unit(load, refused):
    plastic = '[material]\nname = "pla"\nfracture_strain = '
    key = "material.fracture_strain = 2.5"
    assert refused(f"{plastic}2.5", key, "a bare number above 1", "up to 1", '"20 %", above 0')
    strains = {"0.025": 0.025, '"2.5 %"': 0.025, "1": 1.0, '"250 %"': 2.5}
    for text, strain in strains.items():
        (case,) = expand(load(f"{plastic}{text}"))
        assert case.material.fracture_strain == strain


@pytest.mark.parametrize("number", ["60", "0.6", " 6e-1 "])
def test_a_share_in_quotes_needs_its_unit(refused, number):
    told = refused(f'[loading]\nstrain = "{number}"', f'loading.strain = "{number}"', "allowed: a")
    assert "in quotes" in told
    assert "bare number" not in told


def test_a_text_with_line_breaks_stays_in_one_line(lines):
    assert len(lines('[material]\nname = "a\\nb"\n"c\\nd" = 1')) == 2


def test_files_are_an_axis(load, tmp_path):
    for name, thickness in (("thin", 1.0), ("thick", 2.0)):
        whole = BEAM | {"wall_thickness_mm": thickness}
        (tmp_path / f"{name}.json").write_text(json.dumps(whole))
    text = '[lattice]\nkind = "custom"\n[grid]\nlattice.file = ["thin.json", "thick.json"]\n'
    cases = expand(load(text))
    assert [case.axes["lattice.file"] for case in cases] == ["thin.json", "thick.json"]
    assert [case.lattice.wall_thickness for case in cases] == [1e-3, 2e-3]
    assert len(expand(load(f'{text}[[exclude]]\nlattice.file = "thin.json"'))) == 1


def test_ranges_and_lists_of_a_search(load):
    text = '[search]\n"lattice.wall_thickness" = {from = "0.4 mm", to = "1.6 mm"}\n'
    text += "lattice.cells = {from = 2, to = 5}\nlattice.grading = {from = 1, to = 3}\n"
    search = load(f'{text}"lattice.kind" = ["square", "hex"]').recipe.search
    wall = "lattice.wall_thickness"
    assert search[wall] == Interval(wall, 0.4e-3, 1.6e-3, "m")
    assert (search["lattice.cells"].low, search["lattice.cells"].whole) == (2, True)
    assert not search["lattice.grading"].whole
    assert [written.value for written in search["lattice.kind"].values] == ["square", "hex"]


TWICE = "varied in [search] too; allowed: one of them"
NO_RANGE = "no range; allowed: numbers, from the smaller to the greater, or a list"
IN_SEARCH = "a range, which belongs into [search]; allowed: "


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('[search]\nlattice.wal = {from = "1 mm", to = "2 mm"}', "unknown key; the nearest is"),
        ('[search]\nlattice.depth = {from = "2 mm", to = "1 mm"}', NO_RANGE),
        ('[search]\nlattice.kind = {from = "hex", to = "square"}', NO_RANGE),
        ('[search]\nlattice.depth = {from = "2 mm", to = 3}', "a bare number"),
        ("[search]\nlattice.cells = {from = 2, to = 3}\nlattice.cells_x = [2]", TWICE),
        ("[search]\nlattice.cells = [2]\n[grid]\nlattice.depth = ['1 mm']", "beside [search]"),
        ("[grid]\nlattice.cells = {from = 2, to = 3}", f"{IN_SEARCH}a list, each a whole"),
        ("[lattice]\ncells = {from = 2, to = 3}", f"{IN_SEARCH}a whole number"),
        ("search = 3", "not a table; allowed: a table [search]"),
    ],
)
def test_a_search_that_cannot_be_read(lines, text, told):
    (line,) = lines(text)
    assert told in line


PROFILE = (
    "fill_pattern = grid\nfill_density = 20%\ninfill_extrusion_width = 0.45\nlayer_height = 0.2\n"
    "perimeters = 3\ntop_solid_layers = 5\n"
)
BOX = 'width = "30 mm"\nheight = "30 mm"\n'
SAME = 'slicer = "prusa"\npattern = "grid"\ninfill = "20 %"\nperimeters = 3\n'


@pytest.mark.parametrize(
    ("varied", "where"),
    [
        ("[grid]\nlattice.cells_x = [3, 4]", "[grid]"),
        ("[grid]\nlattice.cells = [3, 4]", "[grid]"),
        ("[[zip]]\nlattice.cells_x = [3, 4]\nlattice.kind = ['hex', 'square']", "[[zip]]"),
    ],
)
def test_a_value_that_an_axis_replaces_is_named(load, varied, where):
    config = load(f"[lattice]\ncells_x = 2\n{varied}")
    assert config.notes == (f"lattice.cells_x: {where} replaces the value in [lattice]",)
    assert [case.lattice.cells_x for case in config.cases] == [3, 4]


def test_a_value_that_a_row_leaves_as_it_is_stays_unnamed(load):
    config = load("[lattice]\ncells_x = 2\n[[zip]]\nlattice.cells_x = [3, '']")
    assert config.notes == ()
    assert [case.lattice.cells_x for case in config.cases] == [3, 2]


@pytest.fixture
def profile(tmp_path):
    """The profile of a slicer beside the config."""
    (tmp_path / "own.ini").write_text(PROFILE)
    return f'[lattice]\nprofile = "own.ini"\n{BOX}'


def test_a_profile_gives_the_case_of_its_values(load, profile):
    config, stated = load(profile), load(f"[lattice]\n{BOX}{SAME}")
    assert config.cases[0].case_id == stated.cases[0].case_id
    assert "own.ini" not in config.cases[0].to_json()
    assert "top_solid_layers = 5" in config.notes[-1]
    assert stated.notes == ()


def test_keys_of_the_config_win_over_a_profile(load, profile):
    (case,) = load(f'{profile}pattern = "stars"\nextrusion_width = "0.5 mm"').cases
    assert (case.lattice.pattern, case.lattice.line_width) == ("stars", 0.5e-3)
    assert case.lattice.perimeters == 3
    config = load(f'{profile}line_distance = "5 mm"')
    assert config.cases[0].lattice.fill_distance == 5e-3
    assert config.notes[-1] == "own.ini: the config says otherwise: infill"
    shares = load(f'{profile}[grid]\nlattice.infill = ["10 %", "30 %"]').cases
    assert [case.lattice.infill for case in shares] == [0.1, 0.3]
    (weighed,) = load(f'{profile}mass = "6 g"').cases
    assert weighed.lattice.mass == 6e-3


def test_cells_that_are_drawn_take_the_lines_of_a_profile(load, profile):
    (case,) = load(f'{profile}kind = "hex"').cases
    assert (case.lattice.kind, case.lattice.perimeters) == ("hex", 3)
    assert case.lattice.line_printed == 0.45e-3


def test_keys_of_a_profile_need_have_no_effect(load, profile, tmp_path):
    (tmp_path / "own.ini").write_text(PROFILE.replace("grid", "gyroid"))
    text = '[lattice]\nprofile = "own.ini"\n[loading]\nmode = "displacement"\nstrain = 0.5'
    assert load(text).cases[0].lattice.name == "gyroid"


def test_profiles_are_compared_in_a_grid(load, profile, tmp_path):
    (tmp_path / "other.ini").write_text(PROFILE.replace("grid", "stars").replace("20%", "30%"))
    lattice = f'[lattice]\n{BOX}[grid]\n"lattice.profile" = ["own.ini", "other.ini"]\n'
    cases = load(f'{lattice}"lattice.imperfection" = [0.01, 0.02]').cases
    assert [(c.lattice.pattern, c.lattice.infill) for c in cases] == [
        ("grid", 0.2), ("stars", 0.3), ("grid", 0.2), ("stars", 0.3),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            f'{BOX}{SAME}[[zip]]\nlattice.profile = ["own.ini"]',
            "a profile; allowed: in",
        ),
        (
            f'{BOX}profile = "own.ini"\n[grid]\nlattice.profile = ["own.ini"]',
            "in [lattice] too",
        ),
        (f'{BOX}[grid]\nlattice.profile = "own.ini"', "no list of profiles; allowed: paths"),
        (f"{BOX}profile = 3", "no path; needed: a profile"),
        (f'{BOX}profle = "own.ini"', "the nearest is lattice.profile"),
        (f'{BOX}profile = "none.ini"', "cannot be read (No such file or directory)"),
    ],
)
@pytest.mark.usefixtures("profile")
def test_a_profile_in_another_table_is_refused(last_refused, text, told):
    assert last_refused(f"[lattice]\n{text}", told)


def test_a_value_of_a_profile_that_does_not_fit_names_the_file(lines, tmp_path, profile):
    (tmp_path / "own.ini").write_text(PROFILE.replace("20%", "100%"))
    (line,) = lines(profile)
    assert line.startswith('lattice.infill = "100 %": out of range; allowed:')
    assert line.endswith("(own.ini)")
    (tmp_path / "own.ini").write_text(PROFILE.replace("grid", "cubic"))
    (line,) = lines(profile)
    assert line.startswith('lattice.pattern = "cubic" (of own.ini): does not fit; allowed: "grid"')
