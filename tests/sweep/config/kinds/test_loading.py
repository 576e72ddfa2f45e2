"""The tables of a case: what each accepts by itself, and the mode that keys imply."""

from typing import ClassVar, Literal

import pytest

from sweep.config.case import Case
from sweep.config.kinds import loading as loadings
from sweep.config.kinds.body import Body
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.table import Duration, RefusedError
from tests.support.designs.tables import material_with
from tests.support.materials.records import HEADER


def test_a_material_of_numbers_needs_a_density(refused):
    assert refused('[material]\nmodulus = "12 MPa"', "material.density", "no name")


STRAINED = [{"strain": 0.5}, {"stroke": 5e-3}, {"speed": 1e-3}, {"quasi_static": True}]
STRAINED += [{"unload": False}, {"cycles": 2}, {"hold_time": 2.0}]
PUSHED = [{}, {"force": 5.0}, {"duration": 0.3, "strain": None}, {"platen": "contact"}]


@pytest.mark.parametrize(
    ("mode", "given"),
    [*(("displacement", keys) for keys in STRAINED), *(("force", keys) for keys in PUSHED)],
)
def test_keys_of_a_platen_say_the_mode_which_else_is_a_force(mode, given):
    assert Case.of(loading=given) == Case.of(loading=dict(mode=mode, **given))


MEASURED = "# loss: 0.3 (0.2 .. 0.4)\n# softening_r: 2\n# softening_m_Pa: 1e5\n"
MEASURED += HEADER.replace("0.48", "0.48 (0.45 .. 0.48)") + "0.01,2e4\n0.05,1e5\n"


def test_measured_memory_acts_only_if_asked_for(own_record):
    name = str(own_record(MEASURED))
    plain, measured = material_with(name=name), material_with(name=name, memory="measured")
    assert not plain.remembers
    assert (measured.loss, measured.softening_r, measured.softening_beta) == (0.3, 2.0, 0.1)
    assert material_with(name=name, memory="measured", loss=0.2).loss == 0.2
    stated = {"loss": 0.3, "softening_r": 2.0, "softening_m": 1e5}
    by_keys = material_with(name=name, **stated)
    assert Case.of(material=by_keys).case_id == Case.of(material=measured).case_id


def test_uncertain_are_the_numbers_of_the_record_that_are_used(own_record):
    name = str(own_record(MEASURED))
    poisson, loss, rules = ("poisson", 0.45, 0.48), ("loss", 0.2, 0.4), ("compression", 0.0, 1.0)
    assert material_with(name=name).uncertain == (poisson, rules)
    assert set(material_with(name=name, memory="measured").uncertain) == {poisson, loss, rules}
    assert material_with(name=name, memory="measured", poisson=0.4).uncertain == (loss, rules)
    assert material_with(name=name, stretch="linear").uncertain == (poisson,)
    from_origin = str(own_record(MEASURED.replace("stress_Pa\n", "stress_Pa\n0,0\n")))
    assert material_with(name=from_origin).uncertain == (poisson, rules)
    assert material_with(modulus=12e6, density=1190.0).uncertain == ()


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"name": "chetah"}, "allowed: .*cheetah, "),
        ({"memory": "measured"}, 'allowed: "none", as ninjaflex states neither loss'),
        ({"modulus": 1e6, "density": 1e3, "memory": "measured"}, "as no name is given"),
    ],
)
def test_refused(keys, message):
    with pytest.raises(ValueError, match=message):
        material_with(**keys)


def test_keys_of_both_modes_need_the_mode(refused):
    text = '[loading]\nstrain = 0.5\n[grid]\nloading.force = ["3 N", "4 N"]'
    needed = 'needed: "force" or "displacement", as loading.force needs the one and loading.strain'
    assert refused(text, "loading.mode", needed, "(2 of 2 combinations)")


def test_duration_is_a_key_of_loads_and_of_strikers():
    assert Case.of(loading=dict(duration=0.1)).loading.mode == "force"
    assert Case.of(loading=dict(duration=0.1, energy=0.1)).loading.mode == "impact"
    with pytest.raises(RefusedError, match=r'"force" or "impact", as loading\.force needs'):
        Case.of(loading=dict(force=1.0, energy=0.1))


class Creep(DeadLoad):
    """A dead load that grows for a while, as a kind that has the keys of another one."""

    words: ClassVar[tuple[str, ...]] = ("creep",)

    mode: Literal["creep"] = "creep"
    rise_time: Duration = 0.1


@pytest.mark.parametrize("others", [{}, {"force": 2.0}, {"duration": 0.3}])
def test_a_key_of_a_subclass_chooses_it_beside_keys_of_its_base(monkeypatch, others):
    monkeypatch.setattr(loadings, "BY_MODE", (*loadings.BY_MODE, Creep))
    loading = loadings.loading({"rise_time": 0.2, **others}, Body(0.01, False), None, False)
    assert type(loading) is Creep
    assert loading.rise_time == 0.2


def test_a_curve_that_is_not_given_is_missed_where_it_is_used():
    numbers = {"modulus": 12e6, "density": 1190.0}
    for key, word in (("stretch", "nonlinear"), ("bend", "section"), ("bend", "fibres")):
        with pytest.raises(ValueError, match=f'material.{key} = {word}; allowed: "linear", as'):
            material_with(**numbers, **{key: word})
