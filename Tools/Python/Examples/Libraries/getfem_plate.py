#!/usr/bin/env python3
"""A host from a library: the plate of impact.py by finite elements of GetFEM, which a steel ball hits.

The library has the elements, of Hsieh, Clough and Tocher, and the stiffness and mass of Kirchhoff's plate; time is Newmark's
average acceleration, with one factorisation of a sparse matrix. (Tools/install-dependencies.sh --hosts)

    getfem_plate.py [--output FOLDER]
"""
import argparse
import sys
from pathlib import Path

import getfem
import matplotlib.pyplot as plt
import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

sys.path.insert(0, str(Path(__file__).parents[1]))
from impact import Ball, Plate, hit, zener  # noqa: E402


def sparse(matrix):
    pointers, rows = matrix.csc_ind()
    return csc_matrix((matrix.csc_val(), rows, pointers), shape=matrix.size())


class FinitePlate(Plate):
    """A square of this half width around the spot; its rim is held, and is so far that no wave comes back in the contact."""

    def __init__(self, half_width=0.2, finest=1.5e-3, cells=36, **numbers):
        super().__init__(modes=1, **numbers)
        along = np.linspace(0, 1, cells + 1)
        side = finest * cells * along + (half_width - finest * cells) * along**4
        side = np.concatenate([-side[:0:-1], side])
        self.mesh = getfem.Mesh("triangles grid", side, side)
        plate = getfem.MeshFem(self.mesh, 1)
        plate.set_fem(getfem.Fem("FEM_REDUCED_HCT_TRIANGLE"))
        method = getfem.MeshIm(self.mesh, getfem.Integ("IM_HCT_COMPOSITE(IM_TRIANGLE(5))"))
        self.mesh.set_region(1, self.mesh.outer_faces())
        model = getfem.Model("real")
        model.add_fem_variable("w", plate)
        model.add_initialized_data("D", [self.bending])
        model.add_initialized_data("nu", [self.material.poisson_ratio])
        model.add_Kirchhoff_Love_plate_brick(method, "w", "D", "nu")
        model.add_Dirichlet_condition_with_penalization(method, "w", 1e9, 1)
        model.assembly("build_matrix")
        self.stiffness = sparse(model.tangent_matrix())
        self.mass = sparse(getfem.asm_mass_matrix(method, plate)) * self.material.density * self.thickness
        corners = getfem.MeshFem(self.mesh, 1)
        corners.set_classical_fem(1)
        self.values = sparse(getfem.asm_interpolation_matrix(plate, corners))  # of w at the corners of the mesh
        self.corners = corners.basic_dof_nodes().T
        self.w, self.velocity, self.acceleration = np.zeros((3, self.mass.shape[0]))
        self.solvers = {}

    def patch(self, radius, cells=None):
        """The triangles of the mesh around the spot, whose corners are vertices of the wall."""
        number = {tuple(np.round(p, 12)): k for k, p in enumerate(self.corners)}
        points = self.mesh.pts()
        faces = []
        for cell in self.mesh.cvid():
            ids = self.mesh.pid_from_cvid(int(cell))[0]
            if np.abs(points[:, ids]).max() < radius:
                faces.append([number[tuple(np.round(points[:, i], 12))] for i in ids])
        faces = np.array(faces)
        self.used, faces = np.unique(faces, return_inverse=True)
        faces = faces.reshape(-1, 3)
        vertices = np.zeros((len(self.used), 3))
        vertices[:, :2] = self.corners[self.used] + self.spot
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        turned = np.cross(b - a, c - a)[:, 2] < 0  # corners run counter-clockwise as seen by the ball
        faces[turned] = faces[turned][:, ::-1]
        self.shown = self.values[self.used]
        return vertices, faces

    def middle(self, vertices):
        return int(np.argmin(np.linalg.norm(vertices[:, :2] - self.spot, axis=1)))

    def deflection(self):
        return self.shown @ self.w

    def advance(self, force, time):
        """Newmark's method with beta = 1/4, gamma = 1/2."""
        if time not in self.solvers:
            self.solvers[time] = splu((self.mass + time**2 / 4 * self.stiffness).tocsc())
        w = self.w + time * self.velocity + time**2 / 4 * self.acceleration
        v = self.velocity + time / 2 * self.acceleration
        self.acceleration = self.solvers[time].solve(self.shown.T @ force - self.stiffness @ w)
        self.w, self.velocity = w + time**2 / 4 * self.acceleration, v + time / 2 * self.acceleration

    def energy(self):
        return (self.velocity @ (self.mass @ self.velocity) + self.w @ (self.stiffness @ self.w)) / 2


def main(arguments=None):
    options = argparse.ArgumentParser(description="A steel ball hits a plate of finite elements.")
    options.add_argument("--output", type=Path, default=Path("."), help="folder of the figure")
    given = options.parse_args(arguments)
    plate, ball = FinitePlate(), Ball()
    time, force, velocity, deflection, of_ball, of_plate = hit(plate, ball, steps_between=4)
    print(f"rebound {velocity[-1] / ball.speed:.4f}, of a plate without end {zener(plate, ball)[1]:.4f}; "
          f"largest force {force.max():.1f} N; energy off by {(of_ball + of_plate)[-1] / of_ball[0] - 1:.1e}")
    x, y = plate.corners.T
    figure, axes = plt.subplots(figsize=(6, 5))
    shades = axes.tripcolor(1e3 * x, 1e3 * y, 1e6 * (plate.values @ plate.w), shading="gouraud")
    figure.colorbar(shades, label="deflection, µm"), axes.set_xlabel("mm"), axes.set_ylabel("mm")
    figure.savefig(given.output / "getfem_plate.png")


if __name__ == "__main__":
    main()
