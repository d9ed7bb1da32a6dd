"""Pendular from Python: scenes of dry and wet grains, their runs, and numpy arrays. All numbers are in SI units.

    import pendular
    scene = pendular.Scene()
    glass = scene.add_species("HertzianViscoelasticMindlinIncremental", density=2500, young_modulus=5e6, poisson_ratio=0.25,
                              restitution_coefficient=0.5, sliding_friction_coefficient=0.4)
    scene.add_grains(glass, [[0, 0, 2e-3]], 1e-3)
    scene.add_plane(glass, outward=(0, 0, -1), point=(0, 0, 0))
    scene.gravity = (0, 0, -9.81)
    scene.choose_time_step()
    scene.run(0.1)
    print(scene.position)
"""
import os as _os
from typing import List

from ._choose import choose as _choose

_choose(_os.path.dirname(__file__), __path__)

from ._kernel import (  # noqa: E402  (which is in the folder that was chosen)
    Fluid,
    InputError,
    Mixture,
    Region,
    RunError,
    RunStopped,
    Shape,
    Sizes,
    Species,
    Wall,
    balanced_speed,
    bidisperse_sizes,
    block,
    box,
    clump,
    cylinder,
    drag_force,
    drag_laws,
    even_sizes,
    fields,
    load_species,
    lognormal_sizes,
    membrane_sheet,
    membrane_tube,
    mesh_inside,
    normal_sizes,
    one_size,
    rank,
    rank_count,
    read_sizes,
    rosin_rammler_sizes,
    shaped_species,
    sizes,
    softest_modulus,
    species,
    sphere,
    superquadric,
    terminal_speed,
)
from . import _arguments as _arguments
from ._kernel import __version__ as _version
from ._log import SceneWarning
from ._log import show_log as _show_log
from ._view import view
from .many import collisions, run_many
from .results import draw, frames, restart, table, to_pyvista, walls_to_pyvista
from .scene import Scene

__all__ = [
    "Fluid", "InputError", "Mixture", "Region", "RunError", "RunStopped", "Scene", "SceneWarning", "Shape", "Sizes", "Species",
    "Wall", "balanced_speed", "bidisperse_sizes", "block", "box", "clump", "collisions", "cylinder", "drag_force", "drag_laws",
    "draw", "even_sizes", "fields", "frames", "load_species", "lognormal_sizes", "membrane_sheet", "membrane_tube",
    "mesh_inside", "normal_sizes", "one_size", "rank", "rank_count", "read_sizes", "restart", "rosin_rammler_sizes", "run_many",
    "shaped_species", "sizes", "softest_modulus", "species", "sphere", "superquadric", "table", "terminal_speed", "to_pyvista",
    "view", "walls_to_pyvista",
]  # fmt: skip
__version__ = _version


def __dir__() -> List[str]:
    """What is for users, in the lists that editors and notebooks show."""
    return [*__all__, "__version__", "__doc__"]


_show_log()
