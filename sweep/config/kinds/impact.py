"""An impact: a striker hits the lattice; the run ends when it is back, or at `duration`."""

from math import isclose, nan, pi, sqrt
from typing import Any, ClassVar, Final, Literal, Self

from sweep.config.drop_tests import Drop, drop_of
from sweep.config.kinds.body import Body
from sweep.config.kinds.crush import PLATENS
from sweep.config.kinds.directed import Ramp
from sweep.config.kinds.direction import ACROSS, is_along
from sweep.config.kinds.solver import IN_TIME, MAX_STEPS, Solver
from sweep.config.kinds.striker import WithStriker
from sweep.config.kinds.table import (
    Count,
    Duration,
    Energy,
    Forces,
    Inputs,
    Length,
    Mass,
    RefusedError,
    Speed,
    given_or,
    own_values,
)
from sweep.constants import SAMPLES, STANDARD_GRAVITY

DROP: Final = "drop"  # `mode` of an impact with gravity
STEPS_OF_PASSAGE = 1000  # time steps in which a free striker travels the lattice's height
STEPS_OF_CONTACT = 20  # time steps in which a solid block would return a striker
PASSAGES = 10  # default duration / time in which the striker travels the lattice's height


class Impact(WithStriker):
    """A rigid striker of `striker_mass` that hits the lattice at `striker_speed`.

    `drop_height` and `preset` (`drop_tests`) are other ways to give its speed and mass, `specimens`
    sets the share of the mass of the preset that one specimen bears. `filter_class`: class of the
    filter behind which its deceleration and the force on the support are measured (SAE J211-1);
    1000 as for a head form in drop tests (ASTM F1292). `gravity`: whether its weight acts after the
    first touch too, by default in drops: with `mode` "drop", `drop_height` or `preset`.
    `target_mass`: mass of the base, a rigid body that moves freely away from the hit, and falls
    like the striker; None: the base is fixed.
    """

    because: ClassVar[str] = 'loading.mode is "impact"'
    labels: ClassVar[tuple[str, ...]] = ("drop_height", "preset", "specimens")
    neutral: ClassVar[dict[str, Any]] = WithStriker.neutral | {
        "filter_class": 1000,
        "gravity": False,
    }
    replaces: ClassVar[dict[str, tuple[str, ...]]] = {
        "striker_mass": ("energy", "preset", "specimens"),
        "striker_speed": ("energy", "drop_height", "preset", "specimens"),
        "energy": ("striker_speed", "drop_height", "preset", "specimens"),
        "drop_height": ("striker_speed", "energy", "preset", "specimens", "gravity"),
        "preset": ("striker_mass", "striker_speed", "energy", "drop_height", "gravity"),
        "specimens": ("striker_mass", "energy"),
        "target_mass": ("gravity",),
    }
    words: ClassVar[tuple[str, ...]] = ("impact", DROP)
    quasi_static: ClassVar[bool] = False
    cycles: ClassVar[int] = 1

    mode: Literal["impact"] = "impact"
    striker_mass: Mass
    striker_speed: Speed
    energy: Energy
    drop_height: Length
    preset: str | None = None
    specimens: Count | None = None
    gravity: bool = False
    target_mass: Mass | None = None
    filter_class: Literal[60, 180, 600, 1000] = 1000
    duration: Duration
    platen: Literal["contact", "glued", "sliding", "clamped"] = "glued"
    allowed_forces: Forces = ()

    @classmethod
    def of(cls, inputs: Inputs, body: Body, integrator: str | None, relaxes: bool) -> Self:
        """The impact of these values."""
        only = 'if loading.mode is "impact"'
        if integrator == "static":
            raise RefusedError("solver.integrator", "static", f"{IN_TIME} {only}")
        if inputs.get("platen") == "none":
            raise RefusedError("loading.platen", "none", f"{PLATENS} {only}")
        if "target_mass" in inputs:
            _check_target(inputs)
        mass, drop_height = _dropped(inputs)
        speed, energy, fall = _at_touch(inputs, mass, drop_height)
        motion = {"striker_mass": mass, "striker_speed": speed, "energy": energy}
        fixed = {"drop_height": fall, "mode": "impact"}
        falls = is_drop(inputs) and "target_mass" not in inputs
        usual = {"duration": PASSAGES * body.height / speed, "gravity": falls}
        return cls.model_validate(usual | own_values(inputs, cls) | motion | fixed)

    def ramps(self, solver: Solver) -> list[Ramp]:
        """The motion of the striker, which may end before its duration."""
        return [Ramp("struck", load=(1.0, 1.0), time=self.duration, watched=True)]

    def loaded_for(self, height: float) -> float:
        """The time of a striker's passage, and back, s."""
        return 2.0 * height / self.striker_speed

    def usual_motion(self, given: Inputs, body: Body, modulus: float) -> dict[str, Any]:
        """Steps of bdf2, whose error is a tenth of the error of backward Euler; at most
        `MAX_STEPS`.
        """
        step = max(self.contact_step(body, modulus), self.duration / MAX_STEPS)
        return {"integrator": "bdf2", "time_step": step}

    def contact_step(self, body: Body, modulus: float) -> float:
        """A share of the duration of contact, s; modulus: of the material, Pa.

        A fast striker is stopped within the height of the lattice, in which its weight speeds it
        up. A slow one rebounds as from a spring of compliance c, after pi sqrt(m c) whatever its
        speed, with the reduced mass m; for a solid block, this time is a lower bound. The filter of
        forces needs rows of at most 1 / (10 class).
        """
        passage = body.height / self.greatest_speed(body.height) / STEPS_OF_PASSAGE
        contact = pi * sqrt(self.reduced_mass * body.compliance(modulus)) / STEPS_OF_CONTACT
        return min(passage, contact, 1.0 / (SAMPLES * self.filter_class))

    @property
    def weight(self) -> float:
        """The weight of the striker, N; 0 without gravity."""
        return self.striker_mass * STANDARD_GRAVITY if self.gravity else 0.0

    @property
    def reduced_mass(self) -> float:
        """M m / (M + m) in kg, the inertia of a change of the distance of striker and base."""
        m, target = self.striker_mass, self.target_mass
        return m if target is None else m * target / (m + target)

    @property
    def relative_energy(self) -> float:
        """Kinetic energy of striker and base in the frame of their centre of mass, J.

        It is the energy that the lattice can absorb; the rest stays in the common motion.
        """
        return self.energy * self.reduced_mass / self.striker_mass

    def greatest_speed(self, height: float) -> float:
        """Speed (m/s) at which the striker would meet the base, if nothing were in its way."""
        fall = 2.0 * self.weight / self.striker_mass * height
        return sqrt(self.striker_speed**2 + fall)

    @property
    def columns(self) -> dict[str, float]:
        """Its columns of a results file."""
        return {
            "striker_mass_g": 1e3 * self.striker_mass,
            "striker_speed_m_per_s": self.striker_speed,
            "impact_energy_J": self.energy,
            "gravity": float(self.gravity),
            "target_mass_g": 1e3 * given_or(self.target_mass, nan),
        }


def is_drop(inputs: Inputs) -> bool:
    """Whether these values of an impact describe a fall."""
    return inputs.get("mode") == DROP or "drop_height" in inputs or "preset" in inputs


def _check_target(inputs: Inputs) -> None:
    """Refuse settings that a freely moving target excludes: gravity, and walls along the hit."""
    free = "if loading.target_mass is given"
    if inputs.get("gravity"):
        allowed = f"false {free}, as a target that moves freely falls like the striker"
        raise RefusedError("loading.gravity", True, allowed)
    if is_along(inputs):
        raise RefusedError("loading.direction", inputs["direction"], f'"{ACROSS}" {free}')


def _dropped(inputs: Inputs) -> tuple[float, float | None]:
    """Mass of the striker and height of its fall, from the preset if it states them."""
    mass, height, count = (inputs.get(key) for key in ("striker_mass", "drop_height", "specimens"))
    preset = inputs.get("preset")
    drop = drop_of(preset) if preset else Drop(None, height or 0.0)
    if count and drop.mass is None:
        raise RefusedError("loading.specimens", count, "none unless loading.preset has a mass")
    if preset and drop.mass is None and mass is None:
        allowed = "the mass that falls, as the preset has none"
        raise RefusedError("loading.striker_mass", None, allowed)
    usual = given_or(mass, 0.05) if drop.mass is None else drop.mass / (count or 1)
    if not isclose(given_or(mass, usual), usual, rel_tol=1e-9):
        allowed = f"{usual:g} kg, as loading.preset is given"
        raise RefusedError("loading.striker_mass", mass, allowed)
    if not isclose(given_or(height, drop.height), drop.height, rel_tol=1e-9):
        allowed = f"{drop.height:g} m, as loading.preset is given"
        raise RefusedError("loading.drop_height", height, allowed)
    return usual, drop.height or None


def _at_touch(inputs: Inputs, mass: float, drop_height: float | None) -> tuple[float, float, float]:
    """Speed and energy of a striker and the height of its fall, from one of them: v^2 = 2 g h.

    The speed is 2 m/s if none is given.
    """
    speed = inputs.get("striker_speed", 2.0)
    if "striker_speed" not in inputs and drop_height is not None:
        speed = sqrt(2.0 * STANDARD_GRAVITY * drop_height)
    elif "striker_speed" not in inputs and "energy" in inputs:
        speed = sqrt(2.0 * inputs["energy"] / mass)
    energy, fall = 0.5 * mass * speed * speed, speed * speed / (2.0 * STANDARD_GRAVITY)
    source = "speed" if "striker_speed" in inputs else "drop height"
    for key, value, follows, unit in (
        ("drop_height", drop_height, fall, "m"),
        ("energy", inputs.get("energy"), energy, "J"),
    ):
        if not isclose(given_or(value, follows), follows, rel_tol=1e-9):
            of = "preset" if key == "drop_height" and "drop_height" not in inputs else key
            allowed = f"{follows:g} {unit} at the {source} given; give one of them"
            raise RefusedError(f"loading.{of}", inputs.get(of), allowed)
    return speed, inputs.get("energy", energy), given_or(drop_height, fall)
