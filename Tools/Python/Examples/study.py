#!/usr/bin/env python3
"""The spread of a heap over the coefficient of friction, on several processes; or one value, for a job of an array.

    study.py [--output FOLDER] [--processes N] [--only K]
"""
import argparse
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import pandas

import pendular

FRICTIONS = [0.0, 0.1, 0.2, 0.4, 0.8]


def heap(friction, time=0.1):
    """A row, of a column of grains that has fallen apart for a time (s): height_m, of the highest centre above the floor;
    spread_m, the mean horizontal distance of the centres from the axis of the column; hash, of the state."""
    scene = pendular.Scene()
    # Mindlin, not MindlinIncremental: only the spread of the heap counts, a bulk quantity.
    glass = scene.add_species("HertzianViscoelasticMindlin", density=2500, young_modulus=5e6, poisson_ratio=0.25,
                              restitution_coefficient=0.5, sliding_friction_coefficient=friction)
    scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
    column = pendular.box((-4e-3, -4e-3, 1e-3), (4e-3, 4e-3, 0.016))
    scene.insert(glass, pendular.even_sizes(1.8e-3, 2e-3), column, solid_fraction=0.4, seed=1)
    scene.gravity = (0, 0, -9.81)
    scene.choose_time_step()
    scene.run(time)
    x = scene.position
    return dict(friction=friction, grains=len(scene), height_m=x[:, 2].max(),
                spread_m=np.hypot(x[:, 0], x[:, 1]).mean(), hash=scene.hash())


def main(arguments=None):
    options = argparse.ArgumentParser(description="A study over friction.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the table")
    options.add_argument("--processes", type=int, default=2)
    options.add_argument("--only", type=int, choices=range(len(FRICTIONS)),
                         help="the place of one value in the list, for a job of an array")
    given = options.parse_args(arguments)
    values = FRICTIONS if given.only is None else [FRICTIONS[given.only]]
    with ProcessPoolExecutor(given.processes) as pool:
        table = pandas.DataFrame(pool.map(heap, values))
    name = "study.csv" if given.only is None else f"study-{given.only}.csv"
    table.to_csv(given.output / name, index=False)
    print(table.to_string(index=False))


if __name__ == "__main__":
    main()
