#!/usr/bin/env python3
"""Calibration: the friction and the rolling friction at which a heap has a measured angle of repose.

Two measurements are met by two numbers: the angle and the width of a heap on a rough base. What heaps give is noisy, so that
slopes of it mislead; the simplex of Nelder and Mead (1965), Comput. J. 7, 308, asks for none, and begins large.

    calibration.py [--angle DEGREES] [--width M] [--evaluations N]
"""
import argparse

import numpy as np
from scipy.optimize import minimize

import pendular


def heap(friction, rolling, seed=1, time=0.25):
    """The angle (degrees) and the width (m, root mean square) of a heap."""
    scene = pendular.Scene()
    sand = scene.add_species("HertzianViscoelasticMindlinRollingTorsion", density=2500, young_modulus=2e6,
                             poisson_ratio=0.25, restitution_coefficient=0.3, sliding_friction_coefficient=friction,
                             rolling_stiffness=1e3, rolling_dissipation=1e-4, rolling_friction_coefficient=rolling,
                             # The lever of torsion is twice that of rolling in this law: these are the same torques.
                             torsion_stiffness=1e3 / 4, torsion_dissipation=1e-4 / 4,
                             torsion_friction_coefficient=rolling / 2)
    scene.add_plane(sand, (0, 0, -1), (0, 0, 0))
    base = np.stack(np.meshgrid(np.arange(-9, 10), np.arange(-9, 10), [0]), -1).reshape(-1, 3) * 2e-3
    scene.add_grains(sand, base, 0.9e-3, fixed=True)
    scene.insert(sand, pendular.even_sizes(1.8e-3, 2e-3), pendular.cylinder((0, 0, 1.2e-3), (0, 0, 0.03), 5e-3),
                 solid_fraction=0.45, seed=seed)
    scene.gravity = (0, 0, -9.81)
    scene.choose_time_step()
    scene.run(time)
    x = scene.position[len(base):]
    width = np.sqrt((x[:, 0]**2 + x[:, 1]**2).mean())
    # Of a cone of height h and radius R the mean height is h / 4, and the mean square of the distance 3 / 10 R^2. Moments of
    # all grains are less noisy than the line through the tops.
    height, radius = 4 * (x[:, 2].mean() - x[:, 2].min()), np.sqrt(10 / 3) * width
    return np.degrees(np.arctan(height / radius)), width


def calibrate(angle, width, evaluations=20):
    """Friction and rolling friction; an evaluation is two heaps."""
    def miss(numbers):
        found = np.array([heap(*numbers, seed=seed) for seed in (1, 2)]).mean(0)
        return ((found[0] - angle) / 1.0)**2 + ((found[1] - width) / 5e-4)**2  # over what two heaps differ by

    start = [(0.3, 0.05), (0.7, 0.05), (0.3, 0.25)]
    return minimize(miss, start[0], method="Nelder-Mead", bounds=((0.05, 1.0), (0.0, 0.5)),
                    options=dict(maxfev=evaluations, initial_simplex=start)).x


def main(arguments=None):
    options = argparse.ArgumentParser(description="Calibration against an angle of repose.")
    options.add_argument("--angle", type=float, default=12.0, help="degrees")
    options.add_argument("--width", type=float, default=11e-3, help="m")
    options.add_argument("--evaluations", type=int, default=20, help="of two heaps each")
    given = options.parse_args(arguments)
    found = calibrate(given.angle, given.width, given.evaluations)
    angle, width = heap(*found)
    print(f"friction {found[0]:.3f}, rolling friction {found[1]:.3f}: {angle:.1f} degrees, {1e3 * width:.2f} mm")


if __name__ == "__main__":
    main()
