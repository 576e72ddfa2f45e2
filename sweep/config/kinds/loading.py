"""The kinds of loading, and which of them a config means."""

from math import inf
from typing import Annotated, NamedTuple

from pydantic import Field

from sweep.config.kinds.crush import Crush, crush, mean_crush
from sweep.config.kinds.dead_load import DeadLoad, dead_load
from sweep.config.kinds.direction import WHERE
from sweep.config.kinds.impact import DROP, Impact, impact
from sweep.config.kinds.of_file import OfFile, of_file
from sweep.config.kinds.solver import ARCS, IN_TIME
from sweep.config.kinds.specimen import ENDLESS, TIED
from sweep.config.kinds.striker import struck
from sweep.config.kinds.table import Given, Pairs, RefusedError, Table
from sweep.config.structures.structure import Structure

Loading = Annotated[DeadLoad | Crush | Impact | OfFile, Field(discriminator="mode")]
BY_MODE = (DeadLoad, Crush, Impact)  # chosen by `loading.mode`, or by keys that only one has
MODES = '"displacement" or "impact"'
PLATENS_ALONG = '"glued", "clamped" or "contact"'
PLATENS_ACROSS = '"contact", "glued" or "sliding"'


class Pressed(NamedTuple):
    """What a loading presses: its height (m), whether along the cells; a custom structure; whether
    it is endless, whether its sides are tied to each other; its width (m); the name of a sheet.
    """

    height: float
    along: bool
    structure: Structure | None = None
    endless: bool = False
    tied: bool = False
    width: float = inf
    sheet: str = ""

    @property
    def shells(self) -> bool:
        """Whether the walls are shells in space."""
        return self.along or bool(self.sheet)

    @property
    def where(self) -> str:
        """Why they are, as part of a sentence."""
        return f'if lattice.kind is "{self.sheet}"' if self.sheet else WHERE

    @property
    def unending(self) -> str:
        """Why there is no middle of the lattice to strike; nothing if there is one."""
        if self.sheet:
            return self.where
        return ENDLESS if self.endless else TIED if self.tied else ""


def loading(
    values: Given | Pairs, pressed: Pressed, integrator: str | None, relaxes: bool
) -> Loading:
    """The loading of these values; relaxes: whether the stress of the material depends on time."""
    given = dict(values)
    if pressed.structure is not None and not pressed.along:
        return of_file(given, pressed.structure, integrator)
    mode = mode_of(given, pressed.shells)
    _check(given, mode, pressed, integrator)
    given = struck(given, pressed.width, pressed.unending)
    if pressed.endless:
        return mean_crush(given, pressed.height, integrator, relaxes)
    if mode == "force":
        return dead_load(given, integrator)
    if mode == "impact":
        return impact(given, pressed.height, integrator)
    return crush(given, pressed.height, integrator, relaxes)


def mode_of(given: Given, shells: bool) -> str:
    """The mode, which keys that only one mode has imply if it is not given; else a dead load, and
    of shells a crush.
    """
    if "mode" in given:
        words = [*(mode_word(kind) for kind in BY_MODE), DROP]
        if given["mode"] not in (*words, "custom"):
            allowed = ", ".join(map('"{}"'.format, words))
            raise RefusedError("loading.mode", given["mode"], allowed)
        return "impact" if given["mode"] == DROP else str(given["mode"])
    implied = _implied(given)
    if len(implied) > 1:
        (one, key), (other, also) = list(implied.items())[:2]
        keys = f"as loading.{key} needs the one and loading.{also} the other"
        raise RefusedError("loading.mode", None, f'"{one}" or "{other}", {keys}')
    usual = "displacement" if shells else "force"
    return next(iter(implied), usual)


def mode_word(kind: type[Table]) -> str:
    """The `loading.mode` of a kind."""
    return str(kind.model_fields["mode"].default)


def _implied(given: Given) -> dict[str, str]:
    """The modes that keys imply, each with the first of its keys."""
    implied: dict[str, str] = {}
    for kind in BY_MODE:
        others = {key for other in BY_MODE if other is not kind for key in other.model_fields}
        own = [key for key in kind.model_fields if key not in others and key in given]
        if own:
            implied[mode_word(kind)] = own[0]
    if "duration" in given and "impact" not in implied:
        implied.setdefault("force", "duration")
    return implied


def _check(given: Given, mode: str, pressed: Pressed, integrator: str | None) -> None:
    """Refuse a mode, an integrator or platens that the lattice or the direction does not have."""
    shells, since = pressed.shells, _implied(given).get(mode)
    because = f"loading.{since}" if since else None
    if shells and mode not in ("displacement", "impact"):
        raise RefusedError("loading.mode", mode, f"{MODES} {pressed.where}", because)
    if mode == "custom":
        allowed = '"force", "displacement" or "impact" unless lattice.kind is "custom"'
        raise RefusedError("loading.mode", "custom", allowed)
    if integrator == ARCS:
        unless = "" if shells else ', unless lattice.kind is "custom"'
        allowed = f'"static" where quasi-static, else {IN_TIME}{unless}'
        raise RefusedError("solver.integrator", ARCS, allowed)
    if pressed.endless and mode != "displacement":
        allowed = '"displacement" if lattice.boundary is "periodic"'
        raise RefusedError("loading.mode", mode, allowed, because)
    platen = given.get("platen")
    if pressed.sheet and "target_mass" in given:
        raise RefusedError("loading.target_mass", given["target_mass"], f"none {pressed.where}")
    if pressed.tied and not shells and platen in (None, "none") and (platen or mode == "force"):
        raise RefusedError("loading.platen", platen, f"{PLATENS_ACROSS} {TIED}", because)
    if shells and platen not in (None, "glued", "clamped", "contact"):
        raise RefusedError("loading.platen", platen, f"{PLATENS_ALONG} {pressed.where}")
    if not shells and not pressed.endless and platen == "clamped":
        allowed = f'{PLATENS_ACROSS} if loading.direction is "in_plane"'
        raise RefusedError("loading.platen", platen, allowed)
