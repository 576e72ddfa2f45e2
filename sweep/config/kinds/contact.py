"""Contact between walls and with platens."""

from typing import ClassVar, Literal

from sweep.config.kinds.body import Body
from sweep.config.kinds.loading import Loading
from sweep.config.kinds.solver import ARCS
from sweep.config.kinds.specimen import TIED
from sweep.config.kinds.table import (
    Inputs,
    NonNegative,
    Positive,
    RefusedError,
    Speed,
    Table,
    own_values,
)

SLIP = 0.01  # default slip speed / speed of the platen or the striker
REFERENCE_SPEED = 0.1  # m/s, if nothing has a speed


class Forceless(Table):
    """A contact that exerts no force."""

    friction: ClassVar[float] = 0.0
    stiffness: ClassVar[float] = 0.0
    slip_speed: ClassVar[None] = None


class NoContact(Forceless):
    """A scene in which nothing can touch."""

    because: ClassVar[str] = 'contact.model is "none"'

    model: Literal["none"] = "none"


class Barrier(Table):
    """The barrier, which acts if walls come within one thickness of each other.

    model "none": only with platens and a floor. `stiffness`: the factor c. `slip_speed`: None in
    statics, where slip is a length.
    """

    because: ClassVar[str] = "the crush is quasi-static"

    model: Literal["barrier", "none"] = "barrier"
    friction: NonNegative = 0.3
    stiffness: Positive = 1.0
    slip_speed: Speed | None = None


class ByPosition(Forceless):
    """Walls that are too close are moved apart after each step, as in the course report."""

    because: ClassVar[str] = 'contact.model is "position_based"'

    model: Literal["position_based"] = "position_based"


Contact = NoContact | Barrier | ByPosition


def contact(inputs: Inputs, loading: Loading, body: Body, integrator: str) -> Contact:
    """The contact of these values.

    Loose platens and a floor need the barrier even if the contact model is "none". Friction is zero
    along arcs, since the unstable parts of an equilibrium path are not a motion.
    """
    model = inputs.get("model", "auto")
    if model == "position_based":
        return _by_position(loading, body, integrator)
    structure = body.structure
    floor = structure is not None and structure.floor_y_mm is not None
    if model == "none" and loading.platen != "contact" and not floor:
        return NoContact()
    acts = own_values(inputs, Barrier) | {"model": "barrier" if model == "auto" else model}
    if integrator == ARCS:
        return Barrier.model_validate(acts | {"friction": 0.0, "slip_speed": None})
    if loading.quasi_static or not acts.get("friction", 0.3):
        return Barrier.model_validate(acts | {"slip_speed": None})
    slip_speed = SLIP * (loading.approach or REFERENCE_SPEED)
    return Barrier.model_validate({"slip_speed": slip_speed} | acts)


def _by_position(loading: Loading, body: Body, integrator: str) -> ByPosition:
    """Contact by position, which exerts no force: it can neither carry a platen nor cause
    friction.
    """
    if body.shells:
        raise RefusedError("contact.model", "position_based", f'"barrier" or "none" {body.where}')
    for excluded, where in (
        (loading.quasi_static, "if loading.quasi_static"),
        (loading.base_moves, "if loading.target_mass is given"),
        (loading.platen == "contact", 'if loading.platen is "contact"'),
        (loading.is_shaped, 'unless loading.striker and loading.base are "flat"'),
        (body.structure is not None, 'if lattice.kind is "custom"'),
        (body.tied_sides, TIED),
    ):
        if excluded:
            raise RefusedError("contact.model", "position_based", f'"none" or "barrier" {where}')
    if integrator != "backward_euler":
        only = '"backward_euler" if contact.model is "position_based"'
        raise RefusedError("solver.integrator", integrator, only)
    return ByPosition()
