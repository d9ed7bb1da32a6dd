"""Walls and fluids that a script computes: what it gets and gives, its refusals, and its restarts."""
import sys
from pathlib import Path

import numpy as np
import pytest

import pendular

sys.path.insert(0, str(Path(__file__).parents[2] / "Tools/Python/Examples"))
SQUARE = np.array([[-0.01, -0.01, 0], [0.01, -0.01, 0], [0.01, 0.01, 0], [-0.01, 0.01, 0]])  # m
TRIANGLES = [[0, 1, 2], [0, 2, 3]]
WATER = {"density": 998.2, "viscosity": 1.002e-3}


def ball_on_plate(**name):
    scene = pendular.Scene(**name)
    glass = scene.add_species("LinearViscoelasticSlidingFriction", density=2500, stiffness=200, dissipation=0.01,
                              sliding_stiffness=60, sliding_friction_coefficient=0.5)
    scene.add_grains(glass, [[0.002, 0.001, 0.00101]], 1e-3, velocity=[[0.05, 0, -0.1]])
    wall = scene.add_host_wall(glass, SQUARE, TRIANGLES)
    scene.gravity, scene.time_step = (0, 0, -9.81), 1e-5
    return scene, wall


def test_what_vertices_get_the_grain_loses():
    """Impulses are the change of momentum but for gravity, and their work is that of the host: velocities that it changes."""
    scene, wall = ball_on_plate()
    mass, given, work, rng = scene.total_mass, np.zeros(3), 0.0, np.random.default_rng(1)
    scene.keep_energy_ledger()
    scene.initialise()
    before = mass * scene.velocity[0]
    for _ in range(60):
        wall.set_vertex_velocities(rng.uniform(-0.03, 0.03, (4, 3)))
        scene.run(steps=5)
        given += wall.vertex_impulses.sum(0)
        work += (wall.vertex_impulses * wall.vertex_velocities).sum()
    weight = mass * np.array(scene.gravity) * scene.time
    assert np.linalg.norm(given) > 0.5 * np.linalg.norm(before)
    assert mass * scene.velocity[0] - before == pytest.approx(weight - given, rel=0, abs=1e-12 * np.abs(before).max())
    assert scene.energy()["given_by_walls_J"] == pytest.approx(-work, rel=1e-10)


def test_targets_arrays_and_triangles():
    scene, wall = ball_on_plate()
    assert wall.vertices == pytest.approx(SQUARE) and wall.triangles.tolist() == TRIANGLES
    scene.initialise()
    places = SQUARE + [1e-4, 0, 2e-4]
    wall.set_vertex_targets(places, 20 * scene.time_step)
    scene.run(steps=20)
    assert wall.vertices == pytest.approx(places, abs=1e-15)
    welded = pendular.Scene()
    other = welded.add_species("LinearViscoelastic", density=2500, stiffness=200)
    assert len(welded.add_host_wall(other, SQUARE[TRIANGLES], scale=0.5).vertices) == 4


def test_both_sides_go_on_bit_for_bit(tmp_path):
    def make():
        scene, wall = ball_on_plate(name=str(tmp_path / "coupled"))
        scene.remembered = {"speed": 0.0}

        def exchange(scene):
            scene.remembered["speed"] += wall.vertex_impulses[:, 2].sum() / 5e-5
            wall.set_vertex_velocities(np.tile([0, 0, scene.remembered["speed"]], (4, 1)))

        scene.every_steps(7, exchange)
        return scene, wall

    whole, wall = make()
    whole.run(steps=45)
    assert np.abs(wall.vertex_forces).max() > 0
    whole.write_restart(tmp_path / "half.h5")
    whole.run(steps=400)
    resumed, again = make()
    resumed.restart_from(tmp_path / "half.h5")
    resumed.run(steps=400)
    assert resumed.remembered == whole.remembered
    for name in ("vertices", "vertex_velocities", "vertex_impulses", "vertex_forces"):
        assert np.array_equal(getattr(again, name), getattr(wall, name)), name
    assert np.array_equal(resumed.position, whole.position)


def test_refusals_of_host_walls():
    scene, wall = ball_on_plate()
    glass = scene.add_species("LinearViscoelasticSlidingFriction", density=2500, stiffness=200)
    with pytest.raises(pendular.InputError, match="3 velocities for 4 vertices"):
        wall.set_vertex_velocities(np.zeros((3, 3)))
    with pytest.raises(pendular.InputError, match="counted from 0"):
        scene.add_host_wall(glass, SQUARE, [[0, 1, -2]])
    with pytest.raises(pendular.InputError, match="corner 9"):
        scene.add_host_wall(glass, SQUARE, [[0, 1, 9]])
    plane = scene.add_plane(glass, (0, 0, -1), (0, 0, -1))
    with pytest.raises(pendular.InputError, match="wall of another kind"):
        plane.set_vertex_velocities(np.zeros((4, 3)))


class Column:
    """What ColumnFlow does, by a script: the flux is the same at all heights."""

    def __init__(self, speed):
        self.speed, self.taken = speed, np.zeros(3)

    def find_velocity(self, fluid, time):
        self.shape = fluid.porosity.shape
        up = (self.speed - fluid.solid_flux[..., 2]) / fluid.porosity
        return np.stack([0 * up, 0 * up, up], -1)

    def find_pressure(self, fluid, gravity):
        gradient = np.zeros((*self.shape, 3))
        gradient[..., 2] = -fluid.drag[..., 2] / fluid.porosity
        return WATER["density"] * gravity + gradient

    def take(self, fluid, step):
        self.taken += step * fluid.source.sum((0, 1, 2)) * 4e-3 * 4e-3 * 4e-3


def column(**fluid):
    scene = pendular.Scene()
    glass = scene.add_species("LinearViscoelastic", density=2500, stiffness=100)
    places = [[x, y, 2e-3 + 1.5e-3 * z] for x in (-0.001, 0.001) for y in (-0.001, 0.001) for z in range(8)]
    scene.add_grains(glass, places, 5e-4)
    made = scene.add_fluid((-0.002, -0.002, 0), (0.002, 0.002, 0.02), (1, 1, 5), drag_law="DiFelice", **WATER, **fluid)
    scene.gravity, scene.time_step = (0, 0, -9.81), 2e-5
    return scene, made


def test_fluid_of_a_script_is_that_of_the_kernel():
    """And what it takes is what the grains got of its drag: summed over cells and steps."""
    own = Column(0.02)
    (scene, fluid), (kernel, other) = column(host=own), column(superficial_speed=lambda time: 0.02)
    total = np.zeros(3)
    for _ in range(50):
        scene.run(steps=1)
        total += fluid.drag_impulse
    kernel.run(steps=50)
    assert own.shape == (5, 1, 1)
    assert scene.velocity == pytest.approx(kernel.velocity, rel=1e-12, abs=1e-15)
    assert own.taken == pytest.approx(-total, rel=1e-12, abs=1e-18) and total[2] > 0
    assert fluid.work == pytest.approx(other.work, rel=1e-10) and other.pressure_drop > 0
    volume = len(scene.position) * np.pi / 6 * 1e-9
    assert (1 - fluid.porosity).sum() * 4e-3**3 == pytest.approx(volume, rel=1e-12)
    assert fluid.cell_centres[-1, 0, 0] == pytest.approx([0, 0, 0.018])


def test_columns_settle_at_the_speed_of_their_law():
    pytest.importorskip("matplotlib")
    from settling import balanced, settle

    for law, porosity in (("WenYu", 0.7), ("Beetstra", 0.9)):
        assert settle(law, porosity) == pytest.approx(balanced(law, porosity), rel=5e-3)
    # From an independent program, for 0.3 mm glass in water.
    assert balanced("WenYu", 0.7) == pytest.approx(0.010527928154, rel=1e-8)


def test_laws_by_name():
    assert "Gidaspow" in pendular.drag_laws()
    force = pendular.drag_force("SchillerNaumann", 1, 1e-6, 1e-4, **WATER)
    assert force == pytest.approx(3 * np.pi * 1.002e-3 * 1e-4 * 1e-6, rel=2e-3)  # Stokes; Re = 1e-4
    weight = np.pi / 6 * 0.3e-3**3 * (2500 - 998.2) * 9.81
    speed = pendular.terminal_speed(0.3e-3, 2500, **WATER)
    assert pendular.drag_force("SchillerNaumann", 1, speed, 0.3e-3, **WATER) == pytest.approx(weight, rel=1e-12)


def test_refusals_of_fluids(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a run that ends writes its last state
    for wrong, words in (({}, "superficial_speed"), ({"host": Column(0), "superficial_speed": 1}, "superficial_speed"),
                         ({"host": object()}, "find_velocity"), ({"superficial_speed": 0.1, "model": "C"}, '"C"')):
        with pytest.raises(pendular.InputError, match=words):
            column(**wrong)
    with pytest.raises(pendular.InputError, match="nearest names are Gidaspow"):
        pendular.drag_force("Gidaspov", 1, 1, 1, **WATER)

    class Wrong(Column):
        def find_velocity(self, fluid, time):
            return np.zeros((2, 2))

    scene, _ = column(host=Wrong(0))
    with pytest.raises(pendular.RunError, match=r"find_velocity\(\): the host must return"):
        scene.run(steps=1)
    scene, fluid = column(host=Column(0))
    with pytest.raises(pendular.InputError, match="only a column has it"):
        fluid.pressure_drop


WRONG_ARGUMENTS = {
    "density": ("heavy", r"density must be a number \(kg/m\^3\); it is 'heavy'"),
    "viscosity": (None, r"viscosity must be a number \(Pa s\); it is None"),
    "drag_law": (3, r"drag_law must be a name of drag_laws\(\); it is 3"),
    "model": (1.0, "model must be 'A' or 'B'; it is 1.0"),
    "superficial_speed": ("x", r"superficial_speed must be a number \(m/s\), or a function .*; it is 'x'"),
    "lowest": ("x", "lowest must be three numbers; it is 'x'"),
    "highest": ((1, 2), r"highest must be three numbers; it is \(1, 2\)"),
    "cells": ((1, 1, 2.5), r"cells must be three whole numbers \(nx, ny, nz\); it is \(1, 1, 2.5\)"),
}


@pytest.mark.parametrize("name, wrong, words", [(k, *v) for k, v in WRONG_ARGUMENTS.items()], ids=WRONG_ARGUMENTS.keys())
def test_arguments_of_fluids_of_another_type(name, wrong, words):
    given = {"lowest": (0, 0, 0), "highest": (1, 1, 1), "cells": (1, 1, 5), "superficial_speed": 0.1, **WATER, name: wrong}
    with pytest.raises(pendular.InputError, match=r"add_fluid\(\): " + words) as caught:
        pendular.Scene().add_fluid(**given)
    assert "\n" not in str(caught.value) and str(caught.value).endswith(".")


WRONG_CALLS = {
    "drag_force": (lambda: pendular.drag_force("WenYu", "x", 1, 1, **WATER), r"drag_force\(\): porosity .* it is 'x'"),
    "no name of a law": (lambda: pendular.drag_force(3, 1, 1, 1, **WATER), "law must be a name .* it is 3"),
    "terminal_speed": (lambda: pendular.terminal_speed(1e-3, [1, 2], **WATER), r"grain_density .* it is \[1, 2\]"),
    "balanced_speed": (lambda: pendular.balanced_speed("WenYu", 0.5, 1e-3, 2500, density="x", viscosity=1), "density .* 'x'"),
    "scale": (lambda: host_wall(scale="large"), "scale must be a number; it is 'large'"),
    "triangles": (lambda: host_wall(triangles="x"), "triangles must be rows of 3 numbers; it is 'x'"),
    "vertices": (lambda: host_wall(mesh="x"), "vertices must be rows of 3 numbers; it is 'x'"),
    "no mesh": (lambda: host_wall(mesh=3, triangles=None), "A mesh is the name of a file, or an array"),
    "time": (lambda: host_wall().set_vertex_targets(SQUARE, "soon"), r"time must be a number \(s\); it is 'soon'"),
    "a function that is none": (lambda: column(host=type("Host", (), {"find_velocity": 3})()),
                                r"find_velocity of the host must be a function; it is 3"),
}


def host_wall(mesh=SQUARE, triangles=TRIANGLES, **more):
    scene = pendular.Scene()
    glass = scene.add_species("LinearViscoelastic", density=2500, stiffness=200)
    return scene.add_host_wall(glass, mesh, triangles, **more)


@pytest.mark.parametrize("do, words", WRONG_CALLS.values(), ids=WRONG_CALLS.keys())
def test_other_arguments_of_another_type(do, words):
    with pytest.raises(pendular.InputError, match=words) as caught:
        do()
    assert "\n" not in str(caught.value) and str(caught.value).endswith(".")


@pytest.mark.parametrize("answer, words", [("fast", r"must be a number \(m/s\); it is 'fast'"), (None, "it is None"),
                                           (float("nan"), "= nan m/s"), (float("inf"), "= inf m/s")])
def test_what_a_function_of_the_speed_returns(answer, words):
    """It is right at first."""
    scene, _ = column(superficial_speed=lambda time: 0.02 if time < 1e-4 else answer)
    with pytest.raises(pendular.RunError, match="superficial_speed.*" + words) as caught:
        scene.run(steps=20)
    assert "\n" not in str(caught.value) and scene.steps == 5


def test_a_host_that_returns_no_number():
    class Wrong(Column):
        def find_pressure(self, fluid, gravity):
            pressure = np.zeros((*self.shape, 3))
            pressure[3, 0, 0, 1] = np.nan
            return pressure

    scene, _ = column(host=Wrong(0))
    with pytest.raises(pendular.RunError, match=r"find_pressure\(\): the host returned nan for cell 3"):
        scene.run(steps=1)


def test_ball_on_a_plate_of_modes():
    """The rebound of the converged sum of modes, 0.19323 (an independent program), and of Zener's plate without end, 0.19354."""
    pytest.importorskip("matplotlib")
    from impact import Ball, Plate, hit, zener

    plate, ball = Plate(), Ball()
    time, force, velocity, deflection, of_ball, of_plate = hit(plate, ball, steps_between=2, steps_in_hertz_time=1000)
    rebound = velocity[-1] / ball.speed
    loss, endless = zener(plate, ball)
    assert (loss, endless) == pytest.approx((0.972947, 0.193546), rel=1e-5)
    assert rebound == pytest.approx(0.193233, rel=0.02) and rebound == pytest.approx(endless, rel=0.02)
    assert force.max() == pytest.approx(860.85, rel=0.01)
    assert (of_ball + of_plate)[-1] == pytest.approx(of_ball[0], rel=5e-3)


def test_ball_on_a_plate_of_a_library():
    """Finite elements of GetFEM, with the ball and the wall of the example above."""
    pytest.importorskip("getfem"), pytest.importorskip("scipy"), pytest.importorskip("matplotlib")
    from Libraries.getfem_plate import FinitePlate
    from impact import Ball, hit

    plate, ball = FinitePlate(), Ball()
    time, force, velocity, *_ = hit(plate, ball, steps_between=4, steps_in_hertz_time=1000)
    assert velocity[-1] / ball.speed == pytest.approx(0.193233, rel=0.03)


def test_grains_go_through_a_periodic_face_in_a_fluid():
    """Two alike but for a period get the same of the fluid, also the one that has left the box on its way."""
    ends = []
    for x in (0.0199, 0.0101):
        scene = pendular.Scene()
        glass = scene.add_species("HertzianViscoelastic", density=2500, young_modulus=1e7, poisson_ratio=0.3,
                                  restitution_coefficient=0.5)
        scene.time_step = 1e-5
        scene.set_periodic("x", 0, 0.02)
        scene.set_periodic("y", 0, 0.02)
        scene.add_grains(glass, [[x, 0.01, 0.02]], 0.002, velocity=[[0.5, 0, 0]])
        scene.add_fluid((0, 0, 0), (0.02, 0.02, 0.06), (1, 1, 4), superficial_speed=0.1, **WATER)
        scene.run(steps=100)
        ends.append(scene.velocity[0])
    assert ends[0] == pytest.approx(ends[1], rel=1e-12)
    with pytest.raises(pendular.InputError, match="it must go from 0 to 0.02 m"):
        scene = pendular.Scene()
        glass = scene.add_species("LinearViscoelastic", density=2500, stiffness=100, dissipation=0)
        scene.add_grains(glass, [[0.01, 0.01, 0.02]], 0.002)
        scene.time_step = 1e-5
        scene.set_periodic("x", 0, 0.02)
        scene.add_fluid((-0.01, 0, 0), (0.03, 0.02, 0.06), (1, 1, 4), superficial_speed=0.1, **WATER)
        scene.run(steps=1)


def test_a_host_has_the_vertices_to_itself():
    _, wall = ball_on_plate()
    for call in (lambda: wall.set_pressure(1.0), lambda: wall.hold(lambda p: True), wall.hold_rim):
        with pytest.raises(pendular.InputError, match="it is a host wall"):
            call()
