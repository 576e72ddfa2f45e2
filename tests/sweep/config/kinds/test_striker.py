"""Keys of strikers and ribs: keys of each kind, consequences, and refusals."""

from math import pi

import pytest

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError

EDGE = dict(striker="edge", striker_angle=1.0, striker_tip=1e-3)


def struck(mode="displacement", **loading):
    return Case.of(loading=dict(mode=mode, **loading))


@pytest.mark.parametrize("mode", ["displacement", "impact", "force"])
def test_a_flat_striker_is_what_a_case_without_one_has(mode):
    """The id too; and platens are unchanged."""
    assert struck(mode, striker="flat", base="flat").case_id == struck(mode).case_id
    assert not struck(mode).loading.is_shaped
    assert struck(mode).loading.striker_at is None


@pytest.mark.parametrize("mode", ["displacement", "impact"])
def test_a_striker_has_the_keys_of_its_kind_alone(mode):
    edge = struck(mode, **EDGE, striker_radius=2e-3, striker_width=1e-3).loading
    assert (edge.striker_angle, edge.striker_tip, edge.striker_at) == (1.0, 1e-3, 0.5)
    assert edge.striker_radius is edge.striker_width is edge.base_span is None
    assert edge.platen == "glued"
    assert edge.is_shaped


def test_defaults_of_the_kinds():
    assert struck(striker="round").loading.striker_radius == 5e-3
    assert struck(striker="edge").loading.striker_angle == pi / 2
    assert struck(striker="punch").loading.striker_width == 10e-3
    ribs = struck(base="ribs", base_span=9e-3).loading
    assert (ribs.base_radius, ribs.platen, ribs.striker) == (1e-3, "contact", "flat")


def test_equal_strikers_have_equal_ids_and_others_others():
    usual = struck(striker="round").case_id
    assert struck(striker="round", striker_radius=5e-3).case_id == usual
    at, ribs = dict(striker_at=0.4), dict(base="ribs", base_span=9e-3)
    assert len({usual, *(struck(striker="round", **keys).case_id for keys in (at, ribs))}) == 3


def test_a_flat_striker_drops_the_keys_of_others():
    case = struck("impact", **EDGE, base="ribs", base_span=9e-3)
    assert Case.from_json(case.to_json()) == case
    assert case.changed(loading={"striker": "flat"}).loading.striker_angle is None


def test_words_of_a_striker():
    columns = struck(**EDGE, striker_at=0.25, base="ribs", base_span=9e-3).loading.shape_columns
    assert columns["striker"] == "edge, 57.3 deg, tip 1 mm, at 25 %"
    assert columns["base"] == "ribs, span 9 mm, radius 1 mm"
    assert struck().loading.shape_columns == {"striker": "flat", "base": "flat"}


@pytest.mark.parametrize(
    ("loading", "key", "allowed"),
    [
        (dict(striker="edge", striker_angle=3.1), "striker_angle", "from 10 deg to 170 deg"),
        (dict(striker="punch", striker_width=1e-3, striker_tip=0.6e-3), "striker_tip", "half"),
        (dict(striker="round", striker_at=1.2), "striker_at", "less than or equal to 1"),
        (dict(striker="round", platen="sliding"), "platen", '"contact" or "glued"'),
        (dict(striker="round", mode="force", platen="none"), "platen", '"contact" or "glued"'),
        (dict(base="ribs"), "base_span", "distance of the ribs"),
        (dict(base="ribs", base_span=13e-3), "base_span", "at most the width"),
        (dict(base="ribs", base_span=2e-3), "base_span", "more than twice loading.base_radius"),
        (dict(base="ribs", base_span=9e-3, platen="glued"), "platen", '"contact" if'),
        (dict(striker="round", direction="out_of_plane"), "striker", '"flat" if loading.dir'),
        (dict(base="ribs", base_span=9e-3, direction="out_of_plane"), "base", '"flat" if'),
    ],
)
def test_what_is_refused(loading, key, allowed):
    with pytest.raises(RefusedError) as refused:
        struck(**loading) if "direction" not in loading else Case.of(loading=loading)
    assert refused.value.key == f"loading.{key}"
    assert allowed in refused.value.allowed


@pytest.mark.parametrize("key", ["boundary", "sides"])
def test_a_period_has_no_striker(key):
    loading = dict(mode="displacement", striker="round", platen="glued")
    with pytest.raises(RefusedError, match=rf'"flat" if lattice.{key} is "periodic"'):
        Case.of(lattice={key: "periodic"}, loading=loading)


def test_contact_by_position_cannot_carry_a_striker():
    loading, contact = dict(mode="impact", striker="round"), dict(model="position_based")
    with pytest.raises(RefusedError, match=r"unless loading\.striker"):
        Case.of(loading=loading, contact=contact, solver=dict(integrator="backward_euler"))
