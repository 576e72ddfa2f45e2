"""The comparison of elements of `make elements`: orders, truths, and its summary in the README."""

from math import isnan, log2, nan

import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from tests.studies.validation import elements, pressed
from tests.studies.validation.exact import Frame
from tests.studies.validation.problem import bending
from tests.studies.validation.scenes import SCENES, driven
from tests.support import readme
from tests.support.designs.structures import LENGTH, MM

BAND = {"cubic": (4.0, 0.2), "classical": (2.0, 0.03)}
NAMES = {scene.name: scene for scene in SCENES}
SMOOTH = (
    "clamped column, t/L 0.01, 40 %",
    "hinged column, t/L 0.01, 40 %",
    "cantilever, P L^2 = Y I: drop",
    "cantilever, P L^2 = 10 Y I: drop",
    "cantilever, M L = pi Y I: height",
    "portal under 8 Y I / L^2: sway",
    "Lee's frame: first limit load",
    "Lee's frame: turning point",
    "cell on its corner, t/L 0.01, 40 %",
)


@pytest.mark.parametrize("element", elements.ELEMENTS)
@pytest.mark.parametrize("name", SMOOTH)
def test_order_on_a_smooth_path(name, element):
    order, band = BAND[element]
    assert elements.order(elements.errors(NAMES[name], element)) == pytest.approx(order, abs=band)


def test_second_order_share_of_stout_walls_is_their_axial_strain():
    """The excess of a stout column over a slender one, with the cubic element by 5 %."""
    share, found = 0.05, {}
    for slenderness in (0.01, 0.064):
        scene = driven("column", pressed.column(True, slenderness, share), 5)
        errors = {n: scene.value(n) / elements.truth(scene) - 1.0 for n in (12, 24)}
        force = elements.truth(scene) / (12.0 * bending(slenderness * LENGTH) / (LENGTH * MM) ** 2)
        found[slenderness] = errors, -force * slenderness**2
    (thin, strain), (stout, larger) = found[0.01], found[0.064]
    assert larger == pytest.approx(0.014, rel=0.01)
    more = {n: (stout[n] - thin[n]) / (larger - strain) for n in stout}
    assert log2(more[12] / more[24]) == pytest.approx(2.0, abs=0.05)
    assert 24**2 * more[24] == pytest.approx(-3.0, abs=0.1)


def test_exact_column_is_the_elastica():
    """A slender hinged column short by 40 %: 2 (1 - E / K) = 0.4, P L^2 = (2 K)^2 Y I."""
    m = brentq(lambda m: 2.0 * (1.0 - ellipe(m) / ellipk(m)) - 0.4, 0.1, 0.9)
    force = elements.truth(NAMES["hinged column, t/L 0.01, 40 %"])
    unit = bending(0.01 * LENGTH) / (LENGTH * MM) ** 2
    assert -force / unit == pytest.approx((2.0 * ellipk(m)) ** 2, rel=2e-4)


def test_exact_cross_is_the_same_led_by_a_moment_or_a_turn():
    parts = pressed.cross(0.05, 0.1)
    turned = Frame(parts).solve(1.0)
    pushed = Frame(parts | {"prescribed": [], "loads": [{"node": 0, "moment_Nmm": 1.0}]})
    moment = MM * pushed.lead(0, "rotation", 0.1)
    assert turned.reaction(0, "rotation") == pytest.approx(moment, rel=1e-6)


def test_order_is_of_the_finest_pair_above_round_off():
    fourth = {3: 16e-4, 6: 1e-4, 12: 1e-4 / 16, 24: 1e-9}
    assert elements.order(fourth) == pytest.approx(4.0)
    assert isnan(elements.order(fourth | {24: -1e-6}))
    assert isnan(elements.order(dict.fromkeys((3, 6, 12, 24), 1e-9)))


def test_errors_as_text():
    shown = [elements.percent(value) for value in (2e-7, 4.4e-6, -1.234e-3, -0.51234, 11.0, nan)]
    assert shown == ["< 0.0001", "+0.0004", "-0.12", "-51", "> 999", "none"]


def test_table_of_the_readme():
    told = readme.table(elements.HEAD[0])
    assert {element for _, element, *_ in told} == {*elements.ELEMENTS}
    for row in told:
        (now,) = (new for new in elements.rows(NAMES[row[0]]) if new[1] == row[1])
        assert readme.words(row) == readme.words(now)
        *errors, order = readme.numbers(row)
        *errors_now, order_now = readme.numbers(now)
        assert errors == pytest.approx(errors_now, rel=0.1, abs=1e-4)
        assert order == pytest.approx(order_now, rel=0.1 if row[-1] == "-" else 0.01)
