"""Each species of the module has the bits of a C++ program, with 1 and 2 threads, whole and with a restart."""
import os
import re
import subprocess

import numpy as np
import pytest

import pendular

PROGRAM = os.environ.get("PENDULAR_SAME_BITS")
# A value for each field that has no default, whatever the law.
VALUES = dict(
    density=2500, effective_elastic_modulus=1e6, effective_shear_modulus=4e5, stiffness=200, dissipation=1e-3,
    sliding_stiffness=60, sliding_friction_coefficient=0.4, rolling_stiffness=50, rolling_friction_coefficient=0.1,
    torsion_stiffness=50, torsion_friction_coefficient=0.1, liquid_bridge_volume=2e-12, contact_angle=0.3,
    surface_tension=0.05, liquid_bridge_volume_max=4e-12, distribution_coefficient=0.8, viscosity=1e-3,
    loading_stiffness=200, unloading_stiffness_max=400, cohesion_stiffness=20, penetration_depth_max=0.5,
    sliding_dissipation=1e-4, rolling_dissipation=1e-6, torsion_dissipation=1e-6, cohesion_modulus=1e5,
    loading_modulus=1e6, unloading_modulus_max=2e6, surface_energy=0.02, roughness=1e-6, work_of_adhesion=0.02)
# Overrides of defaults, so that something happens.
CHANGED = dict(sliding_friction_coefficient=0.4, rolling_friction_coefficient=0.1, torsion_friction_coefficient=0.1,
               rolling_stiffness=50, torsion_stiffness=50, dissipation=1e-3, viscosity=1e-3, sinter_rate=1,
               sinter_adhesion=1e-2)
# Not fields of this law, but values from which some are computed.
COMPUTED_FROM = {("Sinter", "surface_tension"), ("Sinter", "viscosity"), ("Sinter", "surface_energy")}
COUNT, STEPS = 64, 300


def camel(name):
    return re.sub(r"_(\w)", lambda m: m[1].upper(), name)


def values_of(species):
    """The fields of a species that must be set, or that make it do something."""
    chosen = {}
    for law, field, _, _, default in pendular.fields(species):
        if (law, field) in COMPUTED_FROM:
            continue
        if field in CHANGED:
            chosen[field] = CHANGED[field]
        elif np.isnan(default) and field in VALUES:
            chosen[field] = VALUES[field]
    return chosen


def grains():
    random = np.random.default_rng(3)
    k = np.arange(COUNT)
    place = 1.95e-3 * (np.stack([k % 4, k // 4 % 4, k // 16], 1) + 0.5) + random.uniform(-3e-5, 3e-5, (COUNT, 3))
    return place, random.uniform(0.9e-3, 0.97e-3, COUNT)


PLANES = [((0, 0, -1), (0, 0, 0)), ((-1, 0, 0), (0, 0, 0)), ((1, 0, 0), (7.8e-3, 0, 0)), ((0, -1, 0), (0, 0, 0)),
          ((0, 1, 0), (0, 7.8e-3, 0))]


def scene_of(species, values, threads, step):
    film = 1e-12 if "Migration" in species else 0.0
    scene = pendular.Scene(threads=threads)
    material = scene.add_species(species, **values)
    scene.gravity = (0, 0, -9.81)
    place, radius = grains()
    scene.add_grains(material, place, radius, film=film)
    for normal, point in PLANES:
        scene.add_plane(material, normal, point)
    scene.time_step = step if step else 0.5 * scene.stability_limit()
    return scene


def write(file, species, values, step):
    film = 1e-12 if "Migration" in species else 0.0
    place, radius = grains()
    with open(file, "w") as out:
        print(f"type {species}Species", file=out)
        for name, value in values.items():
            print("set", camel(name), float(value).hex(), file=out)
        for x, r in zip(place, radius):
            print("grain", *(float(v).hex() for v in (*x, r, film)), file=out)
        for normal, point in PLANES:
            print("plane", *normal, *(float(v).hex() for v in point), file=out)
        print(f"step {step.hex()}\nsteps {STEPS}", file=out)


@pytest.mark.skipif(not PROGRAM, reason="PENDULAR_SAME_BITS is not the program SameBits")
@pytest.mark.parametrize("species", pendular.species())
def test_same_bits(species):
    values = values_of(species)
    step = scene_of(species, values, 1, None).time_step
    hashes, start = [], scene_of(species, values, 1, step).hash()
    for threads in (1, 2):
        whole = scene_of(species, values, threads, step)
        whole.run(steps=STEPS)
        first, second = scene_of(species, values, threads, step), scene_of(species, values, threads, step)
        first.run(steps=STEPS // 2)
        first.write_restart("half.h5")
        second.restart_from("half.h5")
        second.run(steps=STEPS - STEPS // 2)
        hashes += [whole.hash(), second.hash()]
    assert start not in hashes and len(whole.contacts()["wall"]) > 3  # they move and touch
    write("scene.txt", species, values, step)
    program = subprocess.run([PROGRAM, "scene.txt"], capture_output=True, text=True)
    assert program.returncode == 0, program.stderr
    assert program.stdout.split() == hashes
    assert len(set(hashes)) == 1
