"""Open values of a case, completed by its mode and by its contact; values that exclude each
other.
"""

import pytest

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError
from sweep.result import design_columns
from tests.support.designs.cases import pressed

PERIODIC = '[lattice]\nboundary = "periodic"\n'
TIED = '[lattice]\nsides = "periodic"\n'
ACROSS = '"contact", "glued" or "sliding" if lattice.sides is "periodic"'
ENDLESS = 'allowed: "displacement" if lattice.boundary is "periodic"'
BY_POSITION = '[contact]\nmodel = "position_based"'
MOVED = '"none" or "barrier"'
IN_TIME = '"backward_euler", "bdf2" or "newmark"'
MODE, IMPACT = '[loading]\nmode = "displacement"\n', '[loading]\nmode = "impact"\n'
BARE = 'platen = "none"'
HELD = '"contact", "glued" or "sliding"'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[loading]\nstrain = 0.5\nstroke = "5 mm"', ["6.25 mm", "one of them"]),
        ('[loading]\nstroke = "0.5in"', ["below the height", "0.4921 in"]),
        ('[solver]\nintegrator = "static"', [f'{IN_TIME} if loading.mode is "force"']),
        ('[solver]\nintegrator = "arc_length"', [IN_TIME, 'lattice.kind is "custom"']),
        (f'{BY_POSITION}\n[solver]\nintegrator = "newmark"', ['"backward_euler" if contact.model']),
        (f"[loading]\nstrain = 0.5\n{BY_POSITION}", [MOVED, "if loading.quasi_static"]),
        (
            f'[loading]\nplaten = "contact"\n{BY_POSITION}',
            [MOVED, "if loading.platen is"],
        ),
        (f"{TIED}{IMPACT}{BY_POSITION}", [MOVED, "if lattice.sides"]),
        (f"{BY_POSITION}\nfriction = 0.3", ["no effect", 'contact.model is "position_based"']),
        ("[loading]\nunload = false\ncycles = 2", ["1 if loading.unload is false"]),
        (f'{PERIODIC}[loading]\nstrain = 0.5\nplaten = "glued"', ['"none"']),
        (f'{TIED}[loading]\nmode = "force"\n{BARE}', [ACROSS]),
        (f"{TIED}[loading]\nstrain = 0.5\n{BARE}", [ACROSS]),
        (MODE + BARE, [HELD, '"displacement"']),
        (IMPACT + BARE, [HELD, '"impact"']),
        (f'{IMPACT}[solver]\nintegrator = "static"', [f'{IN_TIME} if loading.mode is "impact"']),
        ('[loading]\nrelease_time = "0.3 s"', ["duration, 0.2 s"]),
        ('[loading]\nmode = "custom"', ['unless lattice.kind is "custom"']),
    ],
)
def test_what_does_not_fit_is_refused(last_refused, text, words):
    assert last_refused(text, *words)


BY_FORCE = 'loading.mode = "force", as loading.force is given'
BY_STRIKER = 'loading.mode = "impact", as loading.striker_speed is given'
BY_SPEED = "loading.quasi_static = false, as loading.speed is given"


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        (PERIODIC, 'loading.mode = "force" by default', ENDLESS),
        (f'{PERIODIC}[loading]\nforce = "3 N"', BY_FORCE, ENDLESS),
        (f'{PERIODIC}[loading]\nstriker_speed = "1 m/s"', BY_STRIKER, ENDLESS),
        (f'{PERIODIC}[loading]\nspeed = "1 m/s"', BY_SPEED, "true if lattice"),
        (TIED, "loading.platen", ACROSS),
        (f"{MODE}quasi_static = false", "loading.speed", "a speed if quasi_static is false"),
    ],
)
def test_what_follows_from_other_keys_is_refused_with_these(refused, text, key, words):
    assert refused(text, key, words)


@pytest.mark.parametrize(
    ("tables", "key"),
    [
        ({"loading": {"mode": "displacement", "force": 5.0}}, "loading.force"),
        ({"loading": {"mode": "force", "unload": False}}, "loading.unload"),
        ({"damping": {"model": "none", "mass": 1.0}}, "damping.mass"),
        ({"contact": {"model": "none", "friction": 0.1}}, "contact.friction"),
    ],
)
def test_a_key_that_its_kind_does_not_have_is_refused(tables, key):
    with pytest.raises(RefusedError, match=f"{key} = .*; allowed: a key of"):
        Case.of(**tables)


def test_only_a_crush_that_takes_time_has_a_pause():
    fast = {"speed": 0.1}
    assert pressed().loading.hold_time is None
    assert pressed(hold_time=3.0).case_id == pressed().case_id
    assert pressed(**fast, hold_time=3.0).case_id != pressed(**fast).case_id
    assert pressed(**fast, hold_time=0.0).case_id == pressed(**fast).case_id
    relaxing, held = (
        Case.of(material=dict(loss=0.3), loading=dict(mode="displacement", hold_time=time))
        for time in (None, 3.0)
    )
    assert (held.loading.hold_time, held.loading.strain_rate) == (3.0, 0.01)
    assert held.case_id != relaxing.case_id


def test_a_fall_sets_the_speed():
    """v^2 = 2 g h: 1 m gives 4.43 m/s; the height is another word for the speed in an id."""
    fallen = Case.of(loading=dict(striker_mass=0.1, drop_height=1.0))
    assert fallen.loading.striker_speed == pytest.approx(4.4287, abs=1e-4)
    assert fallen.loading.energy == pytest.approx(0.1 * 9.80665)
    speed = fallen.loading.striker_speed
    struck = Case.of(loading=dict(striker_mass=0.1, striker_speed=speed, gravity=True))
    assert struck.loading.drop_height == pytest.approx(1.0)
    assert fallen.case_id == struck.case_id


@pytest.mark.parametrize(
    ("other", "own"), [('striker_speed = "1 m/s"', "0.1673 ft"), ('energy = "1 J"', "0.1495 J")]
)
def test_a_fall_beside_another_speed_is_refused(lines, other, own):
    (line,) = lines(f'[loading]\ndrop_height = "1 ft"\n{other}')
    assert own in line
    assert "one of them" in line


def test_speed_and_energy_follow_from_one_another():
    by_speed = dict(striker_mass=0.1, striker_speed=2.0)
    by_energy = dict(striker_mass=0.1, energy=0.2)
    ids = {Case.of(loading=made).case_id for made in (by_speed, by_energy, by_speed | by_energy)}
    assert len(ids) == 1
    with pytest.raises(RefusedError, match=r"loading\.energy = 0\.3; allowed: 0\.2 J"):
        Case.of(loading=by_speed | dict(energy=0.3))


PERIODS = [
    ({"strain": 0.5, "platen": "contact"}, 0.0, "tied, free period"),
    ({"strain": 0.5, "platen": "contact"}, 0.3, "tied, fixed period"),
    ({"strain": 0.5, "platen": "contact", "speed": 1.0}, 0.0, "tied, fixed period"),
    ({"strain": 0.5}, 0.0, "tied, fixed period"),
    ({"mode": "impact", "platen": "contact"}, 0.0, "tied, fixed period"),
]


@pytest.mark.parametrize(("loading", "friction", "sides"), PERIODS)
def test_a_period_is_free_where_nothing_holds_it(loading, friction, sides):
    case = Case.of(lattice={"sides": "periodic"}, loading=loading, contact={"friction": friction})
    assert design_columns(case)["sides"] == sides
