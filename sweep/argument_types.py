"""Explains arguments of the public functions that have a wrong type, in a sentence.

Functions themselves check arguments whose wrong values would otherwise be mistaken for others.
Everything else ends in a `TypeError` or an `AttributeError` of Python somewhere inside, which is
turned into a `MisfitError` here if an argument is to blame.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, wraps
from inspect import Parameter, Signature, formatannotation, signature
from os import PathLike
from typing import Any, ParamSpec, TypeVar

from sweep.config.faults import MisfitError

P = ParamSpec("P")
R = TypeVar("R")
ABSTRACT: Mapping[str, Any] = {
    "PathLike": PathLike,
    "Mapping": Mapping,
    "Sequence": Sequence,
    "Callable": Callable,
    "float": (float, int),
    "Quantity": (float, int, str),
}
WORDS = {
    "str": "text",
    "PathLike": "a path",
    "Mapping": "a dict",
    "Sequence": "a list",
    "int": "a whole number",
    "float": "a number",
    "Quantity": 'a quantity such as "25 g"',
}
ANY = {"Any", "object"}
LONGEST = 60  # most characters of a value
_INSIDE = re.compile(r"\[[^\[\]]*\]")


@cache
def explained(function: Callable[P, R]) -> Callable[P, R]:
    """The public function, which explains a wrong argument where Python only fails."""

    @wraps(function)
    def called(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return function(*args, **kwargs)
        except (TypeError, AttributeError):
            if wrong := next(_misfits(function, args, kwargs), ""):
                raise MisfitError(f"crumple.{function.__qualname__}: {wrong}") from None
            raise

    called.__module__ = __name__.rpartition(".")[0]  # where pickle finds it
    return called


def _misfits(
    function: Callable[..., Any], args: Sequence[object], kwargs: Mapping[str, object]
) -> Iterator[str]:
    """The faults of the arguments of a call."""
    takes = signature(function)
    try:
        bound = takes.bind(*args, **kwargs)
    except TypeError as error:
        yield f"{error}; its arguments: {', '.join(_names(takes)) or 'none'}"
        return
    for name, value in bound.arguments.items():
        parameter = takes.parameters[name]
        types = _types(parameter)
        is_known = types and parameter.kind is not Parameter.VAR_KEYWORD
        if is_known and not _fits(value, types):
            text = " ".join(repr(value).split())
            text = text if len(text) <= LONGEST else f"{text[:LONGEST]}..."
            words = [WORDS.get(word, word) for word in types]
            yield f"{name} = {text}; allowed: {', '.join(words)}"


def _names(takes: Signature) -> Iterator[str]:
    """The arguments of a function; for a dict of keywords, its keys."""
    for name, parameter in takes.parameters.items():
        if parameter.annotation is Parameter.empty:  # self
            continue
        packed = parameter.annotation.__args__ if parameter.kind is Parameter.VAR_KEYWORD else ()
        yield from packed[0].__annotations__ if packed else [name]


def _types(parameter: Parameter) -> list[str]:
    """The names of the types that a parameter may have, without modules and contents; none of
    `self`.
    """
    text = parameter.annotation
    if text is Parameter.empty:
        return []
    text = text if isinstance(text, str) else formatannotation(text)
    while text != (text := _INSIDE.sub("", text)):
        pass
    return [part.strip().rpartition(".")[2] for part in text.split("|")]


def _fits(value: object, types: Sequence[str]) -> bool:
    """Whether a value may be of one of these types; unknown types are compared by name."""
    names = {base.__name__ for base in type(value).__mro__}
    return (
        not ANY.isdisjoint(types)
        or (value is None and "None" in types)
        or not names.isdisjoint(types)
        or any(isinstance(value, ABSTRACT[name]) for name in types if name in ABSTRACT)
    )
