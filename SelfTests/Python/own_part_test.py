"""A part of the step whose phases are functions of Python: still air, against its closed form."""
import gc
import signal
import subprocess
import sys
import weakref

import numpy as np
import pytest

import pendular
from conftest import GLASS, glass_in

TAU = 0.01  # s, in which air at rest takes a grain's velocity to 1/e of it


class StillAir:
    """A linear drag, exact for any step. It remembers the energy that the air has taken."""

    def __init__(self, name="still air"):
        self.name = name
        self.remembered = {"taken": 0.0}

    def prepare(self, scene, length):
        before = scene.velocity
        scene.velocity = np.exp(-length / TAU) * before
        self.remembered["taken"] += 0.5 * (scene.mass[:, None] * (before**2 - scene.velocity**2)).sum()

    def summary(self):
        return {"energy taken (J)": self.remembered["taken"]}


def flight(name="", **options):
    """Two grains that are far apart, without weight."""
    scene = pendular.Scene(name, **options)
    glass = glass_in(scene)
    scene.add_grains(glass, [[0, 0, 0], [1, 0, 0]], 1e-3, velocity=[[0, 1, 2], [0.5, 0, 0]])
    scene.time_step = 2e-6
    return scene, scene.add_part(StillAir())


def test_velocities_fall_as_in_the_closed_form():
    """v = v0 exp(-t/tau) to the rounding of 1000 steps, and the air has taken what the ledger says the driver gave."""
    scene, air = flight()
    scene.keep_energy_ledger()
    first = scene.kinetic_energy
    scene.run(steps=1000)
    assert scene.velocity == pytest.approx(np.array([[0, 1, 2], [0.5, 0, 0]]) * np.exp(-scene.time / TAU), rel=1e-12)
    energy = scene.energy()
    assert air.remembered["taken"] == pytest.approx(first - scene.kinetic_energy, rel=1e-12)
    assert energy["given_by_driver_J"] == pytest.approx(-air.remembered["taken"], rel=1e-9)
    assert abs(scene.energy_unaccounted) < 1e-12 * first


def test_a_restart_keeps_bits_and_what_is_remembered():
    whole, itsAir = flight()
    whole.run(steps=60)
    first, _ = flight()
    first.run(steps=25)
    first.write_restart("half.h5")
    second, air = flight()
    second.restart_from("half.h5")
    second.run(steps=35)
    assert second.hash() == whole.hash()
    assert air.remembered["taken"] == itsAir.remembered["taken"] > 0


def test_the_summary_has_its_row():
    scene, air = flight("run")
    scene.write_summary()
    scene.run(steps=10)
    scene.finish()
    row, = [line for line in open("run-summary.csv") if line.startswith("still air: energy taken (J)")]
    assert float(row.split(",")[1]) == pytest.approx(air.remembered["taken"], rel=1e-12)


@pytest.mark.parametrize("change", [
    lambda s: s.add_grains(s.species[0], [[0, 0, 1]], 1e-3), lambda s: setattr(s, "position", (0, 0, 0)),
    lambda s: s.species[0].set(density=1), lambda s: s.run(steps=1), lambda s: setattr(s, "gravity", (0, 0, 1))])
def test_prepare_changes_velocities_and_nothing_else(change):
    class Part:
        name = "part"

        def prepare(self, scene, length):
            change(scene)

    scene, _ = flight()
    scene.add_part(Part())
    with pytest.raises(pendular.InputError, match="may read its scene, but not change it"):
        scene.run(steps=3)


def test_what_it_raises_reaches_the_caller():
    class Part:
        name = "part"

        def prepare(self, scene, length):
            raise KeyError("mine")

    scene, _ = flight()
    scene.add_part(Part())
    with pytest.raises(KeyError, match="mine"):
        scene.run(steps=3)


def test_check_refuses_a_scene():
    class Part:
        name = "part"

        def check(self, scene):
            if scene.gravity.any():
                raise pendular.InputError("part: gravity must be 0.")

    scene, _ = flight()
    scene.add_part(Part())
    scene.gravity = (0, 0, -9.81)
    with pytest.raises(pendular.InputError, match="gravity must be 0"):
        scene.run(steps=1)


class Named:
    name = "still air"


class NotCallable:
    name, prepare = "part", 3


@pytest.mark.parametrize("part, words", [(object(), "a name"), (Named(), "still air"), (NotCallable(), "function")])
def test_misuse(part, words):
    scene, _ = flight()
    with pytest.raises(pendular.InputError, match=words):
        scene.add_part(part)
    scene.run(steps=2)  # as before
    with pytest.raises(pendular.InputError, match="before the run|set-up|begun"):
        scene.add_part(StillAir("other"))


@pytest.mark.parametrize("answer, words", [
    ("text", "must be a dict of numbers by name; it is 'text'"), (None, "a dict .* it is None"),
    ([1, 2], r"it is \[1, 2\]"), ({"mass (kg)": "heavy"}, "for 'mass .kg.' must be a number; it is 'heavy'"),
    ({"mass (kg)": None}, "must be a number; it is None")])
def test_a_summary_of_another_type(answer, words):
    class Part:
        name = "own"

        def summary(self):
            return answer

    scene, _ = flight("run")
    scene.write_summary()
    scene.add_part(Part())
    with pytest.raises(pendular.InputError, match=r"part 'own': what summary\(\) returns .*" + words) as caught:
        scene.run(steps=1)
    assert "\n" not in str(caught.value) and str(caught.value).endswith(".")


class Interrupted(StillAir):
    """Ctrl-C comes in the middle of its work, in the 30th step. (A signal of the operating system may come a little later.)"""
    times = 1

    def prepare(self, scene, length):
        if scene.steps == 29:
            for _ in range(self.times):
                signal.raise_signal(signal.SIGINT)
        super().prepare(scene, length)


def interrupted_flight(name, times=1):
    scene, _ = flight(name)
    air = Interrupted("other air")
    air.times = times
    scene.add_part(air)
    return scene, air


def test_control_c_within_prepare_waits_for_the_end_of_the_step():
    """The step is whole, in the scene and in the restart file; the scene goes on with the bits of a run without the stop."""
    whole, _ = interrupted_flight("whole", times=0)
    whole.run(steps=60)
    scene, air = interrupted_flight("run")
    scene.keep_restart_file()
    with pytest.raises(KeyboardInterrupt):
        scene.run(steps=60)
    assert scene.steps == 30 and not scene.has_ended and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    again, _ = interrupted_flight("again")
    again.restart_from("run-restart.h5")
    for one in (scene, again):
        one.run(steps=30)
        assert one.hash() == whole.hash()


def test_a_second_control_c_does_not_wait():
    scene, air = interrupted_flight("run", times=2)
    with pytest.raises(KeyboardInterrupt):
        scene.run(steps=60)
    assert scene.has_ended and scene.steps == 29
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_handler_of_the_script_stays():
    heard = []
    before = signal.signal(signal.SIGINT, lambda *_: heard.append(1))
    try:
        scene, _ = interrupted_flight("run")
        scene.run(steps=60)
        assert heard == [1] and scene.steps == 60
    finally:
        signal.signal(signal.SIGINT, before)


# Functions and objects that know their scene, which keeps them.
KNOWING = {
    "part": lambda s, know: None,  # which the test adds
    "host": lambda s, know: fluid_in(s, host=Host(know)),
    "speed": lambda s, know: fluid_in(s, superficial_speed=lambda t: know(0.01, s)),
    "motion": lambda s, know: s.add_plane(s.species[0], (0, 0, -1), (0, 0, -0.01)).set_motion(
        lambda t: know((0, 0, 0), s)),
    "outlet": lambda s, know: s.add_outlet(normal=(0, 0, -1), point=(0, 0, 0), condition=lambda i: know(False, s)),
    "frames": lambda s, know: s.write_hdf5(1, fields={"mine": lambda _: know(s.mass, s)}),
    "calls": lambda s, know: (s.every_steps(1, lambda _: know(None, s)), s.at_end(lambda _: know(None, s))),
}


class Host:
    def __init__(self, know):
        self.know = know

    def find_velocity(self, fluid, time):
        return self.know((0, 0, 0.01), self)

    def find_pressure(self, fluid, gravity):
        return (0, 0, 0)


def fluid_in(scene, **computed):
    return scene.add_fluid((-1, -1, -1), (2, 1, 1), (1, 1, 8), density=1, viscosity=1e-5, **computed)


@pytest.mark.parametrize("add", KNOWING.values(), ids=KNOWING.keys())
def test_a_scene_and_what_it_calls_that_hold_each_other_are_collected(add):
    def lost():
        scene, air = flight("run")
        air.scene = scene
        kept = [scene]
        add(scene, lambda answer, _: answer if kept else None)
        scene.run(steps=2)
        assert np.isfinite(scene.velocity).all()
        return weakref.ref(scene), weakref.ref(air)

    gone = lost()
    gc.collect()
    assert [of() for of in gone] == [None, None]


def test_bodies_that_are_held_in_part():
    """A clump that is held but along x and about x falls along x alone, with the acceleration g."""
    scene = pendular.Scene()
    glass = scene.add_species("HertzianViscoelasticMindlin", **GLASS)
    body = scene.add_shape(glass, pendular.clump([[0, 0, 0, 1e-3], [1e-3, 0, 0, 1e-3]]), (0, 0, 0))
    scene.hold_body(body, "y z about_y about_z")
    scene.gravity = (-1, -2, -3)
    scene.time_step = scene.stability_limit()
    scene.run(steps=100)
    velocity = scene.bodies()["velocity_m_per_s"][0]
    assert velocity == pytest.approx([-scene.time, 0, 0], rel=1e-9, abs=0)


def test_a_script_may_end_before_its_run(tmp_path):
    """The summary is written at the end of the process, and asks the part for its rows."""
    script = tmp_path / "script.py"
    script.write_text("""
import pendular
class Part:
    name = "own"
    def summary(self):
        return {"rows": 1}
s = pendular.Scene("run")
m = s.add_species("LinearViscoelastic", density=2500, stiffness=100, dissipation=0)
s.add_grains(m, [[0, 0, 0]], 1e-3)
s.time_step = 2e-6
s.write_summary()
s.add_part(Part())
s.run(steps=1)
""")
    ended = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert ended.returncode == 0, ended.stderr


def test_what_it_remembers_is_a_dict():
    class Part:
        name = "own"
        remembered = [1.0]

        def prepare(self, scene, length):
            pass

    scene = pendular.Scene()
    glass = scene.add_species("LinearViscoelastic", density=2500, stiffness=100, dissipation=0)
    scene.add_grains(glass, [[0, 0, 0]], 1e-3)
    scene.time_step = 2e-6
    scene.add_part(Part())
    scene.run(steps=1)
    with pytest.raises(pendular.InputError, match="remembered is no dict"):
        scene.write_restart("restart.h5")
