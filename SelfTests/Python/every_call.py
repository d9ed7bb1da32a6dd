"""Calls all functions of the module, each with arguments that it could be given, at one moment of a scene's life.

every_call.py MOMENT FIRST: from the call of number FIRST on. Before each call its number and name are printed, and after it
what came of it, so that whoever started this program knows the call that ended it (every_call_test.py).
"""
import inspect
import sys

import numpy as np

import pendular
from pendular._signature import Argument, signature

KERNEL = pendular._kernel
GLASS = dict(density=2500, young_modulus=5e6, poisson_ratio=0.25, restitution_coefficient=0.5, sliding_friction_coefficient=0.4)
TRIANGLES = [[[-0.02, -0.02, -0.02], [0.02, -0.02, -0.02], [0, 0.02, -0.02]]]
TETRAHEDRON = [[[0, 0, 0], [0, 0.01, 0], [0.01, 0, 0]], [[0, 0, 0], [0.01, 0, 0], [0, 0, 0.01]],
               [[0, 0, 0], [0, 0, 0.01], [0, 0.01, 0]], [[0.01, 0, 0], [0, 0.01, 0], [0, 0, 0.01]]]
PLACE = pendular.box((-0.01, -0.01, 0.03), (0.01, 0.01, 0.05))


def dry():
    """Grains that touch each other and a floor, two of them joined, and what a scene may have besides."""
    scene = pendular.Scene()
    scene.glass = glass = scene.add_species("HertzianViscoelasticMindlin", **GLASS)
    scene.add_plane(glass, (0, 0, -1), (0, 0, 0), forces=True)
    scene.chosen = scene.add_mesh(glass, TRIANGLES)
    k = np.arange(5)
    scene.add_grains(glass, np.stack([0 * k, 0 * k, 0.99e-3 + 1.99e-3 * k + 2e-5 * (k == 4)], 1), 1e-3)
    scene.join([3, 4])
    scene.add_column("age", "s")
    scene.add_contact_column("wear", "m")
    scene.add_inlet(glass, pendular.one_size(1e-3), PLACE, number_flow=10)
    scene.add_outlet(region=pendular.box((-1, -1, -1), (1, 1, -0.03)))
    scene.add_flux_plane(normal=(0, 0, 1), point=(0, 0, 2e-3))
    scene.gravity = (0, 0, -9.81)
    scene.set_domain((-0.05, -0.05, -0.05), (0.05, 0.05, 0.05))
    scene.time_step = 1e-6
    return scene


def wet():
    """Liquid that moves, with the accounts that a scene may keep."""
    scene = pendular.Scene()
    scene.glass = sand = scene.add_species("LinearViscoelasticSlidingFrictionLiquidMigrationWillett", density=2500, stiffness=300,
                                           dissipation=1e-3, sliding_stiffness=85, sliding_friction_coefficient=0.4, contact_angle=0.3, surface_tension=0.05,
                                           liquid_bridge_volume_max=1e-11)
    scene.add_plane(sand, (0, 0, -1), (0, 0, 0))
    scene.add_plane(sand, (0, 0, 1), (0, 0, 0.05))
    scene.add_grains(sand, [[0, 0, 0.99e-3], [0, 0, 2.98e-3], [0, 5e-3, 1e-3]], 1e-3, film=1e-11)
    scene.add_spray(nozzle=(0, 0, 0.02), direction=(0, 0, -1), cone_angle=0.1, droplet_radius=1e-4, speed=1, flow=4e-8)
    scene.keep_energy_ledger()
    scene.listen_to_contacts()
    scene.add_column("age", "s")
    scene.add_contact_column("wear", "m")
    scene.set_domain((-0.05, -0.05, -0.05), (0.05, 0.05, 0.05))
    scene.time_step = 1e-6
    return scene


def periodic():
    """Repeated in all directions, with heat and bonds."""
    scene = pendular.Scene()
    scene.glass = glass = scene.add_species("HertzianViscoelasticMindlin", **GLASS)
    for axis in "xyz":
        scene.set_periodic(axis, 0, 0.02)
    scene.add_grains(glass, [[5e-3, 5e-3, 5e-3 + 1.99e-3 * k] for k in range(3)], 1e-3)
    scene.conduct_heat()
    scene.set_heat_material(glass, conductivity=1, heat_capacity=800)
    scene.add_bond_material(radius=5e-4, young_modulus=1e7, shear_modulus=4e6)
    scene.bond([0], [1], material=0)
    scene.time_step = 1e-7
    return scene


def hosted():
    """A fluid, a membrane and a wall that another program moves."""
    scene = pendular.Scene()
    scene.glass = glass = scene.add_species("HertzianViscoelasticMindlin", **GLASS)
    scene.add_membrane(glass, pendular.membrane_sheet(3, 3, 2e-3), thickness=1e-4, young_modulus=1e6, density=1000)
    scene.add_host_wall(glass, TRIANGLES)
    scene.add_plane(glass, (0, 0, -1), (0, 0, -5e-3))
    scene.add_grains(glass, [[2e-3, 2e-3, 2.99e-3], [2e-3, 2e-3, 4.98e-3]], 1e-3)
    scene.fluid = scene.add_fluid((0, 0, 0), (0.01, 0.01, 0.02), (1, 1, 4), density=1000, viscosity=1e-3, superficial_speed=0.01)
    scene.gravity = (0, 0, -9.81)
    scene.time_step = 1e-7
    return scene


SCENES = (dry, wet, periodic, hosted)
# By the name of an argument, for functions that need another value than that of its type: by the function, or for all.
VALUES = {
    "add_cylinder.axis": (0, 0, 1), "add_profile.axis": (0, 0, 1), "set_rotor.axis": (0, 0, 1), "axis": "z",
    "flow": "x", "add_spray.flow": 1e-8, "gradient": "z", "axes": "all", "held": "z", "basis": "number", "Mixture.by": "number", "by": "species",
    "cells": [1, 1, 5], "coordinates": "XZ", "kernel": "gauss", "drag_law": "Gidaspow", "drag_force.law": "Gidaspow",
    "balanced_speed.law": "Gidaspow", "keep_wear.law": "reye", "conduct_heat.law": "constriction", "model": "A", "host": None,
    "which": "all", "set_integrator.name": "velocity_verlet", "view.name": "velocity", "add_column.name": "mine",
    "add_contact_column.name": "mine", "column.name": "age", "set_column.name": "age", "set_contact_column.name": "wear",
    "add_species.type": "LinearViscoelastic", "set_pair.type": None, "fields.type": "LinearViscoelastic", "get.name": "density",
    "superquadrics": None, "superficial_speed": 0.1, "unit": "m", "figures": ["friction"], "kept": None, "stiffness": None,
    "lowest": (-0.01, -0.01, 0), "highest": (0.01, 0.01, 0.02), "set_periodic.lowest": -0.01, "set_periodic.highest": 0.01, "spacing": 2e-3,
    "mesh": TRIANGLES, "mesh_inside.mesh": TETRAHEDRON, "triangles": None, "position": [[0, 0, 0.02]], "add_shape.position": (0, 0, 0.02),
    "set_position.position": [[0, 0, 0.02]], "radius": 1e-3, "identities": [0], "join.identities": [0, 1], "first": [0], "second": [1],
    "places": [[0, 0, 1e-3]], "points": [[0, 0, 0.02], [0, 0, 0.03]], "normals": [[0, 0, -1], [0, 0, 1]], "profile": [(1e-3, 0), (2e-3, 0.01)],
    "spheres": [[0, 0, 0, 1e-3]], "diameters": [1e-3, 2e-3], "single": [1, 1], "cumulative": None, "classes": None, "values": 0.0,
    "velocities": [[0, 0, 0]] * 3, "size_classes": [1e-3, 2e-3], "velocity": (0, 0, 0), "spin": (0, 0, 0), "film": 1e-12, "orientation": (1, 0, 0, 0),
    "inertia": None, "set_rotor.inertia": 1e-6, "high": 2e-3, "large": 3e-3, "small": 1e-3, "low": 1e-3, "median": 1.5e-3,
    "mean": 1.5e-3, "geometric_deviation": 1.1, "deviation": 1e-4, "exponent": 3, "share": 0.04, "error": 0.01, "young_modulus": 1e8, "density": 1000,
    "grain_density": 2500, "viscosity": 1e-3, "porosity": 0.5, "n1": 2, "n2": 2, "half_lengths": (2e-3, 2e-3, 2e-3), "start": 0,
    "cylinder.start": (0, 0, 0.02), "cylinder.end": (0, 0, 0.03), "end": 1.0, "number": 0, "insert.number": 2, "insert_mixture.number": 2,
    "around": 8, "rows": 3, "columns": 3, "steps": 1, "tries": 10, "interval": 1e-3, "set_evaporation.interval": 10, "k": 1, "m": 0, "cone_angle": 0.1,
    "largest_speed": 1.0, "temperature": 293.0, "poisson_ratio": 0.25, "follows_wall": None, "follows_fill": None, "mass_flow": None,
    "insert.mass": None, "insert_mixture.mass": None, "solid_fraction": None, "across": None, "fan_angle": None, "edge1": None, "edge2": None,
    "with_flow": False, "progress": None, "until": 1e-6, "run.until": None, "part": None, "where": lambda place: place[2] < 0.01, "threads": 1, "time": 1e-3,
    "_run_to.time": 2e-6, "file": "state.h5", "library": "none.so", "sentence": "s", "name": "other", "fields": {}, "vectors": {}, "drag_force.slip": 0.1,
    "insert.shape": None, "add_inlet.shape": None, "length": 1e-3,
}
BY_KIND = {"float": 1e-3, "int": 0, "bool": True, "str": "name", "Vector": (0, 0, 1), "ArrayLike": [0.0], "os.PathLike": "file.txt",
           "function": lambda *given: None, "object": None}


def selves(scene):
    """An object of each class, taken at set-up: in the middle of a step a scene hands none on."""
    made = {"Scene": scene, "Species": scene.glass, "Sizes": pendular.one_size(1e-3), "Shape": pendular.clump([[0, 0, 0, 1e-3]]),
            "Mixture": pendular.Mixture(), "Region": PLACE}
    made["Mixture"].add(scene.glass, made["Sizes"])
    made |= {"Wall": getattr(scene, "chosen", None) or scene.wall(0)} if scene.wall_count else {}
    return made | ({"Fluid": scene.fluid} if hasattr(scene, "fluid") else {})


def value(function, argument, objects):
    kind = argument.kind.removeprefix("Optional[").removeprefix("List[").rstrip("]").rpartition(".")[2]
    for key in (f"{function}.{argument.name}", argument.name):
        if key in VALUES:
            return VALUES[key]
    own = objects.get(kind, BY_KIND.get(kind))
    return [own] if "List[" in argument.kind else own


OF_OPERATORS = {"__eq__": (0,), "__exit__": (None, None, None), "__setattr__": ("mine", 1)}
# What is not of a scene, or is for the package alone.
LEFT_OUT = {"_pybind11_conduit_v1_", "_stop_all", "_set_log", "_set_explanation", "_fail_on_ranks", "stop"}


def members():
    """(class, or None, name, function or property) of all that the module has."""
    for key, what in vars(KERNEL).items():
        if inspect.isclass(what) and not issubclass(what, Exception):
            for name, member in vars(what).items():
                is_method = type(member).__name__ == "instancemethod"
                if (is_method or isinstance(member, property)) and name not in LEFT_OUT and name != "__init__":
                    yield key, name, member
        elif callable(what) and not inspect.isclass(what) and key not in LEFT_OUT:
            yield None, key, what
    for name, member in vars(pendular.Scene).items():  # what the package adds
        if inspect.isfunction(member) or isinstance(member, property):
            yield "Scene", name, member


def arguments_of(member):
    if inspect.isfunction(member):
        return [Argument(one.name, str(one.annotation), None if one.default is one.empty else "given")
                for one in inspect.signature(member).parameters.values()]
    found = signature(member.__doc__)
    return found.arguments if found else []


def arguments(name, member, objects, takes_all):
    return {argument.name: value(name, argument, objects) for argument in arguments_of(member)
            if argument.kind and argument.name not in ("self", "arg0") and (takes_all or argument.default is None)}


def one_call(of, name, member, takes_all=False):
    if isinstance(member, property):
        return lambda objects: getattr(objects[of], name)
    if name.startswith("__"):
        return lambda objects: getattr(objects[of], name)(*OF_OPERATORS.get(name, ()))
    return lambda objects: (getattr(objects[of], name) if of else member)(**arguments(name, member, objects, takes_all))


def assignment(of, name):
    return lambda objects: setattr(objects[of], name, getattr(objects[of], name))


def calls():
    """(class, name, function of the objects of a scene) of all calls."""
    for of, name, member in members():
        label = f"{of}.{name}" if of else name
        yield of, label, one_call(of, name, member)
        if isinstance(member, property) and member.fset:
            yield of, f"{label} = ", assignment(of, name)
        if not isinstance(member, property) and not name.startswith("__"):
            yield of, f"{label}, all arguments", one_call(of, name, member, True)


def what_comes(call, objects):
    """Returns "returns", or the error."""
    try:
        call(objects)
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return "returns"


def asked(moment, objects, call):
    """What comes of a call at this moment in the life of a new scene."""
    scene, came = objects["Scene"], []
    if moment == "before" or moment.startswith("unmade"):
        return [what_comes(call, objects)]

    def look(*_):
        if len(came) < 8:
            came.append(what_comes(call, objects))
        return 0, 0, 0

    if moment == "motion" and scene.wall_count:
        scene.wall(scene.wall_count - 1).set_motion(look)
    elif moment == "hook":
        scene.every_steps(1, look)
    try:
        scene.run(steps=3)
        if moment == "after":
            scene.finish()
            look()
    except Exception as error:  # what was called may end the run
        came.append(f"run: {type(error).__name__}: {error}")
    return came


def unmade(objects, names):
    """The objects of these classes are made by __new__() alone."""
    return {name: getattr(pendular, name).__new__(getattr(pendular, name)) if name in names else one for name, one in objects.items()}


def main(moment, first):
    every = [(make, *call) for make in SCENES for call in calls()]
    for number, (make, of, label, call) in list(enumerate(every))[first:]:
        objects = selves(make())
        if of and of not in objects:
            continue
        if moment.startswith("unmade"):  # self, or the objects among the arguments
            objects = unmade(objects, {of} if moment == "unmade self" else set(objects) - {of})
        print(number, f"{make.__name__}:", label, flush=True)
        for came in dict.fromkeys(asked(moment, objects, call)):
            print(f"\t{came}", flush=True)
    print("end", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
