#!/usr/bin/env python3
"""Glass of 0.3 mm settles in water, by each drag law: the speed over the porosity, beside Richardson and Zaki's power law.

A chain of grains, spread evenly along the axis of a closed column that is just so wide that the porosity is the wanted one:
as much water rises as grains fall. Beside it, from the same laws, how high a bed stands whose water rises.

    settling.py [--output FOLDER]
"""
import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import pendular

DIAMETER, DENSITY, GRAVITY = 0.3e-3, 2500, 9.81  # m, kg/m^3, m/s^2
WATER = {"density": 998.2, "viscosity": 1.002e-3}
LAWS = ["WenYu", "Gidaspow", "DiFelice", "Beetstra"]
POROSITIES = [0.5, 0.6, 0.7, 0.75, 0.85, 0.9, 0.95]
GRAINS_OF_CELL, CELLS = 4, 10


def settle(law, porosity):
    """m/s, downwards, of the grains in the middle of the column once they fall steadily."""
    volume, spacing = np.pi / 6 * DIAMETER**3, 2 * DIAMETER
    half = np.sqrt(volume / ((1 - porosity) * spacing)) / 2
    scene = pendular.Scene()
    glass = scene.add_species("LinearViscoelastic", density=DENSITY, stiffness=10)
    count = GRAINS_OF_CELL * CELLS
    places = np.zeros((count, 3))
    places[:, 2] = spacing * (np.arange(count) + 0.5)
    scene.add_grains(glass, places, DIAMETER / 2)
    height = spacing * count
    scene.add_fluid((-half, -half, -height), (half, half, 2 * height), (1, 1, 3 * CELLS), drag_law=law,
                    superficial_speed=0, **WATER)
    scene.gravity = (0, 0, -GRAVITY)
    alone = pendular.terminal_speed(DIAMETER, DENSITY, **WATER)
    scene.time_step = 0.002 * alone / GRAVITY
    scene.run(10 * alone / GRAVITY)  # 9 diameters at most: the ends of the chain are not felt in the middle
    middle = slice(count // 2 - GRAINS_OF_CELL, count // 2 + GRAINS_OF_CELL)
    return -scene.velocity[middle, 2].mean()


def balanced(law, porosity):
    """The same in closed form: the speed at which the drag is the weight."""
    return pendular.balanced_speed(law, porosity, DIAMETER, DENSITY, gravity=GRAVITY, **WATER)


def richardson_zaki(porosity):
    """J. F. Richardson and W. N. Zaki, Trans. Inst. Chem. Eng. 32 (1954) 35: u_t eps^n."""
    alone = pendular.terminal_speed(DIAMETER, DENSITY, **WATER)
    reynolds = WATER["density"] * alone * DIAMETER / WATER["viscosity"]
    assert 1 <= reynolds < 500
    return alone * porosity ** (4.45 * reynolds**-0.1)


def main(arguments=None):
    options = argparse.ArgumentParser(description="Glass settles in water.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of figure and table")
    folder = options.parse_args(arguments).output
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5))
    fine, rows = np.linspace(0.45, 0.99, 200), []
    for color, law in zip(["#D55E00", "#56B4E9", "#009E73", "#000000"], LAWS):
        speeds = [settle(law, porosity) for porosity in POROSITIES]
        rows += [(law, p, v, balanced(law, p), richardson_zaki(p)) for p, v in zip(POROSITIES, speeds)]
        curve = np.array([balanced(law, p) for p in fine])
        left.plot(POROSITIES, 1e3 * np.array(speeds), "o", color=color, label=law)
        left.plot(fine, 1e3 * curve, "-", color=color, lw=0.8)
        right.plot(curve / balanced(law, 0.45), (1 - 0.45) / (1 - fine), "-", color=color, label=law)
    left.plot(fine, 1e3 * richardson_zaki(fine), "k--", label="Richardson and Zaki")
    left.set_xlabel("porosity"), left.set_ylabel("settling speed, mm/s"), left.legend()
    right.plot(richardson_zaki(fine) / richardson_zaki(0.45), (1 - 0.45) / (1 - fine), "k--", label="Richardson and Zaki")
    right.set_xlim(1, 8), right.set_ylim(1, 5)
    right.set_xlabel("speed of the water / that at a porosity of 0.45")
    right.set_ylabel("height of the bed / that at 0.45"), right.legend()
    figure.tight_layout()
    figure.savefig(folder / "settling.png", dpi=110)
    table = folder / "settling.csv"
    table.write_text("law,porosity,speed_m_s,speed_of_the_law_m_s,richardson_zaki_m_s\n" + "".join(
        f"{law},{p},{v:.8g},{b:.8g},{r:.8g}\n" for law, p, v, b, r in rows))
    worst = max(abs(v / b - 1) for _, _, v, b, _ in rows)
    print(f"{len(rows)} columns settle at the speed of their law, to {100 * worst:.2f} %; of Richardson and Zaki's speed "
          f"they have {min(v / r for _, _, v, _, r in rows):.2f} to {max(v / r for _, _, v, _, r in rows):.2f}")


if __name__ == "__main__":
    main()
