#!/usr/bin/env python3
"""A run is stopped and goes on to the same bits; its files are read as tables.

    restart.py [--output FOLDER]
"""
import argparse
from pathlib import Path

import numpy as np

import pendular


def make_scene(name):
    scene = pendular.Scene(name)
    glass = scene.add_species("HertzianViscoelasticMindlinIncremental", density=2500, young_modulus=5e6, poisson_ratio=0.25,
                              restitution_coefficient=0.5, sliding_friction_coefficient=0.4)
    scene.add_box(glass, (0, 0, 0), (0.012, 0.012, 0.03))
    scene.gravity = (0, 0, -9.81)
    scene.insert(glass, pendular.even_sizes(1.8e-3, 2e-3), pendular.box((0, 0, 0), (0.012, 0.012, 0.03)),
                 solid_fraction=0.3)
    scene.choose_time_step()
    return scene


def main(arguments=None):
    options = argparse.ArgumentParser(description="A run is stopped and goes on.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the files")
    folder = options.parse_args(arguments).output
    with make_scene(str(folder / "whole")) as whole:
        whole.write_hdf5(0.01), whole.write_energy(0.002)
        whole.run(0.05)
    first = make_scene(str(folder / "first"))
    first.run(0.02)
    first.write_restart(folder / "at-20ms.h5")
    second = make_scene(str(folder / "second"))
    second.restart_from(folder / "at-20ms.h5")
    second.run(0.05)
    print("whole", whole.hash(), "stopped", second.hash())
    print(pendular.table(folder / "whole-energy.csv")[["time_s", "kinetic_J", "potential_J"]].tail(2).to_string())
    for time, grains in pendular.frames(folder / "whole-fields.h5"):
        print(f"{time:.3f} s: the highest centre is at {1e3 * np.max(grains['position_m'][:, 2]):.2f} mm")


if __name__ == "__main__":
    main()
