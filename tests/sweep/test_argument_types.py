"""Arguments of another type are answered with a sentence of ours."""

import pickle
from collections.abc import Mapping
from pathlib import Path

import pytest

import crumple
from sweep.argument_types import explained


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: crumple.case("x"), "case: too many positional arguments; its arguments: lattice"),
        (lambda: crumple.rank(None), "rank: source = None; allowed: text, a path, DataFrame$"),
        (lambda: crumple.read_summary(3), "read_summary: path = 3; allowed: text, a path$"),
        (lambda: crumple.read_history(), "missing a required argument: 'path'; its arguments: pa"),
        (lambda: crumple.rank("a.h5", tops=1), "unexpected keyword argument 'tops'"),
        (lambda: crumple.materials(3), "too many positional arguments; its arguments: none"),
    ],
)
def test_a_wrong_argument_is_told_with_what_is_allowed(call, told):
    with pytest.raises(crumple.MisfitError, match=told):
        call()


def test_what_is_no_fault_of_an_argument_stays_what_it_is():
    def broken(path: str | Path, more: Mapping[str, int] | None = None) -> None:
        None.lost  # noqa: B018

    for arguments in (("a",), (Path("a"), {"b": 1}), ("a", None)):
        with pytest.raises(AttributeError, match="lost"):
            explained(broken)(*arguments)
    with pytest.raises(crumple.MisfitError, match=r"broken: more = 4; allowed: a dict, None$"):
        explained(broken)("a", 4)


def test_public_functions_can_be_sent_to_other_processes():
    assert pickle.loads(pickle.dumps(crumple.simulate)) is crumple.simulate
