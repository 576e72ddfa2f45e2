"""Damping that represents a loss which is not known otherwise."""

from typing import Any, ClassVar, Literal

from sweep.config.kinds.body import Body
from sweep.config.kinds.loading import Loading
from sweep.config.kinds.table import Inputs, Lag, Rate, RefusedError, Table, own_values


class NoDamping(Table):
    """No damping: also for a quasi-static crush, and by default for a material that relaxes."""

    because: ClassVar[str] = 'damping.model is "none"'

    model: Literal["none"] = "none"


class Rayleigh(Table):
    """Rayleigh damping alpha M + beta K: `mass` alpha, `stiffness` beta."""

    because: ClassVar[str] = 'damping.model is "rayleigh"'

    model: Literal["rayleigh"] = "rayleigh"
    mass: Rate = 5.0
    stiffness: Lag = 1e-4


class KelvinVoigt(Table):
    """Viscosity = modulus x `relaxation_time`."""

    because: ClassVar[str] = 'damping.model is "kelvin_voigt"'

    model: Literal["kelvin_voigt"] = "kelvin_voigt"
    relaxation_time: Lag = 1e-4


Damping = NoDamping | Rayleigh | KelvinVoigt


def damping(inputs: Inputs, loading: Loading, body: Body, relaxes: bool) -> Damping:
    """The damping of these values; shells have none."""
    model = inputs.get("model", "none" if relaxes or body.shells else "rayleigh")
    if body.shells and model != "none":
        raise RefusedError("damping.model", model, f'"none" {body.where}')
    if loading.quasi_static or model == "none":
        return NoDamping()
    if model == "rayleigh":
        return Rayleigh.model_validate(_usual(inputs, loading) | {"model": "rayleigh"})
    return KelvinVoigt.model_validate(own_values(inputs, KelvinVoigt))


def _usual(inputs: Inputs, loading: Loading) -> dict[str, Any]:
    """The values of Rayleigh damping; mass-proportional damping is zero where the base moves
    freely.

    It would hold the lattice back in space, and take momentum from striker and base.
    """
    if not loading.base_moves:
        return own_values(inputs, Rayleigh)
    if inputs.get("mass"):
        raise RefusedError("damping.mass", inputs["mass"], "0 if loading.target_mass is given")
    return own_values(inputs, Rayleigh) | {"mass": 0.0}
