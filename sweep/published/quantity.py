"""A measured value as people write it: "0.12 +- 0.018 J", "0.078 .. 0.081 MPa", "38 %"."""

import re

from sweep.config.faults import MisfitError
from sweep.config.materials.material_header import ALLOWED, number_with_range
from sweep.config.units import in_si
from sweep.published.table import PublishedError

_PARTS = re.compile(r"((?:[\d.+() -]|[eE](?=[+-]?\d))*)(.*)")


def split_quantity(text: str, units: str) -> tuple[str, str, float]:
    """A measured value: its number with its scatter as text, its unit, and the size of the unit in
    ``units``, of its column; "1" for a pure number.
    """
    match = _PARTS.fullmatch(text.strip())
    number, unit = (match[1].strip(), match[2].strip()) if match else ("", text)
    try:
        number_with_range("measured", number)
        if not unit and units != "1":
            raise MisfitError(f'a bare number; needed: a unit, such as "{units}"')
        per = in_si(f"1 {unit}", units) / in_si(f"1 {units}", units) if unit else 1.0
    except MisfitError as error:
        why = str(error).removeprefix("# measured: ")
        allowed = f"{ALLOWED} with a unit, or a csv file of a curve"
        raise PublishedError(f"--measured {text}: {why}; allowed: {allowed}") from None
    return number, unit, per
