"""Misuses: each is refused with one sentence that names what is wrong, and the scene can go on."""
import numpy as np
import pytest

import pendular
from conftest import GLASS, glass_in, tower

nan, inf = float("nan"), float("inf")
BOX = pendular.box((0, 0, 0.05), (0.02, 0.02, 0.07))
EVEN = pendular.even_sizes(1e-3, 2e-3)
BALL = pendular.clump([[0, 0, 0, 1e-3]])


def other_scene():
    scene = pendular.Scene()
    return scene, glass_in(scene)


def spray(scene, **options):
    scene.add_spray(flow=1e-8, droplet_radius=1e-4, speed=1, nozzle=(0, 0, 0), direction=(0, 0, 1), cone_angle=1, **options)


# What is done, and words of the sentence.
MISUSES = {
    # Species
    "no such species": (lambda s: s.add_species("HertzianViscoelasticMindling"), "HertzianViscoelasticMindlin"),
    "a file as species": (lambda s: s.add_species("my species.so"), "no name of a species"),
    "no such field": (lambda s: s.add_species("LinearViscoelastic", stifness=1), "stiffness"),
    "a field of another law": (lambda s: s.glass.set(surface_tension=1), "surface_tension"),
    "text as a field": (lambda s: s.glass.set(density="heavy"), "density must be a number"),
    "negative density": (lambda s: s.glass.set(density=-1), "density"),
    "NaN as a field": (lambda s: s.glass.set(sliding_friction_coefficient=nan), "sliding_friction_coefficient"),
    "a ratio that no material has": (
        lambda s: s.add_species("HertzianViscoelasticMindlin", density=2500, young_modulus=5e6, poisson_ratio=0.6), r"poisson_ratio = 0\.6 is out of range; .* at most 0\.5"),
    "a ratio of almost 1": (lambda s: s.glass.set(young_modulus=5e6, poisson_ratio=0.99), r"poisson_ratio = 0\.99"),
    "a ratio of -1": (lambda s: s.glass.set(young_modulus=5e6, poisson_ratio=-1), "poisson_ratio = -1"),
    "a modulus below 0": (lambda s: s.glass.set(young_modulus=-5e6, poisson_ratio=0.3), "young_modulus = -5"),
    "modulus without ratio": (lambda s: s.glass.set(young_modulus=1e6), "together"),
    "modulus of a linear law": (
        lambda s: s.add_species("LinearViscoelastic", young_modulus=1e6, poisson_ratio=0.3), "names are stiffness|names are restitution"),
    "restitution above 1": (lambda s: s.add_species("HertzianViscoelastic", **{**GLASS, "restitution_coefficient": 2}),
                            "sliding|restitution"),
    "get what is not there": (lambda s: s.glass.get("stifness"), "effective_shear_modulus"),
    "fields of nothing": (lambda s: pendular.fields("Nothing"), "Nothing"),
    "a library that is none": (lambda s: pendular.load_species("/no/such.so"), "cannot be loaded"),
    # Grains
    "positions in columns": (lambda s: s.add_grains(s.glass, np.zeros((3, 5)), 1e-3), "position must be rows of 3"),
    "one position": (lambda s: s.add_grains(s.glass, [0, 0, 0], 1e-3), "position must be rows of 3"),
    "text as position": (lambda s: s.add_grains(s.glass, "here", 1e-3), "position must be rows"),
    "ragged positions": (lambda s: s.add_grains(s.glass, [[0, 0, 0], [1]], 1e-3), "position must be rows"),
    "complex positions": (lambda s: s.add_grains(s.glass, [[0, 0, 1j]], 1e-3), "position must be rows"),
    "radii of others": (lambda s: s.add_grains(s.glass, np.eye(3), [1e-3, 1e-3]), "there are 3 grains"),
    "velocities of others": (lambda s: s.add_grains(s.glass, np.eye(3), 1e-3, velocity=np.eye(2)), "velocity"),
    "negative radius": (lambda s: s.add_grains(s.glass, np.eye(3), -1e-3), "radius"),
    "NaN as position": (lambda s: s.add_grains(s.glass, [[nan, 0, 0]], 1e-3), "position"),
    "infinite velocity": (lambda s: setattr(s, "velocity", (inf, 0, 0)), "velocity"),
    "rows of others": (lambda s: setattr(s, "velocity", np.zeros((3, 3))), "4 grains"),
    "an axis that is none": (lambda s: s.hold([0], "z w"), "held axis 'w'"),
    "no such grain": (lambda s: s.set_velocity((0, 0, 0), identities=[99]), "99"),
    "negative identity": (lambda s: s.remove_grains([-1]), "-1"),
    "fraction as identity": (lambda s: s.remove_grains([0.5]), "whole numbers"),
    "remove twice": (lambda s: s.remove_grains([0, 99]), "99"),
    "species of another scene": (lambda s: s.add_grains(other_scene()[1], [[0, 0, 1]], 1e-3), "another scene"),
    "no column": (lambda s: s.column("age"), "add_column"),
    "no such column": (lambda s: (s.add_column("age"), s.column("agee")), "names are age"),
    "no column of contacts": (lambda s: s.set_contact_column("age", 1), "add_contact_column"),
    "no such view": (lambda s: s.view("positions"), "position"),
    "no file of grains": (lambda s: s.add_grains_of_file([s.glass], "none.txt"), "none.txt"),
    "shape on a quaternion": (lambda s: s.add_shape(s.glass, BALL, (0, 0, 1), orientation=(1, 0, 0)), "quaternion"),
    "superquadric among spheres": (
        lambda s: s.add_shape(s.glass, pendular.superquadric((1e-3, 1e-3, 1e-3)), (0, 0, 1)), "superquadrics=NAME"),
    "exponent of 1": (lambda s: pendular.superquadric((1e-3, 1e-3, 1e-3), n1=1), "exponent"),
    "join one that is not there": (lambda s: s.join([0, 99]), "99"),
    "mass without inertia": (lambda s: s.join([0, 1], mass=1), "inertia"),
    "no such body": (lambda s: s.remove_body(3), "3"),
    # Insertion
    "no amount": (lambda s: s.insert(s.glass, EVEN, BOX), "one of number"),
    "two amounts": (lambda s: s.insert(s.glass, EVEN, BOX, number=3, mass=1), "one of number"),
    "too dense": (lambda s: s.insert(s.glass, EVEN, BOX, solid_fraction=0.9), "solid fraction"),
    "sizes upside down": (lambda s: pendular.even_sizes(2e-3, 1e-3), "0.002|2e-03"),
    "box upside down": (lambda s: pendular.box((1, 1, 1), (0, 0, 0)), "box|Box"),
    "no such basis": (lambda s: pendular.sizes([1e-3], single=[1], basis="weight"), "weight"),
    "sizes of two kinds": (lambda s: pendular.sizes([1e-3], single=[1], classes=[1]), "one of"),
    "inlet without a flow": (lambda s: s.add_inlet(s.glass, EVEN, BOX), "mass_flow"),
    "outlet without a place": (lambda s: s.add_outlet(), "region"),
    "no such outlet": (lambda s: s.outlet(2), "2"),
    # Walls
    "vector of two": (lambda s: s.add_plane(s.glass, (0, 1), (0, 0, 0)), "three numbers"),
    "normal of no length": (lambda s: s.add_plane(s.glass, (0, 0, 0), (0, 0, 0)), "normal"),
    "no mesh": (lambda s: s.add_mesh(s.glass, "none.stl"), "none.stl"),
    "triangles of no size": (lambda s: s.add_mesh(s.glass, [[[0, 0, 9], [1, 0, 9], [0, 1, 9]]], scale=-1), "scale = -1 m"),
    "vertices of no size": (
        lambda s: s.add_host_wall(s.glass, [[0, 0, 9], [1, 0, 9], [0, 1, 9]], [[0, 1, 2]], scale=0), "scale = 0 m"),
    "a torque about nothing": (lambda s: s.wall(0).keep_forces(about=(nan, 0, 0)), "point of the torque"),
    "a hardness that is not asked for": (
        lambda s: s.add_mesh(s.glass, [[[0, 0, 9], [1, 0, 9], [0, 1, 9]]]).keep_wear("reye", factor=1e-12, hardness=1e9), "takes no hardness"),
    "triangles in a row": (lambda s: s.add_mesh(s.glass, np.zeros((4, 9))), "N x 3"),
    "piston of a tube": (lambda s: s.add_cylinder(s.glass, (0, 0, 1), (0, 0, 0), 1).set_piston(1, 1), "no piston"),
    "force that is not kept": (lambda s: s.wall(0).force, "keep"),
    "no such wall": (lambda s: s.wall(9), "9"),
    "profile of one point": (lambda s: s.add_profile(s.glass, (0, 0, 1), (0, 0, 0), [(1, 0)]), "at least 2"),
    "wear of a plane": (lambda s: s.wall(0).keep_wear("reye", factor=1), "no wear"),
    "wear without its number": (
        lambda s: s.add_mesh(s.glass, [[[0, 0, 9], [1, 0, 9], [0, 1, 9]]]).keep_wear("archard", hardness=1),
        "coefficient"),
    # Space and time
    "no such axis": (lambda s: s.set_periodic("w", 0, 1), "axis"),
    "negative step": (lambda s: setattr(s, "time_step", -1), "time step"),
    "step above the limit": (lambda s: (setattr(s, "time_step", 1), s.run(2)), r"unless accept_unstable_time_step\(\)"),
    "back in time": (lambda s: (s.run(1e-3), s.run(5e-4)), r"time of run\(\) = .*already"),
    "run without an end": (lambda s: s.run(), "until"),
    "negative steps": (lambda s: s.run(steps=-1), "-1"),
    "no such integrator": (lambda s: s.set_integrator("euler"), "velocity_verlet"),
    "zero threads": (lambda s: setattr(s, "threads", 0), "threads"),
    "call never": (lambda s: s.every_steps(0, print), "at least 1"),
    "call at NaN": (lambda s: s.every_time(nan, print), "interval"),
    "outputs in a run": (lambda s: (s.run(steps=1), s.write_energy(1)), "before the run"),
    "run in a function": (lambda s: (s.every_steps(1, lambda t: t.run(steps=1)), s.run(steps=1)), "hook"),
    "no restart file": (lambda s: (s.restart_from("none.h5"), s.run(steps=1)), "none.h5"),
    "what is remembered is text": (
        lambda s: (s.remembered.update(a="text"), s.run(steps=1), s.write_restart("a.h5")), "remembered"),
    # Results
    "no such coordinates": (lambda s: s.fields("ZX", (0, 0, 0), (1, 1, 1), 0.1, 0.1), "ZX"),
    "no such kernel": (lambda s: s.fields("X", (0, 0, 0), (1, 1, 1), 0.1, 0.1, kernel="box"), "gauss"),
    "mean stress without a volume": (lambda s: (s.run(steps=1), s.mean_stress()), "volume|repeat"),
    "no file of frames": (lambda s: list(pendular.frames("none.h5")), "none.h5"),
    "no table": (lambda s: pendular.table("none.csv"), "none.csv"),
    "draw a column that is none": (lambda s: pendular.draw(s, color="heat"), "heat"),
    "spray of less than even droplets": (lambda s: spray(s, volume_spread=-0.1), "volume spread = -0.1"),
    "spray before all time": (lambda s: spray(s, start=-1), "first time = -1 s"),
    "spray of a light liquid": (lambda s: spray(s, liquid_density=-1000), "density of the liquid = -1000"),
    "cone with an edge": (lambda s: spray(s, edge1=(1, 0, 0)), "cone_angle"),
    "a flux of vapour": (lambda s: s.set_evaporation(flux=1e-3, humidity=0.5), "humidity"),
    "a flux of a liquid": (lambda s: s.set_evaporation(flux=1e-7, liquid_density=1000), "liquid_density is of mass_transfer"),
    # What is read in another case alone
    "shear share of a parallel bond": (
        lambda s: s.add_bond_material(1e-4, normal_stiffness=1e12, shear_stiffness=4e11, shear_share=0.5), "shear_share is of a beam"),
    "shear share of a function": (
        lambda s: s.add_bond_material(1e-4, stiffness=lambda length: (1e4, 1e4, 1e-3, 1e-3), shear_share=0.9), "shear_share is of a beam"),
    "centre of a clump without mass": (lambda s: pendular.clump([[0, 0, 0, 1e-3]], centre=(0, 0, 1e-4)), "centre .* mass .* inertia"),
    "centre of joined grains without mass": (lambda s: s.join([0, 1], centre=(0, 0, 1e-4)), "centre .* mass .* inertia"),
    "the side of a tube": (lambda s: s.add_cylinder(s.glass, (0, 0, 1), (0, 0, 0), 1, length=1, grains_inside=False), "leave grains_inside out"),
    "fixed grains that are held": (lambda s: s.add_grains(s.glass, [[0, 0, 1]], 1e-3, fixed=True, held="z"), "held = 'z'"),
    "points of no contacts": (lambda s: s.write_hdf5(1e-3, contacts=False, contact_points=True), "contacts=False"),
    "an interval without wear": (
        lambda s: s.add_mesh(s.glass, [[[0, 0, 9], [1, 0, 9], [0, 1, 9]]]).keep_wear("none", interval=1), "leave interval"),
    "density of a body with its mass": (
        lambda s: s.add_mesh(s.glass, [[[0, 0, 9], [1, 0, 9], [0, 1, 9]]]).set_free_body(density=1000, mass=1), "takes no mass"),
    "spray without a shape": (
        lambda s: s.add_spray(flow=1, droplet_radius=1, speed=1, nozzle=(0, 0, 0), direction=(0, 0, 1)), "cone_angle"),
}


@pytest.mark.parametrize("do, words", MISUSES.values(), ids=MISUSES.keys())
def test_misuse(do, words):
    scene = tower()
    with pytest.raises(pendular.InputError, match=words) as caught:
        do(scene)
    sentence = str(caught.value)
    assert "\n" not in sentence and sentence.endswith(".") and len(sentence) > 20, sentence


@pytest.mark.parametrize("do, words", [m for k, m in MISUSES.items() if k in (
    "negative radius", "NaN as position", "radii of others", "no such grain", "no such field", "no such axis",
    "two amounts", "no mesh", "remove twice")])
def test_scene_is_as_before(do, words):
    scene, plain = tower(), tower()
    with pytest.raises(pendular.InputError):
        do(scene)
    scene.run(0.005)
    plain.run(0.005)
    assert scene.hash() == plain.hash() and len(scene) == 4


def test_a_wall_that_was_removed():
    scene = tower()
    lid = scene.add_plane(scene.glass, (0, 0, 1), (0, 0, 1))
    scene.remove_wall(lid)
    for change in (lambda: lid.set_velocity((0, 0, 1)), lambda: lid.keep_forces(),
                   lambda: lid.set_species(scene.glass)):
        with pytest.raises(pendular.InputError, match="Wall 1 was removed"):
            change()


def test_handles_keep_their_scene():
    """A species and a wall of a scene that nobody holds any more."""
    scene, glass = other_scene()
    wall = scene.add_plane(glass, (0, 0, 1), (0, 0, 1), forces=True)
    del scene
    glass.set(density=3)
    assert glass.get("density") == 3 and wall.force.tolist() == [0, 0, 0]


def test_wrong_kinds_of_arguments_are_type_errors():
    scene = tower()
    for do in (lambda: scene.add_plane("glass", (0, 0, 1), (0, 0, 0)), lambda: scene.every_steps(1, 5),
               lambda: pendular.Scene(threads="two"), lambda: scene.add_grains(scene.glass, [[0, 0, 0]], None)):
        with pytest.raises(TypeError):
            do()
