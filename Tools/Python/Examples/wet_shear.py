#!/usr/bin/env python3
"""Wet grains in shear without walls, under a pressure: the friction of the bulk, and fields as arrays.

    wet_shear.py [--output FOLDER] [--strain STRAIN]
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pendular

DIAMETER, RATE, PRESSURE = 2e-3, 5.0, 200.0  # m, 1/s, Pa


def make_shear(edge=8):
    """A cube of edge^3 grains, and its length (m)."""
    length = 1.05 * edge * DIAMETER
    scene = pendular.Scene()
    wet = scene.add_species("HertzianViscoelasticMindlinIncrementalLiquidBridgeBagheri", density=2500,
                            young_modulus=5e6, poisson_ratio=0.25, restitution_coefficient=0.5, sliding_friction_coefficient=0.4,
                            liquid_bridge_volume=2e-11, contact_angle=0.3, surface_tension=0.05)
    for axis in "xyz":
        scene.set_periodic(axis, 0, length)
    scene.set_lees_edwards("x", "y", RATE)
    scene.set_target_stress("y", PRESSURE, time=2e-3, largest_rate=20)
    random, k = np.random.default_rng(1), np.arange(edge**3)
    place = 1.05 * DIAMETER * (np.stack([k % edge, k // edge % edge, k // edge**2], 1) + 0.5)
    place += random.uniform(-0.02, 0.02, place.shape) * DIAMETER
    scene.add_grains(wet, place, DIAMETER / 2 * random.uniform(0.85, 1, len(k)), velocity=scene.flow_at(place))
    scene.choose_time_step()
    return scene


def shear(scene, strain):
    """Columns, a row each millisecond: strain (shear rate times time); pressure (Pa), the normal stress along the gradient,
    positive in compression; friction of the bulk, the shear stress over that pressure; bridges of a grain, twice the number of
    bridges over the number of grains. Stresses are totals: of contacts, bridges and fluctuating velocities."""
    rows = []

    def note(scene):
        stress = scene.mean_stress()["total_Pa"]
        bridges = 2 * scene.contacts()["bridged"].sum() / len(scene)
        rows.append((scene.time * RATE, stress[1, 1], -stress[0, 1] / stress[1, 1], bridges))

    scene.every_time(1e-3, note)
    scene.run(strain / RATE)
    return np.array(rows).T


def main(arguments=None):
    options = argparse.ArgumentParser(description="Wet grains in shear.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the figure")
    options.add_argument("--strain", type=float, default=4.0)
    given = options.parse_args(arguments)
    scene = make_shear()
    strain, pressure, friction, bridges = shear(scene, given.strain)
    late = strain > given.strain / 2
    print(f"means over the second half of the strain: pressure {pressure[late].mean():.1f} Pa, "
          f"friction {friction[late].mean():.3f}, {bridges[late].mean():.2f} bridges of a grain")
    lowest, lengths = scene.period
    fields = scene.fields("Y", lowest, lowest + lengths, spacing=DIAMETER / 2, width=DIAMETER / 2)
    figure, axes = plt.subplots(1, 2, figsize=(9, 4))
    axes[0].plot(strain, friction), axes[0].set(xlabel="strain", ylabel="friction of the bulk")
    axes[1].plot(fields["velocity_m_per_s"][:, 0], fields["y_m"]), axes[1].set(xlabel="velocity, m/s", ylabel="y, m")
    figure.savefig(given.output / "wet-shear.png")


if __name__ == "__main__":
    main()
