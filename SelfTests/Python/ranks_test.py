"""Scripts that mpirun has started on several processes have the bits, and print the lines, of one."""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import pendular

MODULE = Path(os.environ.get("PENDULAR_MPI_MODULE") or Path(pendular.__file__).parents[2] / "PendularMpi.so")
pytestmark = pytest.mark.skipif(not (MODULE.exists() and shutil.which("mpirun")), reason="there is no MPI")

SET_UP = """
import sys
import numpy as np
import pendular
scene = pendular.Scene("run")
glass = scene.add_species("HertzianViscoelasticMindlin", density=2500, young_modulus=5e6, poisson_ratio=0.25,
                          restitution_coefficient=0.5, sliding_friction_coefficient=0.4)
scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
k = np.arange(400)
scene.add_grains(glass, 1.999e-3 * (np.stack([k % 10, k // 10 % 5, k // 50], 1) + 0.5), 1e-3,
                 velocity=np.random.default_rng(1).uniform(-0.05, 0.05, (400, 3)))
scene.gravity = (0, 0, -9.81)
scene.choose_time_step()
"""
RUN = SET_UP + """
heights = []
def look(s):
    heights.append(s.position[:, 2].mean())
    if s.steps == 20:
        s.remove_grains(s.identity[:10])
        s.set_velocity((0, 0, 0.1), identities=s.identity[:5])
scene.every_steps(10, look)
scene.every_time(1e-4, lambda s: heights.append(s.kinetic_energy))
scene.write_energy(2e-4)
scene.run(steps=35)
contacts = scene.contacts()
scene.run(steps=5)
scene.finish()
print(scene.hash(), len(scene), len(contacts["wall"]), repr(contacts["force_N"].sum()), [repr(h) for h in heights])
"""


def start(script, processes):
    Path("script.py").write_text(script)
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "PENDULAR_MPI_MODULE": str(MODULE)}
    several = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(processes)] if processes > 1 else []
    return subprocess.run([*several, sys.executable, "script.py"], capture_output=True, text=True, env=environment, timeout=300)


def test_same_bits_on_several_processes():
    """With functions that look and change, and a file."""
    alone = start(RUN, 1)
    assert alone.returncode == 0, alone.stderr
    energy = Path("run-energy.csv").read_bytes()
    together = start(RUN, 2)
    assert together.returncode == 0, together.stderr
    assert together.stdout == alone.stdout and len(alone.stdout) > 100
    assert Path("run-energy.csv").read_bytes() == energy


@pytest.mark.parametrize("mistake", [
    "scene.every_steps(5, lambda s: 1 / (pendular.rank() - 1))\nscene.run(steps=20)",
    "scene.run(steps=5)\nif pendular.rank() == 1: 1 / 0\nscene.run(steps=20)",
    "scene.set_velocity((0, 0, -1e6), identities=[0])\nscene.run(steps=20)"], ids=["in a function", "between parts", "in a step"])
def test_a_process_that_fails_ends_all(mistake):
    done = start(SET_UP + mistake + "\nprint('end')", 2)
    assert done.returncode != 0 and "end" not in done.stdout
    assert "ZeroDivisionError" in done.stderr or "moves" in done.stderr


def test_a_part_of_python_is_refused():
    part = "class Part:\n    name = 'part'\n    def prepare(self, scene, length): pass\n"
    done = start(SET_UP + part + "scene.add_part(Part())\nscene.run(steps=3)", 2)
    assert done.returncode != 0 and "part" in done.stderr and "rank" in done.stderr


def test_numbers_of_processes():
    assert start("import pendular\nprint(pendular.rank(), pendular.rank_count())", 1).stdout == "0 1\n"
    done = start(SET_UP + "print(pendular.rank_count())\nimport os\n"
                 "open(f'rank-{pendular.rank()}', 'w')\nscene.run(steps=1)", 2)
    assert done.stdout == "2\n" and Path("rank-0").exists() and Path("rank-1").exists(), done.stderr


def test_a_part_of_the_grains_is_not_taken_for_all():
    """A function that the kernel calls in the middle of a step finds the grains of its process only."""
    done = start(SET_UP + """
lid = scene.add_plane(glass, (0, 0, 1), (0, 0, 0.1))
lid.set_motion(lambda time: (0, 0, 0.1 - scene.position[:, 2].max() * time))
scene.run(steps=30)
print("went on")
""", 2)
    assert done.returncode != 0 and "went on" not in done.stdout
    assert "each process of a scene on several (mpirun) has its own ones only" in done.stderr, done.stderr


def test_grains_that_stay_on_their_ranks():
    """Frames in parts have all of them, and so has the hash of all."""
    done = start(SET_UP + """
scene.write_paraview(1e-4, parts=True)
scene.leave_grains_on_ranks()
scene.run(steps=30)
own = len(scene.position)
try:
    scene.hash()
    print("a part of the grains looks like all of them")
except pendular.InputError:
    pass
scene.finish()
print(own, len(scene))
""", 2)
    assert done.returncode == 0, done.stderr
    own, of_all = done.stdout.split()
    assert 0 < int(own) < 400 and int(of_all) == 400
    pieces = sorted(Path().glob("run-particles-*-rank*.vtp"))
    assert pieces and len(pieces) == 2 * len(list(Path().glob("run-particles-*.pvtp")))
