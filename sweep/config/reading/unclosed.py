"""Finds the text, list or table that is left open in a file that is not valid TOML.

The parser of the standard library says where it gave up, which may be many lines after the fault.
"""

import re

_TOKEN = re.compile(
    r"""
    (?P<comment> \#[^\n]* )
  | (?P<many> \"{3} (?: \\. | (?!\"{3}) . )* (?: \"{3,5} | (?P<open_many> \Z ) )
            | '{3} (?: (?!'{3}) . )* (?: '{3,5} | (?P<open_raw> \Z ) ) )
  | (?P<one> " (?: \\[^\n] | [^"\\\n] )* (?: " | (?P<open_one> [\n\\] | \Z ) )
           | ' [^'\n]* (?: ' | (?P<open_plain> \n | \Z ) ) )
  | (?P<key> ^[ \t]* (?: (?: [\w-]+ | "[^"\n]*" ) [ \t]* \.? [ \t]* )+ = )
  | (?P<bracket> [\[\]{}] )
  | (?P<end> \n )
    """,
    re.VERBOSE | re.MULTILINE | re.DOTALL,
)
_CLOSING = {"[": "]", "{": "}"}
_WHAT = {"[": "list", "{": "table"}


def unclosed(text: str) -> str | None:
    """A sentence with the line of the first thing that is not closed; None if all is closed."""
    opened: list[tuple[str, int]] = []  # brackets and their places
    for token in _TOKEN.finditer(text):
        quote = _open_quote(token)
        if quote:
            return _sentence(text, token.start(), "text", quote)
        if opened and (token["key"] or (token["end"] and opened[-1][0] == "{")):
            return _bracket(text, *opened[-1])
        if token["key"] or not token["bracket"]:
            continue
        if token["bracket"] in _CLOSING:
            opened.append((token["bracket"], token.start()))
        elif opened and token["bracket"] == _CLOSING[opened[-1][0]]:
            opened.pop()
        elif opened:
            return _bracket(text, *opened[-1])
    return _bracket(text, *opened[-1]) if opened else None


def _open_quote(token: re.Match[str]) -> str:
    """The quote that a text lacks; empty if it has it, or if the token is no text."""
    if token["open_many"] is not None or token["open_raw"] is not None:
        return 3 * token.group()[0]
    ended = token["open_one"] is None and token["open_plain"] is None
    return "" if ended else token.group()[0]


def _bracket(text: str, bracket: str, place: int) -> str:
    first = not text[text.rfind("\n", 0, place) + 1 : place].strip()
    what = "name of a table" if first and bracket == "[" else _WHAT[bracket]
    return _sentence(text, place, what, _CLOSING[bracket])


def _sentence(text: str, place: int, what: str, missing: str) -> str:
    """Line, column and the line itself, shortened."""
    number = text.count("\n", 0, place) + 1
    begin = text.rfind("\n", 0, place) + 1
    line = text[begin:].split("\n", 1)[0].strip()
    shown = line if len(line) <= 60 else f"{line[:57]}..."
    return f"line {number}, {shown}: the {what} that begins there is not closed; missing: {missing}"
