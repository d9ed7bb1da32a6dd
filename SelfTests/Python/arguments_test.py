"""Arguments of another name, number or type: one sentence, which names the argument, in the place of types of C++."""
import inspect
import re
import subprocess
import sys

import numpy as np
import pytest

import pendular
from conftest import tower
from pendular import _arguments

BOX = pendular.box((0, 0, 0), (1, 1, 1))
ONE = pendular.one_size(1e-3)
# What is done, and the sentence.
CALLS = {
    "another name": (lambda s: s.add_plane(s.glass, normal=(0, 0, 1), point=(0, 0, 0)),
                     r"add_plane\(\) has no argument normal; it has species, outward, point, forces\."),
    "nearly a name": (lambda s: pendular.Scene(thread=2), r"Scene\(\) has no argument thread; did you mean threads\? It has name, .*"),
    "one is missing": (lambda s: s.add_grains(s.glass, [[0, 0, 0]]), r"add_grains\(\) also needs radius; it has species, position, .*"),
    "two are missing": (lambda s: s.add_plane(s.glass), r"add_plane\(\) also needs outward and point; it has .*"),
    "too many": (lambda s: pendular.Scene("a", 2), r"Scene\(\) takes 1 without a name: name; 2 are given\. All: name, threads, .*"),
    "none are taken": (lambda s: s.finish(1), r"finish\(\) takes no arguments\."),
    "given twice": (lambda s: s.add_plane(s.glass, (0, 0, 1), (0, 0, 0), species=s.glass), r"add_plane\(\) is given species twice\."),
    "no whole number": (lambda s: s.insert(s.glass, ONE, BOX, number=5.0), r"insert\(\): number = 5\.0 must be a whole number, or None\."),
    "negative": (lambda s: s.insert(s.glass, ONE, BOX, number=-3), r"insert\(\): number = -3 must be a whole number, at least 0 and below 2\^31\."),
    "text for a number": (lambda s: s.add_cylinder(s.glass, (0, 0, 1), (0, 0, 0), "1"), r"add_cylinder\(\): radius = '1' must be a number\."),
    "text for True": (lambda s: s.add_plane(s.glass, (0, 0, 1), (0, 0, 0), forces="yes"), r"add_plane\(\): forces = 'yes' must be True or False\."),
    "text for a species": (lambda s: s.add_plane("glass", (0, 0, 1), (0, 0, 0)), r"add_plane\(\): species = 'glass' must be a Species\."),
    "a number for a function": (lambda s: s.every_steps(1, 5), r"every_steps\(\): function = 5 must be a function\."),
    "a number for a file": (lambda s: s.write_restart(5), r"write_restart\(\): file = 5 must be the name of a file\."),
    "a number for text": (lambda s: pendular.Scene(5), r"Scene\(\): name = 5 must be text\."),
    "no list": (lambda s: s.add_grains_of_file(s.glass, "a.txt"), r"add_grains_of_file\(\): species = <pendular\.Species .*\.\.\. must be a list of Species\."),
    "None for numbers": (lambda s: s.add_grains(s.glass, [[0, 0, 0]], None), r"add_grains\(\): radius = None must be numbers\."),
    "a long one": (lambda s: pendular.Scene(threads=np.zeros((9, 9))), r"Scene\(\): threads = array\(.{40,60}\.\.\. must be a whole number\."),
    "two numbers for a vector": (lambda s: s.add_plane(s.glass, (0, 0, 1), point=(0, 0)), r"add_plane\(\): point = \(0, 0\) must be three numbers\."),
    "a vector as an attribute": (lambda s: setattr(s, "gravity", -9.81), r"gravity = -9\.81 must be three numbers \(m/s\^2\)\."),
    "an attribute": (lambda s: setattr(s, "time_step", "1e-5"), r"time_step = '1e-5' must be a number \(s\)\."),
    "a whole attribute": (lambda s: setattr(s, "threads", 1.5), r"threads = 1\.5 must be a whole number\."),
    "a time to run to": (lambda s: s.run("1"), r"run\(\): until = '1' must be a number\."),
    "steps to run": (lambda s: s.run(steps=2.5), r"run\(\): steps = 2\.5 must be a whole number\."),
    "a function of the module": (lambda s: pendular.one_size("big"), r"one_size\(\): diameter = 'big' must be a number\."),
    "a method of another class": (lambda s: pendular.Scene.finish(5), "finish is of a Scene, and nothing else has it."),
    "in a function that is called": (lambda s: (s.every_steps(1, lambda t: pendular.one_size("big")), s.run(steps=1)),
                                     r"one_size\(\): diameter = 'big' must be a number\."),
}


@pytest.mark.parametrize("do, sentence", CALLS.values(), ids=CALLS.keys())
def test_sentence(do, sentence):
    with pytest.raises((TypeError, pendular.InputError)) as caught:
        do(tower())
    assert re.fullmatch(sentence, str(caught.value)), str(caught.value)


def functions():
    """All of the module: (name, function, whether it has a first argument self)."""
    kernel = pendular._kernel
    for name, value in vars(kernel).items():
        if inspect.isclass(value) and not issubclass(value, Exception):
            for key, member in vars(value).items():
                if type(member).__name__ == "instancemethod" and (key[0] != "_" or key == "__init__"):
                    yield f"{name}.{key}", member, value
        elif callable(value) and not inspect.isclass(value) and name[0] != "_":
            yield name, value, None


def test_no_function_lists_types_of_cpp():
    """None of the module: called with an argument of no name, with too many, and of a wrong self."""
    class Odd:
        pass

    said = 0
    for name, function, of in functions():
        for arguments, named in (((), {"no_such_name": 1}), (tuple(Odd() for _ in range(30)), {}), ((Odd(),), {})):
            try:
                function(*arguments, **named)
            except (TypeError, pendular.InputError) as error:
                assert "incompatible" not in str(error) and "_kernel" not in str(error) and "\n" not in str(error), f"{name}: {error}"
                said += 1
            except Exception as error:
                assert "\n" not in str(error), f"{name}: {error!r}"
    assert said > 400


def test_help_shows_the_signature_alone():
    assert pendular.Scene.add_plane.__doc__.splitlines()[0].startswith("add_plane(self: ")
    for name, function, _ in functions():
        assert "Overloaded" not in (function.__doc__ or ""), name


def test_errors_of_others_stay():
    """Those of functions that are called, also of the same type."""
    scene = tower()

    def wrong(s):
        raise TypeError("mine(): incompatible with all")

    scene.every_steps(1, wrong)
    with pytest.raises(TypeError, match="^mine"):
        scene.run(steps=1)


def test_sentences_are_about_errors_alone():
    """A call that fits enters nothing that makes sentences; Tools/Python/measure-overheads.py measures its time."""
    asked, entered = [], []

    def explain(said, name, *rest):
        asked.append(name)
        return _arguments.explain(said, name, *rest)

    def note(frame, event, argument):
        if event == "call" and frame.f_globals.get("__name__") in ("pendular._arguments", "pendular._signature"):
            entered.append(frame.f_code.co_name)

    scene = tower()
    pendular._kernel._set_explanation(explain)
    try:
        sys.setprofile(note)
        try:
            scene.add_plane(scene.glass, (0, 0, 1), point=(0, 0, 9))
            scene.time_step = 0.5 * scene.time_step
            place, time, sizes = scene.position, scene.time, pendular.one_size(1e-3)
        finally:
            sys.setprofile(None)
        assert not asked and not entered and len(place) == 4 and time == 0 and sizes.largest == 1e-3
        with pytest.raises(TypeError, match="add_plane"):
            scene.add_plane(scene.glass)
        assert asked == ["add_plane"]
    finally:
        pendular._kernel._set_explanation(_arguments.explain)


MATERIAL = dict(density=2500, stiffness=300)
UNCOMPILED = ("HertzianViscoelasticMindlinPartialSlip is a species of Pendular, but it is not compiled into this module; build the "
              "module with its name in -DPENDULAR_PYTHON_SPECIES, or load a library that has it by load_species() "
              "(see the page on Python).")
# What the kernel refuses, in words of Python.
SENTENCES = {
    "without the mass": (lambda s: s.add_species("LinearViscoelastic", density=2500, collision_time=1e-4, restitution_coefficient=0.5),
                         "LinearViscoelastic: collision_time, restitution_coefficient and mass are given together."),
    "without the stiffness": (lambda s: s.add_species("LinearViscoelastic", density=2500, restitution_coefficient=0.5, mass=1e-5),
                              "LinearViscoelastic: collision_time, restitution_coefficient and mass, or "
                              "stiffness, restitution_coefficient and mass are given together."),
    "a wall that was removed": (lambda s: (s.remove_wall(s.wall(0)), s.remove_wall(s.wall(0))), "Wall 0 was removed."),
    "a grain twice": (lambda s: s.join([1, 1]), "particle 1 is given twice for one rigid body."),
    "a step without grains": (lambda s: pendular.Scene().choose_time_step(), None),
    "a temperature without heat": (lambda s: s.temperature, "Grains have no temperature before conduct_heat()."),
    "no such species": (lambda s: s.add_species("x"), None),
    "a species that is not compiled in": (lambda s: s.add_species("HertzianViscoelasticMindlinPartialSlip"), UNCOMPILED),
    "its fields": (lambda s: pendular.fields("HertzianViscoelasticMindlinPartialSlip"), UNCOMPILED),
    "a pair with its laws": (lambda s: s.set_pair(s.glass, s.glass, type="HertzianViscoelasticMindlinPartialSlip"), UNCOMPILED),
    "superquadrics that are not compiled in": (
        lambda s: pendular.Scene(superquadrics="HertzianViscoelasticMindlinIncremental"),
        "HertzianViscoelasticMindlinIncremental is a species of Pendular, but superquadrics of it are not compiled into this module; "
        'build the module with -DPENDULAR_PYTHON_SHAPED_SPECIES="{};HertzianViscoelasticMindlinIncremental" '
        "(see the page on Python).".format(";".join(name.removesuffix("Species") for name in pendular.shaped_species()))),
    "a field to read": (lambda s: s.glass.get("young_modulus"), "young_modulus can be set and not read, as fields are computed from it; "
                        "fields() has them."),
    "force that is not kept": (lambda s: s.wall(0).force, "A wall's force needs the forces on it, which are not summed unless keep_forces() of "
                               "the wall or keep_wall_forces() is called before the step."),
    "discs that leave the plane": (lambda s: (s.set_grains_are_discs(), s.run(steps=1)), None),
    "no solid": (lambda s: s.add_solid(s.glass, [[0, 0, 1]], [[0, 0, 50]], centre=(0, 0, 0), radius=1), None),
    "a step for an error in a run": (lambda s: (s.run(steps=1), s.set_step_for(0.01)),
                                     "Simulation: the time step for an error can only be set before the run starts."),
    "a step for collisions and for a figure": (
        lambda s: s.set_step_for(0.02, speed=1, figure="friction"),
        "set_step_for(): speed = 1 m/s does not go with figure = \"friction\"; give one of them."),
    "a row of grains": (lambda s: s.add_grains(s.glass, [[0, 0, 9], [0, float("nan"), 8]], 1e-3), None),
    "no name of a library": (lambda s: pendular.load_species(""), "load_species() needs the name of a file; it is ''."),
    "two materials without a pair": (lambda s: (s.add_grains(s.add_species("LinearViscoelastic", **MATERIAL), [[0, 0, 9]], 1e-3),
                                                s.run(steps=1)), None),
    "a folder for a table": (lambda s: pendular.table("."), "There is no file .."),
}
WORDS = {"a step without grains": "choose_time_step() finds no contact", "no such species": 'no species "x"',
         "discs that leave the plane": "set_grains_are_discs()", "no solid": "add_solid(): ", "a row of grains": "add_grains(), row 1: ",
         "two materials without a pair": "set_pair(a, b, type=NAME)"}


@pytest.mark.parametrize("name", SENTENCES)
def test_words_of_python(name):
    do, sentence = SENTENCES[name]
    with pytest.raises(pendular.InputError) as caught:
        do(tower())
    said = str(caught.value)
    assert said == sentence if sentence else WORDS[name] in said, said
    assert not re.search(r"\wSpecies\b|::|<Type>|Handler|\b[a-z]+[A-Z]\w*\(\)", said), said


def test_a_stopped_run_says_by_what():
    scene = tower()
    scene.stop()
    with pytest.raises(pendular.RunStopped, match=r"^stop\(\) has stopped the run"):
        scene.run(steps=1)


def test_fields_are_what_a_species_takes():
    """Each name once; with values for all of some law's setters they are accepted."""
    for kind in ("LinearViscoelastic", "HertzianViscoelasticMindlin"):
        names = [row[1] for row in pendular.fields(kind)]
        assert len(names) == len(set(names)) and "density" in names and "restitution_coefficient" in names and "restitution" not in names
    assert {"young_modulus", "poisson_ratio"} <= set(names) and "elastic_modulus" not in names
    for modulus in ("young_modulus", "elastic_modulus"):
        scene = pendular.Scene()
        glass = scene.add_species(kind, density=2500, poisson_ratio=0.25, restitution_coefficient=0.5, **{modulus: 5e6})
        assert glass.get("effective_elastic_modulus") == pytest.approx(5e6 / (2 * (1 - 0.25**2)), rel=1e-14)
        assert glass.get("effective_shear_modulus") == pytest.approx(5e6 / (4 * (1 + 0.25) * (2 - 0.25)), rel=1e-14)


def test_tables_that_are_none():
    for content in (b"", b"\xff\xfe\x00\x89HDF"):
        with open("none.csv", "wb") as file:
            file.write(content)
        with pytest.raises(pendular.InputError, match="none.csv is no table"):
            pendular.table("none.csv")


def test_the_hdf5_library_prints_nothing(tmp_path):
    """A restart file without what is asked of it, in a program that has not silenced the library."""
    code = ("import pendular\nscene = pendular.Scene()\n"
            "g = scene.add_species('LinearViscoelastic', density=2500, stiffness=300, dissipation=1e-3)\n"
            "scene.add_grains(g, [[0, 0, 0]], 1e-3)\nscene.time_step = 1e-6\n"
            "{}\nscene.run(steps=1)\nscene.write_restart('state.h5')\n")
    first, more = code.format(""), code.format("scene.remembered['mine'] = 1.0\nscene.restart_from('state.h5')")
    done = [subprocess.run([sys.executable, "-c", program], capture_output=True, text=True) for program in (first, more)]
    assert done[0].returncode == 0 and not done[0].stderr, done[0].stderr
    assert done[1].returncode == 1 and "InputError" in done[1].stderr and "mine" in done[1].stderr and "HDF5" not in done[1].stderr
