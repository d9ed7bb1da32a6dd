"""What must not be done at a moment, in a thread or with parts of another scene is refused, and does no harm."""
import gc
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import pendular
from conftest import glass_in, tower

BOX = pendular.box((0, 0, 0.05), (0.02, 0.02, 0.07))
EVEN = pendular.even_sizes(1e-3, 2e-3)


def bed(count=20000):
    """Grains that touch, as many as take a while to look at."""
    scene = pendular.Scene()
    glass = glass_in(scene)
    k = np.arange(count)
    scene.add_grains(glass, 1.99e-3 * np.stack([k % 30, k // 30 % 30, k // 900], 1), 1e-3)
    scene.choose_time_step()
    scene.initialise()
    scene.glass = glass
    return scene


@pytest.mark.parametrize("work", [
    lambda s: s.insert(s.glass, pendular.one_size(2e-3), pendular.box((0, 0, 1), (0.08, 0.08, 1.08)), solid_fraction=0.5),
    lambda s: [s.contacts() for _ in range(50)], lambda s: [s.grains() for _ in range(200)],
    lambda s: [s.fields("XYZ", (0, 0, 0), (0.06, 0.06, 0.05), 4e-3, 4e-3) for _ in range(5)],
    lambda s: s.run(steps=100)], ids=["insert", "contacts", "grains", "fields", "run"])
def test_a_scene_at_work_is_refused_to_other_threads(work):
    """Each call is refused, or comes before or after the work; the grains are those of the work alone."""
    scene, refused = bed(), []
    done = threading.Event()

    def disturb():
        while not done.is_set():
            try:
                scene.position
                scene.set_velocity((0, 0, 0), identities=[0])
            except pendular.RunError as error:
                refused.append(str(error))
            time.sleep(1e-4)

    other = threading.Thread(target=disturb)
    other.start()
    try:
        work(scene)
    finally:
        done.set()
        other.join()
    assert refused and "Another thread is at work" in refused[0]
    scene.velocity  # and now it is free


def test_a_run_in_a_function_leaves_the_run_as_it_was():
    """It is refused; the run goes on, calls its functions, tells its progress, and is still refused to other threads."""
    scene, plain, seen, told = tower(), tower(), [], []

    def nested(s):
        for do in (lambda: s.run(1), lambda: s.run(steps=1), s.initialise, s.finish):
            with pytest.raises(pendular.InputError, match="hook"):
                do()
        other = threading.Thread(target=lambda: seen.append(refusal(s)))
        other.start()
        other.join()

    scene.every_steps(50, nested)
    scene.run(0.01, progress=told.append)
    plain.run(0.01)
    assert scene.hash() == plain.hash() and scene.time == plain.time
    assert len(seen) == scene.steps // 50 and all("Another thread" in s for s in seen)
    assert told[-1] == scene.time


def refusal(scene):
    try:
        return str(scene.position)
    except pendular.RunError as error:
        return str(error)


def test_two_threads_run_one_scene():
    scene, errors = tower(), []

    def run():
        try:
            scene.run(0.05)
        except (pendular.RunError, pendular.InputError) as error:
            errors.append(str(error))

    threads = [threading.Thread(target=run) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    plain = tower()
    plain.run(0.05)
    assert scene.hash() == plain.hash() and len(errors) <= 1


CHANGES = {
    "add": lambda s: s.add_grains(s.glass, [[1, 1, 1]], 1e-3),
    "remove": lambda s: s.remove_grains([0]),
    "velocity": lambda s: s.set_velocity((0, 0, 1)),
    "spin": lambda s: setattr(s, "spin", (0, 0, 1)),
    "species": lambda s: s.glass.set(density=1),
    "wall": lambda s: s.wall(0).set_velocity((0, 0, 1)),
    "removed wall": lambda s: s.remove_wall(s.wall(0)),
    "view": lambda s: s.view("position"),
    "run": lambda s: s.run(steps=1),
    "restart": lambda s: s.write_restart("a.h5"),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES.keys())
def test_functions_that_are_asked_in_a_step_only_look(change):
    """The motion of a wall, and what an outlet takes."""
    def moved(s):
        def motion(now):
            s.position
            if now > 0:
                change(s)
            return 0, 0, 0
        s.wall(0).set_motion(motion)

    def outlet(s):
        s.add_outlet(normal=(0, 0, -1), point=(0, 0, 3e-3), condition=lambda identity: change(s) is None or bool(s.position[0, 2]))

    for ask in (moved, outlet):
        scene = tower()
        with pytest.raises((pendular.InputError, pendular.RunError), match="may read its scene, but not change it"):
            ask(scene)
            scene.run(0.01)
        assert len(scene) == 4


def test_what_a_function_that_is_asked_raises_reaches_the_caller():
    scene = tower()

    def motion(now):
        if now > 1e-3:
            raise KeyError("mine")
        return 0, 0, 0

    scene.wall(0).set_motion(motion)
    with pytest.raises(KeyError, match="mine") as caught:
        scene.run(0.01)
    assert any(entry.name == "motion" for entry in caught.traceback)


def test_progress_must_not_keep_a_view():
    scene, kept = tower(), []
    with pytest.raises(BufferError, match="kept"):
        scene.run(1e3, progress=lambda now: kept.append(scene.view("position")))


def test_at_end():
    scene, calls = tower(), []
    scene.at_end(lambda s: calls.append(s.steps))
    scene.run(steps=3)
    assert calls == []
    scene.finish()
    assert calls == [3]
    scene = tower()
    scene.at_end(lambda s: calls.append("end"))
    scene.every_steps(2, lambda s: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        scene.run(steps=3)
    assert calls[1:] == ["end"]
    scene = tower()
    scene.at_end(lambda s: 1 / 0)
    scene.run(steps=1)
    with pytest.raises(ZeroDivisionError):
        scene.finish()


def other_scene():
    scene = tower()
    return scene, scene.between_walls((0, 0, 0), (0.01, 0.01, 0.01))


OF_OTHERS = {
    "region": lambda s: s.insert(s.glass, EVEN, other_scene()[1], number=1),
    "region of an inlet": lambda s: s.add_inlet(s.glass, EVEN, other_scene()[1], number_flow=1),
    "region of an outlet": lambda s: s.add_outlet(region=other_scene()[1]),
    "species of a pair": lambda s: s.set_pair(s.glass, tower().glass),
    "species of a wall": lambda s: s.add_plane(tower().glass, (0, 0, 1), (0, 0, 1)),
    "other species of a wall": lambda s: s.wall(0).set_species(tower().glass),
    "species that come": lambda s: s.insert(tower().glass, EVEN, BOX, number=1),
    "wall to remove": lambda s: s.remove_wall(tower().wall(0)),
    "wall to follow": lambda s: s.add_inlet(s.glass, EVEN, BOX, number_flow=1, follows_wall=tower().wall(0)),
    "species that are warm": lambda s: (s.conduct_heat(),
                                        s.set_heat_material(tower().glass, conductivity=1, heat_capacity=1)),
    "wall that is warm": lambda s: (s.conduct_heat(), s.hold_temperature(tower().wall(0), 300)),
}


@pytest.mark.parametrize("do", OF_OTHERS.values(), ids=OF_OTHERS.keys())
def test_parts_of_other_scenes(do):
    with pytest.raises(pendular.InputError, match="another scene") as caught:
        do(tower())
    assert str(caught.value).endswith(".")


def test_a_region_outlives_its_scene():
    """It keeps its scene, whose walls it looks at."""
    scene, region = other_scene()
    del scene
    gc.collect()
    assert region.contains((0.005, 0.005, 0.005)) and not region.contains((0.005, 0.005, -0.005))


def test_the_interpreter_ends_while_a_scene_runs():
    """A thread that nobody waits for: the program ends at once and in order."""
    code = ("import threading, time, pendular\nscene = pendular.Scene()\n"
            "g = scene.add_species('LinearViscoelastic', density=2500, stiffness=300, dissipation=1e-3)\n"
            "scene.add_grains(g, [[0, 0, 0]], 1e-3)\nscene.time_step = 1e-5\n"
            "scene.every_steps(3, lambda s: s.time)\n"
            "threading.Thread(target=lambda: scene.run(1e9), daemon=True).start()\ntime.sleep(0.2)\nprint('end')\n")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stdout == "end\n", done.stderr
