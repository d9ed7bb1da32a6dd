#!/usr/bin/env python3
"""A hopper empties: its mass flow beside that of Beverloo.

Beverloo, Leniger and van de Velde (1961), Chem. Eng. Sci. 15, 260: W = C rho sqrt(g) (D - k d)^2.5, with the outlet D,
the grain d, the bulk density rho, C = 0.58 and k = 1.4 for spheres.

    hopper.py [--output FOLDER] [--outlet M]
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pendular

GRAIN, WIDTH, HEIGHT, DENSITY = 1.5e-3, 0.027, 0.04, 2500  # m, m, m, kg/m^3


def beverloo(outlet, bulk):
    """kg/s"""
    return 0.58 * bulk * np.sqrt(9.81) * (outlet - 1.4 * GRAIN) ** 2.5


def empty(outlet, fill=0.55):
    """Columns of time (s) and of the mass (kg) that has come out, up to a quarter, which leaves a head of more than two outlets;
    and the bulk density (kg/m^3) of the bed at rest: its mass over the cylinder up to the mean of the twenty highest centres."""
    scene = pendular.Scene()
    # Mindlin, not MindlinIncremental: only the flow counts, a bulk quantity.
    glass = scene.add_species("HertzianViscoelasticMindlin", density=DENSITY, young_modulus=2e6, poisson_ratio=0.25,
                              restitution_coefficient=0.7, sliding_friction_coefficient=0.25)  # glass beads
    # A flat bottom with a round outlet: that is what Beverloo's constants are for.
    scene.add_profile(glass, axis=(0, 0, 1), point=(0, 0, 0),
                      profile=[(outlet / 2, 0), (WIDTH / 2, 0), (WIDTH / 2, 2 * HEIGHT)])
    gate = scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
    scene.insert(glass, pendular.even_sizes(0.9 * GRAIN, 1.1 * GRAIN),
                 pendular.cylinder((0, 0, 0), (0, 0, HEIGHT), WIDTH / 2), solid_fraction=fill)
    outside = scene.add_outlet(normal=(0, 0, -1), point=(0, 0, -0.02))
    scene.gravity = (0, 0, -9.81)
    scene.set_step_for(0.02, figure="solid_fraction")  # flow to 2 %, in a fifth of the time of choose_time_step()
    scene.run(0.1)
    top = np.sort(scene.position[:, 2])[-20:].mean()
    bulk = scene.total_mass / (np.pi * WIDTH**2 / 4 * top)
    scene.remove_wall(gate)
    total, rows = scene.total_mass, []
    scene.every_time(0.01, lambda s: rows.append((s.time, s.outlet(outside)["mass_kg"])) or rows[-1][1] < 0.25 * total)
    scene.run(5)
    return (*np.array(rows).T, bulk)


def flow_of(time, mass, batches=20):
    """kg/s, and its standard error: what has come out over the time, after the first tenth; the error is that of the mean of
    batches, windows of equal length. (The standard error of a line fitted to the cumulated mass is far too small.)"""
    steady = mass > 0.1 * mass[-1]
    time, mass = time[steady], mass[steady]
    if len(time) < 6:
        raise SystemExit("Too few rows after the first tenth for a flow and its error.")
    ends = np.linspace(time[0], time[-1], min(batches, len(time) - 1) + 1)
    flows = np.diff(np.interp(ends, time, mass)) / np.diff(ends)
    return (mass[-1] - mass[0]) / (time[-1] - time[0]), flows.std(ddof=1) / np.sqrt(len(flows))


def main(arguments=None):
    options = argparse.ArgumentParser(description="A hopper empties.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the figure")
    options.add_argument("--outlet", type=float, default=0.0105, help="m, diameter")
    given = options.parse_args(arguments)
    time, mass, bulk = empty(given.outlet)
    flow, error = flow_of(time, mass)
    print(f"{1e3 * flow:.2f} g/s (standard error {100 * error / flow:.0f} %); Beverloo {1e3 * beverloo(given.outlet, bulk):.2f} g/s")
    plt.plot(time, 1e3 * mass)
    plt.xlabel("time, s"), plt.ylabel("mass that has come out, g")
    plt.savefig(given.output / "hopper.png")


if __name__ == "__main__":
    main()
