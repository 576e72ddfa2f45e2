"""States of a 2 x 2 grid in which every term of a step acts, and steps that end there."""

import numpy as np

from sweep.config.case import Case
from sweep.scene.lattice import build_scene
from tests.support.designs.tables import material_with
from tests.support.kernels.solving import whole

DT = 1e-3
RAYLEIGH = dict(model="rayleigh", mass=300.0, stiffness=1e-3)
VISCOUS = dict(model="kelvin_voigt", relaxation_time=1e-3)
CURVE = material_with(name="ninjaflex", bend="linear")
SIZE = 12.5e-3
GRIP = dict(friction=0.3, slip_speed=0.1)  # smoothed below 0.1 mm in a step
SLIDE = dict(friction=0.3, slip_speed=1e-4)


def grid(elements=3, sizes=None, **tables):
    """The scene of a 2 x 2 grid whose joints are points; sizes: of its lattice, m."""
    cells = dict(cells_x=2, cells_y=2, nodes_per_wall=elements - 1)
    usual = {"material": CURVE, "contact": GRIP, "solver": dict(joints="points")}
    return build_scene(Case.of(lattice=cells | (sizes or {}), **usual | tables))


def loaded(elements=3, platen="contact", damping=RAYLEIGH, size=1.0, **tables):
    """A grid ``size`` times as large as the usual one, under as much stress as by 3 N."""
    sizes = dict(width=SIZE, height=SIZE, depth=12e-3, wall_thickness=1.2e-3)
    loading = dict(force=3.0 * size**2, platen=platen, duration=0.01)
    chosen = {"solver": dict(time_step=DT, joints="points")} | tables
    scaled = {key: size * value for key, value in sizes.items()}
    return grid(elements, scaled, loading=loading, damping=damping, **chosen)


def driven(platen, elements=3):
    """A grid that is pressed quasi-statically."""
    loading = dict(mode="displacement", strain=0.5, platen=platen)
    return grid(elements, loading=loading, contact={})


def struck(platen):
    """A grid between a striker and a base that moves freely."""
    return grid(loading=dict(striker_mass=0.05, target_mass=0.2, platen=platen))


def unit(scene):
    """Size of a coordinate (n,): the length of an element, 1 rad."""
    size = np.full(scene.x_rest.size, scene.mesh.rest_length.mean())
    size[2 * len(scene.mesh.points) : -2] = 1.0
    return size


def nodes(scene, x):
    """View of the nodes (n, 2) of a state."""
    return x[: 2 * len(scene.mesh.points)].reshape(-1, 2)


def shaken(scene, x, seed, amount):
    """State ``x`` with all but the platens moved at random, in units of each coordinate."""
    move = amount * np.random.default_rng(seed).uniform(-1, 1, x.size)
    move[-2:] = 0.0
    return x + unit(scene) * move


def bent(scene, seed=0):
    return pressed(scene, shaken(scene, scene.x_rest, seed, 0.2))


def pinched(scene, seed=0):
    """The side walls of the lower left cell bulge inwards until they touch; platens press."""
    x, t = scene.x_rest.copy(), scene.mesh.thickness[0]
    points = nodes(scene, x)
    size = np.ptp(points, axis=0)
    for side, way in ((0.0, 1.0), (0.5, -1.0)):
        high = points[:, 1] / size[1]
        inner = (abs(points[:, 0] / size[0] - side) < 0.05) & (high > 0.1) & (high < 0.4)
        points[inner, 0] += way * (0.25 * size[0] - 0.35 * t)
    return pressed(scene, shaken(scene, x, seed, 0.03))


def leaning(scene, seed=0):
    """Cells sheared until their corners open by 11 degrees: folds act, and walls touch."""
    x = scene.x_rest.copy()
    points, lean = nodes(scene, x), np.radians(79.0)
    points[:] = np.column_stack(
        [points[:, 0] + points[:, 1] * np.sin(lean), points[:, 1] * np.cos(lean)]
    )
    return pressed(scene, shaken(scene, x, seed, 0.02))


def pressed(scene, x):
    """The platens moved to where they touch the outer nodes."""
    y, t = nodes(scene, x)[:, 1], scene.mesh.thickness[0]
    x[-2:] = y.min() - 0.3 * t, y.max() + 0.3 * t
    return x


STATES = {"bent": bent, "pinched": pinched, "leaning": leaning}


def step_to(scene, x, seed, dt=DT):
    """A step that ends in ``x``: from nearby, at a random velocity."""
    x0 = shaken(scene, x, 100 + seed, 0.02)
    x0[-2:] += 0.02 * unit(scene)[-2:]
    v = 200.0 * unit(scene) * np.random.default_rng(200 + seed).uniform(-1, 1, x.size)
    return whole(scene, x, x0, dt, v if np.isfinite(dt) else None, 0.7)


SCENES = {
    "free top": lambda: loaded(platen="none"),
    "loose platen": loaded,
    "loose and glued": lambda: loaded(platen="glued"),
    "loose and glued, 1": lambda: loaded(1, "glued"),
    "driven and glued": lambda: driven("glued"),
    "driven and loose": lambda: driven("contact"),
    "free base, glued": lambda: struck("glued"),
    "free base, loose": lambda: struck("contact"),
    "driven and loose, 6": lambda: driven("contact", 6),
}
