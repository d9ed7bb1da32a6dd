#!/usr/bin/env python3
"""Two wet grains collide: the force over their separation, and the speed that is left.

    collision.py [--output FOLDER]
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pendular


def collide(speed=0.25, radius=1e-3):
    """Columns of time (s), gap (m), force between the grains (N, repulsion positive) and relative speed (m/s)."""
    scene = pendular.Scene()
    glass = scene.add_species("HertzianViscoelasticMindlinIncrementalLiquidBridgeBagheri", density=2500,
                              young_modulus=1e7, poisson_ratio=0.3, restitution_coefficient=0.7, sliding_friction_coefficient=0.3,
                              liquid_bridge_volume=1e-11, contact_angle=0.3, surface_tension=0.072)
    scene.add_grains(glass, [[-1.05 * radius, 0, 0], [1.05 * radius, 0, 0]], radius,
                     velocity=[[speed, 0, 0], [-speed, 0, 0]])
    scene.choose_time_step(100)
    rows = []

    def note(scene):
        x, v, contacts = scene.position[:, 0], scene.velocity[:, 0], scene.contacts()
        force = (contacts["normal_force_N"] - contacts["adhesive_force_N"]).sum()
        rows.append((scene.time, x[1] - x[0] - 2 * radius, force, v[1] - v[0]))

    scene.every_steps(1, note)
    scene.run(0.01)
    return np.array(rows).T


def main(arguments=None):
    options = argparse.ArgumentParser(description="Two wet grains collide.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the figure")
    folder = options.parse_args(arguments).output
    time, gap, force, speed = collide()
    print(f"relative speed before {speed[0]:.4f} m/s, after {speed[-1]:.4f} m/s; "
          f"the bridge ruptures at {1e3 * gap[force < 0].max():.3f} mm")
    plt.plot(1e3 * gap, 1e3 * force)
    plt.xlabel("gap, mm"), plt.ylabel("force, mN"), plt.xlim(-0.05, 1)
    plt.savefig(folder / "collision.png")


if __name__ == "__main__":
    main()
