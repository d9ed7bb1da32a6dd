"""The examples run, and give what they say. Those that take longer are in long_examples_test.py."""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "Tools/Python/Examples"
sys.path.insert(0, str(EXAMPLES))


def run(name, *options):
    done = subprocess.run([sys.executable, EXAMPLES / name, *options], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_collision():
    """Apart, the force is that of the bridge, which pulls and gets weaker; the grains are slower after it."""
    pytest.importorskip("matplotlib")
    from collision import collide

    time, gap, force, speed = collide()
    apart = gap > 0
    after = time > time[np.argmax(force)]
    bridged = apart & after & (force != 0)
    assert (force[bridged] < 0).all() and (np.diff(np.abs(force[bridged])) < 0).all()
    assert (force[apart & ~after] == 0).all()  # a bridge forms when they touch
    assert 0 < speed[-1] < 0.7 * 0.5  # what the dashpot leaves, less the work of the bridge


def test_restart(tmp_path):
    words = run("restart.py", "--output", tmp_path).splitlines()[0].split()
    assert words[1] == words[3]


def test_study(tmp_path):
    pandas = pytest.importorskip("pandas")
    from study import heap

    run("study.py", "--output", tmp_path, "--only", "0", "--processes", "1")
    row = pandas.read_csv(tmp_path / "study-0.csv").iloc[0]
    assert row["hash"] == heap(0.0)["hash"]  # another process, the same bits


def test_job_of_an_array(tmp_path, monkeypatch):
    """As Slurm runs it, with this interpreter: a job for each value, the last one among them."""
    pandas = pytest.importorskip("pandas")
    from study import FRICTIONS

    for file in ("study.py", "study.slurm"):
        shutil.copy(EXAMPLES / file, tmp_path)
    (tmp_path / "python3").symlink_to(sys.executable)
    last = len(FRICTIONS) - 1
    assert f"#SBATCH --array=0-{last}\n" in (EXAMPLES / "study.slurm").read_text()
    subprocess.run(["bash", "study.slurm"], cwd=tmp_path, check=True, timeout=600,
                   env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "SLURM_ARRAY_TASK_ID": str(last)})
    assert pandas.read_csv(tmp_path / f"study-{last}.csv")["friction"].tolist() == FRICTIONS[-1:]


def test_plate_bends_as_under_its_load():
    """At rest the finite elements have the deflection of the load that the grains make; and about that of an even one."""
    pytest.importorskip("matplotlib")
    from plate import ELEMENTS, LENGTH, Plate, couple, make_scene

    scene, strips = make_scene()
    plate, loads = Plate(), []
    couple(scene, strips, plate)
    scene.every_steps(200, lambda s: loads.append(plate.load) if s.time > 0.15 else None)
    scene.run(0.2)
    load = np.mean(loads, 0)
    assert load[::2].sum() == pytest.approx(-9.81 * scene.total_mass, rel=0.02)
    deflection = plate.w[::2]
    assert deflection == pytest.approx(plate.at_rest(load), abs=0.01 * np.abs(deflection).max())
    even = 9.81 * scene.total_mass * LENGTH**3 / (384 * plate.bending)
    assert -deflection[ELEMENTS // 2] == pytest.approx(even, rel=0.08)
