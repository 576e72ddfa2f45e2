"""The timed cases: the seed's scene and crushes of square cells, all cells of one size."""

from sweep.config.case import Case
from sweep.design.lattice import build_network
from sweep.scene.lattice import build_scene
from sweep.scene.mesh import build_mesh
from tests.support.designs.tables import MATERIAL, lattice_with, material_with

PITCH = 12.5e-3 / 3
UNDAMPED = dict(model="none")
APART = dict(model="none")
SMOOTH, ROUGH = dict(friction=0.0), dict(friction=0.3)
SPEED = 0.5  # m/s


def new_scene(case):
    """The scene of a case whose lattice none before it had."""
    build_network.cache_clear()
    build_mesh.cache_clear()
    return build_scene(case)


def lattice(cells):
    """Cells by cells, walls of 0.8 mm in three elements each."""
    size = cells * PITCH
    return lattice_with(cells_x=cells, cells_y=cells, width=size, height=size, nodes_per_wall=2)


def seed(cells=3, duration=0.2, contact=APART):
    """A dead load, 5 N on three cells a side, let go later; undamped, steps of 0.1 ms."""
    force, release = 5.0 * cells / 3, 0.69 * duration
    return Case.of(
        lattice=lattice(cells),
        material=MATERIAL,
        loading=dict(force=force, release_time=release, duration=duration, platen="none"),
        contact=contact,
        damping=UNDAMPED,
        solver=dict(time_step=1e-4, joints="points"),
    )


def crush(cells, strain, steps, contact=APART):
    """Quasi-static crush to ``strain`` between glued platens, joints that are points."""
    return Case.of(
        lattice=lattice(cells),
        material=MATERIAL,
        loading=dict(mode="displacement", strain=strain, unload=False),
        contact=contact,
        solver=dict(load_steps=steps, joints="points"),
    )


def blow(cells=3, strain=0.6, steps=200, **left_out):
    """Crush at a speed with all there is: measured curve, contact, friction, damping."""
    chosen = {"material": material_with(), "contact": ROUGH, "damping": {}} | left_out
    loading = dict(mode="displacement", strain=strain, unload=False, speed=SPEED)
    solver = dict(load_steps=steps, integrator="backward_euler")
    return Case.of(lattice=lattice(cells), loading=loading, solver=solver, **chosen)
