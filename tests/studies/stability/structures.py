"""Draw custom structures, by every integrator and under every loading, from rest and in motion.

They are kept in no file: a scene is drawn by a generator of its own, from its number.
"""

import json

import numpy as np

from sweep.config.case import Case
from sweep.config.kinds.table import RefusedError
from sweep.config.structures.structure import Structure
from tests.studies.stability.draw import Draws

COUNT, SEED = 300, 43
IN_TIME = "backward_euler", "bdf2", "newmark"
ALIKE = {"max_iterations": 500}
CLAMPED = ["x", "y", "rotation"]


def structure_scene(number):
    """The case of a scene."""
    draw = Draws(number, SEED)
    while True:
        try:
            return _scene(draw)
        except RefusedError:  # structures without statics, or without a load along arcs
            continue


def _scene(draw):
    size, slenderness = draw.between(1e-3, 0.5), draw.between(0.005, 0.3)
    thickness, depth = slenderness * size, draw.between(1e-3, 0.1)
    modulus, density = draw.between(1e3, 2e11), draw.between(50.0, 8000.0)
    area, bending = thickness * depth, modulus * depth * thickness**3 / 12.0
    speed = np.sqrt(modulus / density)  # of sound
    passage, swing = size / speed, size**2 * np.sqrt(density * area / bending)
    parts = draw.one(_cantilever, _portal, _arch, _mast, _pendulum)(draw, size)
    integrator = draw.one(*IN_TIME, *IN_TIME, "static", "arc_length")
    in_time = integrator in IN_TIME
    parts |= _loading(draw, parts, size, bending / size**2, swing, in_time)
    if len(parts["walls"]) == 3 and draw.chance(0.3):  # a portal with a diagonal
        stiffness = 1e-3 * bending / size**3 * draw.between(0.1, 1e3)
        parts["springs"] = [{"nodes": [1, 3], "stiffness_N_mm": stiffness}]
    if draw.chance(0.1):
        weight = draw.between(0.01, 100.0) * density * area * size
        parts["masses"] = [{"node": parts["probes"][0], "mass_g": 1e3 * weight}]
    steps = draw.whole(5, 60)
    solver = {"integrator": integrator, **ALIKE}
    if in_time:
        solver["time_step"] = draw.between(1e-3 * passage, 0.1 * swing)
    else:
        solver["load_steps"] = steps
    return Case.of(
        lattice=dict(
            kind="custom",
            structure=Structure.model_validate_json(
                json.dumps({"wall_thickness_mm": 1e3 * thickness, "depth_mm": 1e3 * depth} | parts)
            ),
        ),
        material=dict(modulus=modulus, density=density, poisson=0.3, plane="stress"),
        loading=dict(duration=steps * solver["time_step"]) if in_time else {},
        contact=dict(model="none") if draw.chance(0.5) or not in_time else {},
        damping=_damping(draw, swing) if in_time else {},
        solver=solver,
    )


def _mm(*points):
    return [[1e3 * float(x), 1e3 * float(y)] for x, y in points]


def _clamped(*nodes):
    return [{"node": node, "fix": CLAMPED} for node in nodes]


def _cantilever(draw, size):
    """One wall, along x as often as not."""
    angle = 0.0 if draw.chance(0.5) else draw.between(0.01, 3.0)
    tip = size * np.cos(angle), size * np.sin(angle)
    return {
        "nodes_mm": _mm((0.0, 0.0), tip),
        "walls": [[0, 1]],
        "subdivide": draw.whole(1, 20),
        "supports": _clamped(0),
        "probes": [1],
    }


def _portal(draw, size):
    """Two columns and a beam; its feet are clamped or hinged."""
    feet = [{"node": k, "fix": draw.one(CLAMPED, ["x", "y"])} for k in (0, 3)]
    return {
        "nodes_mm": _mm((0.0, 0.0), (0.0, size), (size, size), (size, 0.0)),
        "walls": [[0, 1], [1, 2], [2, 3]],
        "subdivide": draw.whole(1, 8),
        "supports": feet,
        "probes": [draw.one(1, 2)],
    }


def _arch(draw, size):
    """Two walls that meet at a crown, shallow or high."""
    return {
        "nodes_mm": _mm((0.0, 0.0), (0.5 * size, draw.between(0.05, 0.6) * size), (size, 0.0)),
        "walls": [[0, 1], [1, 2]],
        "subdivide": draw.whole(2, 12),
        "supports": _clamped(0, 2),
        "pins": [1] if draw.chance(0.2) else [],
        "probes": [1],
    }


def _mast(draw, size):
    """A zigzag of walls, clamped at one end or flying."""
    count, lean = draw.whole(2, 6), draw.between(0.01, 0.3)
    points = [((k % 2) * lean * size / count, k * size / count) for k in range(count + 1)]
    return {
        "nodes_mm": _mm(*points),
        "walls": [[k, k + 1] for k in range(count)],
        "subdivide": draw.whole(1, 6),
        "supports": _clamped(0) if draw.chance(0.7) else [],
        "probes": [count],
    }


def _pendulum(draw, size):
    """A wall on a pin."""
    held = [{"node": 0, "fix": ["x", "y"]}]
    return _cantilever(draw, size) | {"pins": [0], "supports": held}


def _loading(draw, parts, size, force, swing, in_time):
    """A force, a moment, a weight, a prescribed move or a velocity; ``force``: Y I / size^2.

    From a millionth of it to a hundred times as much.
    """
    node, force = parts["probes"][0], force * draw.between(1e-6, 100.0)
    kind = draw.one("along", "across", "force", "moment", "gravity", "move", "velocity")
    ends = np.array(parts["nodes_mm"])
    before = next(a if b == node else b for a, b in parts["walls"] if node in (a, b))
    along = (ends[node] - ends[before]) / np.linalg.norm(ends[node] - ends[before])
    angle = draw.between(0.01, 6.0)
    way = {"along": along, "across": along[::-1] * (-1.0, 1.0)}.get(
        kind, np.array([np.cos(angle), np.sin(angle)])
    ) * draw.one(-1.0, 1.0)  # fmt: skip
    if kind == "moment":
        return {"loads": [{"node": node, "moment_Nmm": 1e3 * force * size}]}
    if kind == "gravity":
        return {"gravity_mm_s2": [0.0, -9810.0 * draw.between(1e-3, 1e3)]}
    if kind == "move":
        move = 1e3 * size * draw.between(1e-6, 0.1)
        return {"prescribed": [{"node": node, "direction": "y", "displacement_mm": move}]}
    if kind == "velocity" and in_time:
        speed = 1e3 * size / swing * draw.between(1e-4, 3.0)
        return {"initial_velocity_mm_s": [float(speed * w) for w in way]}
    return {"loads": [{"node": node, "force_N": [float(force * w) for w in way]}]}


def _damping(draw, swing):
    """None more often than not; else up to overdamped."""
    model = draw.one("none", "none", "none", "rayleigh", "kelvin_voigt")
    return {
        "none": dict(model="none"),
        "rayleigh": dict(
            model="rayleigh",
            mass=draw.between(1e-3, 10.0) / swing,
            stiffness=draw.between(1e-4, 1.0) * swing,
        ),
        "kelvin_voigt": dict(model="kelvin_voigt", relaxation_time=draw.between(1e-4, 1.0) * swing),
    }[model]
