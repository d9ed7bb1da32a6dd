#!/usr/bin/env python3
"""A bridge between three equal spheres that nearly touch, by Surface Evolver: its energy, pressure and pair force.

    three-grains.py [--output FOLDER] [--angle DEGREES] [--volume R^3] [--refinements N]

R = gamma = 1. The energy is that of the free surface less cos(theta) times the wetted area; pair force is the attraction
along one side of the triangle, dE/dS/3. Beside it the energies of the same liquid in three bridges, and in two, and the lowest
eigenvalue of the second variation at this volume, for shifts along the surface's normal (gamma/R^2): below 0 the bridge is
a saddle, which falls apart at the least push. Writes FOLDER/three-grains.csv. Needs `evolver` (apt install evolver-nox).

The shape (K. A. Brakke, Exp. Math. 1 (1992) 141) is that of the free surface alone. Areas on a sphere and the liquid's volume
below them are integrals along its contact line (Stokes): of a unit sphere with the axis n towards the middle of the three,
local coordinates (x, y, z) with z along n, and W = x dy - y dx,
    area = integral of W/(1 + z),    volume = integral of W (d/6 - 1/(3 (1 + z))),
the latter as the flux of a third of the place, d being the distance of the centre from the middle.
"""
import argparse
import re
import subprocess
import tempfile
from pathlib import Path

import numpy as np

GAPS = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]  # R
HALF_HEIGHT, HALF_WIDTH = 0.45, 0.70  # of the patches at the start: they enclose the points that touch


class Net:
    """Vertices, edges and faces of a file for Evolver; `grain` says on which sphere they are."""

    def __init__(self):
        self.vertices, self.edges, self.faces = [], [], []

    def vertex(self, place, grain):
        self.vertices.append((place, grain))
        return len(self.vertices)

    def edge(self, a, b, grain=None):
        self.edges.append((a, b, grain))
        return len(self.edges)

    def face(self, *edges):
        self.faces.append(edges)


def frames(gap, grains):
    """Of each sphere: its centre, its axis n towards the middle, and the distance of both."""
    distance = (2 + gap) / np.sqrt(3) if grains == 3 else 1 + gap / 2
    for turn in np.deg2rad([90, 210, 330] if grains == 3 else [0, 180]):
        out = np.array([np.cos(turn), np.sin(turn), 0])
        yield distance * out, -out, distance


def patches_of(net, gap, grains):
    """The corners and edges of a patch on each sphere, which is left out: `up` along z, `on` along n x z."""
    height = np.sqrt(1 - HALF_HEIGHT**2 - HALF_WIDTH**2)
    for grain, (centre, n, _) in enumerate(frames(gap, grains), 1):
        across = np.array([n[1], -n[0], 0])  # n x z, counter-clockwise around the middle
        corner = {(up, on): net.vertex(centre + height * n + up * HALF_HEIGHT * np.array([0, 0, 1])
                                       + on * HALF_WIDTH * across, grain) for up in (1, -1) for on in (1, -1)}
        loop = [(1, -1), (1, 1), (-1, 1), (-1, -1)]  # counter-clockwise about n
        yield corner, [net.edge(corner[a], corner[b], grain) for a, b in zip(loop, loop[1:] + loop[:1])]


def box(gap):
    """Four sides between the patches of two spheres."""
    net = Net()
    (a, of_a), (b, of_b) = patches_of(net, gap, 2)
    across = {(up, on): net.edge(a[up, on], b[up, -on]) for up in (1, -1) for on in (1, -1)}
    net.face(of_a[0], across[1, 1], of_b[0], -across[1, -1])
    net.face(of_a[1], across[-1, 1], of_b[3], -across[1, 1])
    net.face(of_a[2], across[-1, -1], of_b[2], -across[-1, 1])
    net.face(of_a[3], across[1, -1], of_b[1], -across[-1, -1])
    return net


def prism(gap):
    """Two hexagons and three sides between the patches of three spheres."""
    net = Net()
    patches = list(patches_of(net, gap, 3))
    across = [{up: net.edge(patches[k][0][up, 1], patches[(k + 1) % 3][0][up, -1]) for up in (1, -1)} for k in range(3)]
    tops, bottoms = [], []
    for k in range(3):
        tops += [patches[k][1][0], across[k][1]]
        bottoms += [patches[2 - k][1][2], -across[(1 - k) % 3][-1]]
        net.face(across[k][-1], patches[(k + 1) % 3][1][3], -across[k][1], patches[k][1][1])
    net.face(*tops)
    net.face(*bottoms)
    return net


def along_line(grain, centre, n, of):
    """A method of Evolver along the contact line: `of` times W, in terms of z."""
    x, y = "z", f"((x-({centre[0]!r}))*({n[1]!r})-(y-({centre[1]!r}))*({n[0]!r}))"
    z = f"((x-({centre[0]!r}))*({n[0]!r})+(y-({centre[1]!r}))*({n[1]!r}))"
    factor = of.replace("Z", z)
    return (f"q1: {x}*({n[1]!r})*({factor})\nq2: -{x}*({n[0]!r})*({factor})\nq3: -{y}*({factor})\n")


def evolver_file(gap, degrees, volume, grains):
    cosine = float(np.cos(np.deg2rad(degrees)))
    def listed(name, first):
        return " ".join(f"method {name}{k}" for k in range(first, grains + 1))

    text = ["parameter unit = 1\n"]
    for grain, (centre, n, distance) in enumerate(frames(gap, grains), 1):
        centre, n = centre.tolist(), n.tolist()
        text.append(f"constraint {grain}\nformula: (x-({centre[0]!r}))^2+(y-({centre[1]!r}))^2+z^2 = 1\n")
        text.append(f"method_instance wet{grain} method edge_vector_integral\nvector_integrand:\n"
                    + along_line(grain, centre, n, "1/(1+Z)"))
        text.append(f"method_instance under{grain} method edge_vector_integral\nvector_integrand:\n"
                    + along_line(grain, centre, n, f"({distance / 6!r}-1/(3*(1+Z)))"))
    text.append("method_instance under0 method facet_vector_integral\nvector_integrand:\nq1: x/3\nq2: y/3\nq3: z/3\n")
    text.append(f"quantity wetted energy modulus {-cosine!r} " + listed("wet", 1) + "\n")
    text.append(f"quantity liquid fixed = {volume!r} " + listed("under", 0) + "\n")
    net = prism(gap) if grains == 3 else box(gap)
    text.append("vertices\n")
    text += [f"{k} {p[0]!r} {p[1]!r} {p[2]!r} constraint {g}\n" for k, (p, g) in
             enumerate([(np.asarray(p).tolist(), g) for p, g in net.vertices], 1)]
    text.append("edges\n")
    text += [f"{k} {a} {b}" + (f" constraint {g} wet{g} under{g}" if g else "") + "\n"
             for k, (a, b, g) in enumerate(net.edges, 1)]
    text.append("faces\n")
    text += [f"{k} " + " ".join(map(str, f)) + " under0\n" for k, f in enumerate(net.faces, 1)]
    return "".join(text)


STEPS = "g 10; r; g 60; r; g 60; M 2; U; {g 150}; V; {g 250}"  # to 384 facets (256 of two grains)
SHOW = 'printf "RESULT %d %.12f %.12f %.12f\\n", facet_count, total_energy, liquid.pressure, liquid.value'


def evolve(gap, degrees, volume, grains, commands):
    """What Evolver says."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "three.fe"
        path.write_text(evolver_file(gap, degrees, volume, grains))
        done = subprocess.run(["evolver", "-x", str(path)], input="\n".join([STEPS, *commands, "q"]) + "\n",
                              capture_output=True, text=True, timeout=1200)
    return done.stdout + done.stderr


def relax(gap, degrees, volume, refinements=1, grains=3):
    """Rows of facets, energy, pressure and volume: at 384 facets (256 of two grains), and after each refinement."""
    said = evolve(gap, degrees, volume, grains,
                  [SHOW] + [x for _ in range(refinements) for x in ("r; {g 200}; V; {g 300}", SHOW)])
    rows = [line.split("RESULT", 1)[1].split() for line in said.splitlines() if line.startswith("RESULT")]
    if len(rows) != refinements + 1:
        raise RuntimeError(f"evolver did not come through:\n{said[-2000:]}")
    return [(int(n), float(e), float(p), float(v)) for n, e, p, v in rows]


def eigenvalues(gap, degrees, volume, count=4, refine=""):
    """The lowest of the second variation where the first one is zero: by Newton's steps, of a bridge that may be a saddle."""
    newton = ["U", "linear_metric", *3 * ["hessian_seek"], *3 * ["hessian"]]
    said = evolve(gap, degrees, volume, 3, [refine, *newton, f"ritz(-5,{count})"])
    found = re.findall(r"^ +\d+\. +(-?\d+\.\d{8,}) *$", said[said.rfind("Eigencounts"):], re.MULTILINE)
    if len(found) != count:
        raise RuntimeError(f"evolver did not come through:\n{said[-2000:]}")
    return sorted(map(float, found))


def main():
    options = argparse.ArgumentParser(description="A bridge between three equal spheres, by Surface Evolver.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the table")
    options.add_argument("--angle", type=float, default=40, help="degrees, of contact")
    options.add_argument("--volume", type=float, default=0.6, help="R^3, of the liquid")
    options.add_argument("--refinements", type=int, default=1, help="beyond 384 facets, each four times as many")
    given = options.parse_args()
    lines = ["theta_deg,volume,gap,energy,pressure,pair_force,energy_of_three_bridges,energy_of_two_bridges,"
             "lowest_eigenvalue\n"]

    def extrapolated(rows):
        """Quadratic elements: the error falls by 16 with each refinement."""
        return rows[-1][1] + (rows[-1][1] - rows[-2][1]) / 15

    found = [relax(gap, given.angle, given.volume, given.refinements) for gap in GAPS]
    energy = [extrapolated(rows) for rows in found]
    force = np.polyval(np.polyder(np.polyfit(GAPS, energy, len(GAPS) - 2)), GAPS) / 3
    for gap, e, f, rows in zip(GAPS, energy, force, found):
        apart = [count * extrapolated(relax(gap, given.angle, given.volume / count, given.refinements, grains=2))
                 for count in (3, 2)]
        lines.append(f"{given.angle:g},{given.volume:g},{gap},{e:.6f},{rows[-1][2]:.5f},{f:.4f},"
                     f"{apart[0]:.6f},{apart[1]:.6f},{eigenvalues(gap, given.angle, given.volume)[0]:.3f}\n")
        print(lines[-1], end="", flush=True)
    (given.output / "three-grains.csv").write_text("".join(lines))


if __name__ == "__main__":
    main()
