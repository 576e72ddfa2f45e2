"""The kinds of loading, and the choice of the kind from a config."""

from typing import Annotated, TypeAlias, get_args

from pydantic import Field

from sweep.config.kinds.body import Body
from sweep.config.kinds.crush import PLATENS, Crush
from sweep.config.kinds.custom_loading import CustomLoading
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.solver import ARCS, IN_TIME
from sweep.config.kinds.specimen import TIED
from sweep.config.kinds.striker import with_striker
from sweep.config.kinds.table import Inputs, RefusedError

Loading: TypeAlias = DeadLoad | Crush | Impact | CustomLoading
KINDS: tuple[type[Loading], ...] = get_args(Loading)
BY_MODE = tuple(
    kind for kind in KINDS if kind is not CustomLoading
)  # chosen by `loading.mode`, or by keys that only one has
AnyLoading = Annotated[Loading, Field(discriminator="mode")]
MODES = '"displacement" or "impact"'
PLATENS_ALONG = '"glued", "clamped" or "contact"'


def loading(inputs: Inputs, body: Body, integrator: str | None, relaxes: bool) -> Loading:
    """The loading of these values; relaxes: whether the stress of the material depends on time."""
    if body.structure is not None and not body.along:
        return CustomLoading.of(inputs, body, integrator, relaxes)
    mode = _mode_of(inputs, body.shells)
    _check(inputs, mode, body, integrator)
    inputs = with_striker(inputs, body.width, body.unending)
    kind = next(kind for kind in BY_MODE if mode in kind.words)
    return kind.of(inputs, body, integrator, relaxes)


def _mode_of(inputs: Inputs, shells: bool) -> str:
    """The mode; if it is not given, keys that only one mode has imply it; else a dead load, for
    shells a crush.
    """
    if "mode" in inputs:
        for kind in KINDS:
            if inputs["mode"] in kind.words:
                return kind.words[0]
        allowed = ", ".join(f'"{word}"' for kind in BY_MODE for word in kind.words)
        raise RefusedError("loading.mode", inputs["mode"], allowed)
    implied = _implied(inputs)
    if len(implied) > 1:
        (one, key), (other, also) = list(implied.items())[:2]
        keys = f"as loading.{key} needs the one and loading.{also} the other"
        raise RefusedError("loading.mode", None, f'"{one}" or "{other}", {keys}')
    usual = "displacement" if shells else "force"
    return next(iter(implied), usual)


def _implied(inputs: Inputs) -> dict[str, str]:
    """The modes that keys imply, each with the first of its keys; a subclass implies its own, in
    place of the mode of its base.
    """
    implied: dict[type[Loading], str] = {}
    for kind in BY_MODE:
        kinds = [other for other in BY_MODE if not issubclass(other, kind)]
        others = {key for other in kinds for key in other.model_fields}
        own = [key for key in kind.model_fields if key not in others and key in inputs]
        if own:
            implied[kind] = own[0]
    if "duration" in inputs and not any("duration" in kind.model_fields for kind in implied):
        implied[DeadLoad] = "duration"
    return {
        kind.words[0]: key
        for kind, key in implied.items()
        if not any(issubclass(other, kind) for other in implied.keys() - {kind})
    }


def _check(inputs: Inputs, mode: str, body: Body, integrator: str | None) -> None:
    """Refuse a mode, an integrator or platens that are not available for the lattice or the
    direction.
    """
    shells, since = body.shells, _implied(inputs).get(mode)
    because = f"loading.{since}" if since else None
    if shells and mode not in ("displacement", "impact"):
        raise RefusedError("loading.mode", mode, f"{MODES} {body.where}", because)
    if mode == "custom":
        allowed = '"force", "displacement" or "impact" unless lattice.kind is "custom"'
        raise RefusedError("loading.mode", "custom", allowed)
    if integrator == ARCS:
        unless = "" if shells else ', unless lattice.kind is "custom"'
        allowed = f'"static" where quasi-static, else {IN_TIME}{unless}'
        raise RefusedError("solver.integrator", ARCS, allowed)
    if body.endless and mode != "displacement":
        allowed = '"displacement" if lattice.boundary is "periodic"'
        raise RefusedError("loading.mode", mode, allowed, because)
    platen = inputs.get("platen")
    if body.sheet and "target_mass" in inputs:
        raise RefusedError("loading.target_mass", inputs["target_mass"], f"none {body.where}")
    if body.tied_sides and not shells and platen in (None, "none") and (platen or mode == "force"):
        raise RefusedError("loading.platen", platen, f"{PLATENS} {TIED}", because)
    if shells and platen not in (None, "glued", "clamped", "contact"):
        raise RefusedError("loading.platen", platen, f"{PLATENS_ALONG} {body.where}")
    if not shells and not body.endless and platen == "clamped":
        none = '"none", ' if mode == "force" and not body.tied_sides else ""
        allowed = f'{none}{PLATENS} if loading.direction is "in_plane"'
        raise RefusedError("loading.platen", platen, allowed)
