"""Many small scenes at once: collisions() against closed forms, its arrays, threads and refusals; run_many()."""
import re
import signal
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

import pendular
from conftest import GLASS, tower

EXAMPLES = Path(__file__).parents[2] / "Tools/Python/Examples"
RADIUS, DENSITY, STIFFNESS = 1e-3, 2500, 1e4
MASS = 4 / 3 * np.pi * RADIUS**3 * DENSITY
BALL = dict(radius=RADIUS, density=DENSITY, stiffness=STIFFNESS)


def same(a, b):
    return a.keys() == b.keys() and all(np.array_equal(a[k], b[k], equal_nan=a[k].dtype.kind == "f") for k in a)


def test_a_damped_spring():
    """Restitution, contact time and peak of the damped oscillator, for a table of dashpots and masses. As in the tests of C++: the
    frequency of 200 steps a contact errs by (pi/200)^2/24, the dashpot in the steps at both ends by 2 (ln e / 200)^2."""
    restitution = np.array([0.2, 0.5, 0.9])[:, np.newaxis]
    radius = np.array([0.5e-3, 1e-3, 2e-3, 4e-3])
    m = 0.5 * MASS * (radius / RADIUS)**3
    rate = -np.log(restitution) / np.sqrt((np.pi**2 + np.log(restitution)**2) * m / STIFFNESS)
    found = pendular.collisions("LinearViscoelastic", radius=radius, normal_velocity=0.3, density=DENSITY, stiffness=STIFFNESS,
                                dissipation=2 * m * rate)
    assert all(values.shape == (3, 4) for values in found.values())
    time = np.sqrt((np.pi**2 + np.log(restitution)**2) * m / STIFFNESS)
    w = np.pi / time
    peak = 0.3 * np.sqrt(m / STIFFNESS) * np.exp(-rate / w * np.arctan2(w, rate))
    assert found["restitution"] == pytest.approx(restitution + 0 * radius, rel=6e-4)
    assert found["contact_time_s"] == pytest.approx(time, rel=3e-4)
    assert found["largest_overlap_m"] == pytest.approx(peak, rel=3e-4)
    assert found["energy_lost_J"] == pytest.approx(found["energy_before_J"] * (1 - found["restitution"]**2), rel=1e-12)
    assert found["parted"].all() and (found["end"] == "parted").all() and (found["steps"] > 200).all()


def test_hertz_without_dissipation():
    """The peak (15 m v^2 / (16 E* sqrt(R)))^(2/5) and 2.9432 of it over v, of spheres and at a wall; the last digits are those of 2.9432."""
    speed, modulus = np.array([0.01, 0.1, 1.0]), 5e6 / (2 * (1 - 0.25**2))
    for radius2, share in ((None, 0.5), (np.inf, 1.0)):
        found = pendular.collisions("HertzianViscoelastic", radius=RADIUS, radius2=radius2, normal_velocity=speed, density=DENSITY,
                                    young_modulus=5e6, poisson_ratio=0.25, restitution_coefficient=1)
        peak = (15 * share * MASS * speed**2 / (16 * modulus * np.sqrt(share * RADIUS)))**0.4
        assert found["largest_overlap_m"] == pytest.approx(peak, rel=1e-4)
        assert found["contact_time_s"] == pytest.approx(2.9432 * peak / speed, rel=1e-4)
        assert found["restitution"] == pytest.approx(1 + 0 * speed, abs=1e-4)


def test_broadcasting():
    """A field, a radius and a velocity against each other; each is the collision by itself, with the same bits."""
    arrays = dict(radius=np.array([[1e-3], [2e-3]]), restitution_coefficient=[0.5, 0.7, 0.9], tangential_velocity=0.1, spin1=[[[10]], [[-10]]])
    common = {**GLASS, "normal_velocity": np.float32(0.25)}
    found = pendular.collisions("HertzianViscoelasticMindlin", **{**common, **arrays})
    assert found["restitution"].shape == (2, 2, 3) and found["parted"].dtype == bool and found["steps"].dtype.kind == "i"
    every = np.broadcast_arrays(*arrays.values())
    for place in np.ndindex(2, 2, 3):
        one = pendular.collisions("HertzianViscoelasticMindlin",
                                  **{**common, **{name: values[place] for name, values in zip(arrays, every)}})
        assert one["restitution"].shape == () and same(one, {name: values[place] for name, values in found.items()})
    none = pendular.collisions("HertzianViscoelasticMindlin", radius=[], normal_velocity=0.1, **GLASS)
    assert all(values.shape == (0,) for values in none.values())


def test_the_other_body():
    """Grain 1 and grain 2 change roles; without radius2 both are equal. Velocities are relative, spins about one axis."""
    one = pendular.collisions("HertzianViscoelasticMindlin", radius=1e-3, radius2=2e-3, normal_velocity=0.2, spin1=20, **GLASS)
    other = pendular.collisions("HertzianViscoelasticMindlin", radius=2e-3, radius2=1e-3, normal_velocity=0.2, spin2=20, **GLASS)
    assert one["spin1_after_rad_per_s"] == pytest.approx(other["spin2_after_rad_per_s"], rel=1e-9)
    assert one["restitution"] == pytest.approx(other["restitution"], rel=1e-9)
    assert one["spin1_after_rad_per_s"] < 20 and one["spin2_after_rad_per_s"] < 0


def test_energies():
    """With the ledger, what the motion loses is found, mechanism by mechanism; the motion is the same."""
    given = dict(radius=1e-3, normal_velocity=0.3, tangential_velocity=[0.0, 0.2], liquid_bridge_volume=1e-12, contact_angle=0.2,
                 surface_tension=0.07, **GLASS)
    found = pendular.collisions("HertzianViscoelasticMindlinLiquidBridgeBagheri", energies=True, **given)
    lost = sum(values for name, values in found.items() if name.startswith("lost_") or name == "step_error_J")
    assert lost == pytest.approx(found["energy_lost_J"], rel=1e-9)
    assert (found["lost_in_broken_adhesion_J"] > 0).all() and (found["lost_in_sliding_J"][1] > found["lost_in_sliding_J"][0])
    plain = pendular.collisions("HertzianViscoelasticMindlinLiquidBridgeBagheri", **given)
    assert same(plain, {name: found[name] for name in plain}) and len(found) > len(plain)


def test_threads():
    given = dict(normal_velocity=np.linspace(0.01, 1, 60), tangential_velocity=0.1, radius=1e-3, **GLASS)
    one = pendular.collisions("HertzianViscoelasticMindlin", threads=1, **given)
    for threads in (2, 7, None):
        assert same(one, pendular.collisions("HertzianViscoelasticMindlin", threads=threads, **given))


# What is given besides or instead of the first values, and the sentence.
REFUSED = {
    "radius": (dict(radius=[1e-3, 2e-3, -1e-3]), r"Collision \[2\]: radius = -0\.001 m is out of range; .*"),
    "the first of several": (dict(normal_velocity=[[1, 2], [0, -1]]), r"Collision \[1, 0\]: normal_velocity = 0 m/s is out of range; .*"),
    "a field": (dict(restitution_coefficient=[0.5, 7]), r"Collision \[1\]: .*restitution.* 7.*"),
    "a single one": (dict(density=-1.0), "The collision: .*density.*"),
    "no field": (dict(densty=1.0), ".*densty.*density.*"),
    "one is missing": (dict(poisson_ratio=None), None),
    "shapes": (dict(radius=[1e-3, 1e-3], spin1=[1, 2, 3]),
               r"collisions\(\): these arrays cannot be broadcast against each other: radius \(2,\), spin1 \(3,\)\."),
    "text": (dict(radius="big"), r"collisions\(\): radius = 'big' must be numbers\."),
    "threads": (dict(threads=0), r"collisions\(\): threads = 0 must be a whole number from 1 to 4096, or None\."),
    "too many threads": (dict(threads=4097), r"collisions\(\): threads = 4097 must be a whole number from 1 to 4096, or None\."),
    "a number as text": (dict(radius="0.001"), r"collisions\(\): radius = '0\.001' must be numbers\."),
    "texts": (dict(spin1=["1", "2"]), r"collisions\(\): spin1 = \['1', '2'\] must be numbers\."),
    "a mask": (dict(radius=np.ma.masked_array([1e-3, 2e-3], [False, True])), r"collisions\(\): radius has masked values; .*\."),
    "misspelt": (dict(thread=3), r"collisions\(\) has no argument thread; did you mean threads\?"),
    "misspelt with a line": (dict(spin_1=3), r"collisions\(\) has no argument spin_1; did you mean spin1\?"),
    "a species by number": (dict(species=3), r"collisions\(\): species = 3 must be text\."),
    "energies by text": (dict(energies="yes"), r"collisions\(\): energies = 'yes' must be True or False\."),
    "no step": (dict(time_step=0.0), r"The collision: time_step = 0 s is out of range; .*\."),
    "a long step": (dict(time_step=[1e-7, 2e-3]), r"Collision \[1\]: time_step = 0\.002 s is out of range; .*\."),
    "not a step": (dict(time_step=np.nan), r"The collision: time_step is not set or not a number; .*\."),
    "no touch": (dict(normal_velocity=1e-6, tangential_velocity=[0.0, 100.0]), r"Collision \[1\]: the bodies pass each other .*\."),
    "too fast": (dict(normal_velocity=[0.1, 500.0]), r"Collision \[1\]: .*"),
    "steps": (dict(steps_in_contact=2), "The collision: steps_in_contact = 2 is out of range; .*"),
    "no species": (dict(species="Hertz"), ".*Hertz.*"),
}


@pytest.mark.parametrize("other, sentence", REFUSED.values(), ids=REFUSED.keys())
@pytest.mark.parametrize("threads", [1, 2])
def test_refusals(other, sentence, threads):
    given = {"species": "HertzianViscoelasticMindlin", "radius": 1e-3, "normal_velocity": 0.2, "threads": threads, **GLASS, **other}
    if sentence is None:
        del given["poisson_ratio"]
        sentence = "young_modulus and poisson_ratio are given together."
    with pytest.raises((pendular.InputError, pendular.RunError, TypeError)) as caught:
        pendular.collisions(**given)
    assert re.fullmatch(sentence, str(caught.value)), str(caught.value)
    assert str(caught.value).endswith((".", "?")) and "\n" not in str(caught.value)


def test_the_example(tmp_path, capsys):
    """Above the speeds at which the bridge holds the grains, the chart is the closed form. What the bridge adds to the overlap, and so to the
    dashpot's work, is left out there: by F(0) over the elastic force, 2 % at most at 0.5 m/s."""
    pytest.importorskip("matplotlib")
    sys.path.insert(0, str(EXAMPLES))
    from restitution import chart, closed_form, main

    speeds, volumes = np.geomspace(0.5, 2, 6), [0, 1e-11, 5e-11]
    found = chart(speeds, volumes)
    expected = np.array([closed_form(speeds, volume) for volume in volumes])
    assert found["restitution"][0] == pytest.approx(expected[0], rel=1e-3)
    assert found["restitution"] == pytest.approx(expected, rel=0.02)
    with pytest.raises(SystemExit):
        main(["--output", str(tmp_path / "nofolder")])
    assert "there is no folder" in capsys.readouterr().err
    main(["--output", str(tmp_path)])
    assert (tmp_path / "restitution.png").stat().st_size > 5000


def hash_of(count):
    scene = tower(count=count, quiet=True)
    scene.run(steps=200)
    return scene.position.tobytes(), threading.get_ident()


def test_run_many():
    """In order, several at the same time, with the bits that they have one after the other."""
    counts = [2, 5, 3, 4] * 3
    found = pendular.run_many(hash_of, counts, threads=3)
    assert [bits for bits, _ in found] == [hash_of(count)[0] for count in counts]
    assert pendular.run_many(hash_of, []) == [] and len(pendular.run_many(hash_of, range(1, 3), threads=1)) == 2


def test_run_many_of_scenes():
    scenes = [tower(count=k, quiet=True) for k in (1, 2, 3)]
    assert pendular.run_many(lambda scene: scene.run(steps=100), scenes) == scenes
    assert [scene.steps for scene in scenes] == [100] * 3


def test_run_many_raises_what_fails():
    begun = []

    def work(number):
        begun.append(number)
        if number == 2:
            raise pendular.InputError("Two is refused.")
        return number

    with pytest.raises(pendular.InputError, match="Two is refused") as caught:
        pendular.run_many(work, range(1000), threads=1)
    if sys.version_info >= (3, 11):
        assert caught.value.__notes__ == ["run_many(): this is of cases[2]."]
    assert begun == [0, 1, 2]
    with pytest.raises(pendular.InputError, match=r"run_many\(\): threads = 1\.5"):
        pendular.run_many(work, [1], threads=1.5)
    with pytest.raises(pendular.InputError, match=r"run_many\(\): cases = 5 must be a list or another iterable\.$"):
        pendular.run_many(work, 5)
    with pytest.raises(pendular.InputError, match=r"run_many\(\): work = 5 must be a function of a case\.$"):
        pendular.run_many(5, [1])


LONG = """
import numpy, pendular, conftest, sys
print("begun", flush=True)
try:
    if sys.argv[1] == "collisions":
        pendular.collisions("HertzianViscoelasticMindlin", radius=1e-3, normal_velocity=numpy.full(200000, 0.1), **conftest.GLASS)
    elif sys.argv[1] == "long collisions":  # the second one on a thread of its own
        pendular.collisions("HertzianViscoelasticMindlin", radius=1e-3, normal_velocity=numpy.full(64, 0.1), steps_in_contact=1e6,
                            threads=2, **conftest.GLASS)
    elif sys.argv[1] == "several runs":
        def work(scene):
            for _ in range(10000):
                try:
                    scene.run(10.0)
                except pendular.RunStopped:
                    pass
                if stopped_twice(scene):
                    raise RuntimeError("It was stopped again.")
        stops = {}
        def stopped_twice(scene):
            stops[id(scene)] = stops.get(id(scene), 0) + 1
            return stops[id(scene)] > 1
        pendular.run_many(work, [conftest.tower(quiet=True) for _ in range(2)], threads=2)
    else:
        pendular.run_many(lambda scene: scene.run(1e6), [conftest.tower(quiet=True) for _ in range(3)])
except KeyboardInterrupt:
    print("interrupted")
"""


@pytest.mark.parametrize("what", ["collisions", "long collisions", "scenes", "several runs"])
def test_ctrl_c(what):
    """It ends the call within a collision, or after a step."""
    with subprocess.Popen([sys.executable, "-c", LONG, what], stdout=subprocess.PIPE, text=True,
                          cwd=Path(__file__).parent) as running:
        assert running.stdout.readline() == "begun\n"
        with pytest.raises(subprocess.TimeoutExpired):
            running.wait(0.3)
        running.send_signal(signal.SIGINT)
        assert running.communicate(timeout=60)[0] == "interrupted\n"
