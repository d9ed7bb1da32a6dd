"""All functions and attributes of the module, with arguments that they could be given: before the first step, in a function
that the scene calls, after the run, and of objects that were never made. Each returns, or raises one sentence."""
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pendular

PROGRAM = Path(__file__).with_name("every_call.py")
SENTENCE = re.compile(r"(InputError|RunError|RunStopped|TypeError|BufferError): [^\n]{10,}\.")


def outcomes(moment):
    """What comes of each call: {(number, name): [outcome, ...]}; a call that ends the program has 'died'."""
    found, first = {}, 0
    while True:
        done = subprocess.run([sys.executable, str(PROGRAM), moment, str(first)], capture_output=True, text=True, timeout=600)
        call = None
        for line in done.stdout.splitlines():
            if line == "end":
                assert done.returncode == 0, done.stderr
                return found
            if line.startswith("\t"):
                found[call].append(line[1:])
            else:
                number, _, name = line.partition(" ")
                assert number.isdigit(), f"{call} has made two lines: {line}"
                call = (int(number), name)
                found[call] = []
        assert call and done.returncode < 0, f"{call}: {done.stderr}"
        found[call].append(f"died of signal {-done.returncode}")
        first = call[0] + 1


# What is to return at least: arguments that no function takes would show nothing.
@pytest.mark.parametrize("moment, returned", [("before", 1200), ("motion", 400), ("hook", 1000), ("after", 1000)])
def test_every_call_answers_or_raises_a_sentence(moment, returned):
    found = outcomes(moment)
    wrong = {name: came for (_, name), all_of_it in found.items() for came in all_of_it
             if came != "returns" and not SENTENCE.fullmatch(came.removeprefix("run: "))}
    assert not wrong
    assert sum("returns" in all_of_it for all_of_it in found.values()) > returned


@pytest.mark.parametrize("moment", ["unmade self", "unmade arguments"])
def test_objects_that_were_never_made(moment):
    """By __new__() without __init__(): there is nothing of C++ in them."""
    found = outcomes(moment)
    wrong = {name: came for (_, name), all_of_it in found.items() for came in all_of_it
             if came != "returns" and not SENTENCE.fullmatch(came)}
    assert not wrong
    refused = [name for (_, name), all_of_it in found.items() if any("was made by __new__() alone" in came for came in all_of_it)]
    assert len(refused) > (1500 if moment == "unmade self" else 50)


def test_attributes_of_another_class():
    kernel = pendular._kernel
    classes = [what for what in vars(kernel).values() if isinstance(what, type) and not issubclass(what, Exception)]
    assert len(classes) > 7
    for of in classes:
        unmade = of.__new__(of)
        for name, member in [(n, m) for n, m in vars(of).items() if isinstance(m, property)]:
            for other in [unmade, None, 5, *(one.__new__(one) for one in classes if one is not of)]:
                with pytest.raises(TypeError) as caught:
                    member.fget(other)
                assert "\n" not in str(caught.value) and str(caught.value).endswith("."), f"{of.__name__}.{name}: {caught.value}"


def test_fields_before_the_run_say_what_to_call():
    scene = pendular.Scene()
    sand = scene.add_species("LinearViscoelastic", density=2500, stiffness=300)
    scene.add_grains(sand, [[0, 0, 0], [0, 0, 1.99e-3]], 1e-3)
    scene.set_periodic("x", -2e-3, 2e-3)
    scene.time_step = 1e-6
    grid = ("Z", (-2e-3, -2e-3, -2e-3), (2e-3, 2e-3, 4e-3), 5e-4, 1e-3)
    with pytest.raises(pendular.InputError, match=r"needs a scene that has begun; call initialise\(\) before it"):
        scene.fields(*grid)
    before = scene.fields(*grid, contacts=False)
    scene.initialise()
    after = scene.fields(*grid)
    assert (before["density_kg_per_m3"] == after["density_kg_per_m3"]).all()
    assert after["contact_stress_Pa"].any()


def test_heat_of_contacts_without_a_ledger():
    scene = pendular.Scene()
    sand = scene.add_species("LinearViscoelastic", density=2500, stiffness=300)
    scene.add_grains(sand, [[0, 0, 0]], 1e-3)
    scene.conduct_heat()
    scene.set_heat_material(sand, conductivity=1, heat_capacity=800)
    scene.time_step = 1e-6
    scene.run(steps=1)
    with pytest.raises(pendular.InputError, match=r"heat_by_contacts\(\) needs the energy ledger; call keep_energy_ledger\(\)"):
        scene.heat_by_contacts()
    scene.run(steps=1)


def test_a_value_of_several_lines_makes_one():
    scene = pendular.Scene()
    for axis in (np.arange(4).reshape(2, 2), "x\ny", pendular):
        with pytest.raises(pendular.InputError, match="An axis must be 'x', 'y' or 'z', or 0, 1 or 2; it is ") as caught:
            scene.set_periodic(axis, 0, 1)
        assert "\n" not in str(caught.value) and len(str(caught.value)) < 130
    with pytest.raises(pendular.InputError) as caught:
        scene.add_species("two\nlines")
    assert "\n" not in str(caught.value)


def test_numbers_for_which_there_is_no_memory():
    """In a process that may take 1 GB."""
    code = '''
import resource, pendular
scene = pendular.Scene()
sand = scene.add_species("LinearViscoelastic", density=2500, stiffness=300)
sizes, place = pendular.even_sizes(1e-3, 2e-3), pendular.box((0, 0, 0), (1, 1, 1))
resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
for call in (lambda: sizes.radii(2**31 - 1), lambda: sizes.random_radii(grains=2**31 - 1), lambda: sizes.radii(2**62),
             lambda: scene.insert(sand, sizes, place, number=2**31 - 1), lambda: scene.insert(sand, sizes, place, mass=1e12),
             lambda: scene.fields("XYZ", (0, 0, 0), (1, 1, 1), 1 / 512, 1e-2, contacts=False)):
    try:
        call()
    except Exception as error:
        print(f"{type(error).__name__}: {error}")
print(len(scene))
'''
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    said = done.stdout.splitlines()
    assert said[0] == "MemoryError: radii() has not enough memory for grains = 2147483647; ask for less."
    assert said[1] == "MemoryError: random_radii() has not enough memory for grains = 2147483647; ask for less."
    assert said[2] == ("InputError: SizeDistribution: number of grains = 4.611686018427388e+18 is out of range; it must be at least 0 "
                       "and at most 2147483647.")
    assert re.fullmatch(r"InputError: insert\(\): the grains would have a solid fraction of 1\.12\d* of the region; .*", said[3])
    assert re.fullmatch(r"InputError: insert\(\): .* solid fraction of .*", said[4])
    assert said[5].startswith("MemoryError: fields() has not enough memory for spacing = 0.00195")
    assert said[6] == "0"


# What takes long, and how to begin it.
LONG = {
    "sizes": "sizes.radii(20_000_000)",
    "loose": "scene.insert(sand, sizes, pendular.box((0, 0, 0), (3, 3, 3)), number=5_000_000)",
    "dense": "scene.insert(sand, sizes, pendular.box((0, 0, 0), (0.1, 0.1, 0.1)), solid_fraction=0.55)",
    "fields": "scene.fields('XYZ', (0, 0, 0), (0.1, 0.1, 0.1), 1e-3, 1e-2, contacts=False)",
    "fields along an axis": "[scene.fields('Z', (0, 0, 0), (0.1, 0.1, 0.1), 1e-6, 1e-2, contacts=False) for _ in range(1000)]",
}


@pytest.mark.parametrize("call", LONG.values(), ids=LONG.keys())
def test_ctrl_c(call):
    """It ends what takes long within a part of a second, of processor time: other programs may run. The scene stays as it was."""
    code = f'''
import numpy, os, signal, threading, time, pendular
scene = pendular.Scene(threads=2)
sand = scene.add_species("LinearViscoelastic", density=2500, stiffness=300)
k = numpy.arange(4000)
scene.add_grains(sand, 0.004 * numpy.stack([k % 16, k // 16 % 16, k // 256], 1), 1e-4, fixed=True)
sizes = pendular.even_sizes(1e-3, 2e-3)
def interrupt():
    time.sleep(0.4)
    interrupt.at = time.process_time()
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    {call}
    print("returned")
except KeyboardInterrupt:
    print(time.process_time() - interrupt.at, len(scene))
'''
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    took, grains = done.stdout.split()
    assert float(took) < 0.5 and int(grains) == 4000


class Interrupts:
    """Ctrl-C comes while numpy looks at it."""
    def __array__(self, *types, **options):
        raise KeyboardInterrupt


@pytest.mark.parametrize("call", [lambda scene, sand, it: setattr(scene, "gravity", it),
                                  lambda scene, sand, it: scene.add_grains(sand, it, 1e-4),
                                  lambda scene, sand, it: scene.add_grains(sand, [[0, 0, 0]], it),
                                  lambda scene, sand, it: scene.add_plane(sand, it, (0, 0, 0))])
def test_ctrl_c_while_an_argument_is_read(call):
    """It was lost, and the argument got the blame: "A vector must be three numbers; it is (0.1, 0.1, 0.1)"."""
    scene = pendular.Scene()
    sand = scene.add_species("LinearViscoelastic", density=2500, stiffness=300)
    with pytest.raises(KeyboardInterrupt):
        call(scene, sand, Interrupts())
