"""The run: parts, functions that are called, Ctrl-C, threads, restarts."""
import gc
import os
import signal
import subprocess
import sys
import threading
import time
import traceback
import weakref

import numpy as np
import pytest

import pendular
from conftest import tower


def test_parts_have_the_bits_of_one_run():
    whole, parts = tower(), tower()
    whole.run(0.02)
    for k in range(1, 8):
        parts.run(min(0.003 * k, 0.02))
        parts.position  # what looks at the grains changes nothing
    assert whole.hash() == parts.hash() and whole.time == parts.time


def test_steps_are_counted():
    scene = tower()
    scene.run(steps=7).run(steps=0)
    assert scene.steps == 7
    assert scene.time == pytest.approx(7 * scene.time_step, rel=1e-14)


def test_functions_are_called_when_they_are_due():
    scene, steps, times = tower(), [], []
    scene.every_steps(3, lambda s: steps.append(s.steps))
    scene.every_time(1e-3, lambda s: times.append(s.time))
    scene.run(5.4e-3)
    assert steps == list(range(3, scene.steps + 1, 3))
    assert len(times) == 5
    assert np.abs(np.array(times) - 1e-3 * np.arange(1, 6)).max() <= 0.5 * scene.time_step * (1 + 1e-9)


def test_functions_get_the_scene_and_change_nothing():
    scene, plain = tower(), tower()
    scene.every_steps(1, lambda s: s is scene or pytest.fail("another scene"))
    scene.run(0.01)
    plain.run(0.01)
    assert scene.hash() == plain.hash()


def test_what_a_function_sets_holds():
    scene = tower()
    scene.every_steps(10, lambda s: setattr(s, "velocity", (0, 0, 0)))
    scene.run(steps=10)
    assert not scene.velocity.any()


def test_a_function_that_returns_false_pauses():
    scene = tower()
    scene.every_steps(5, lambda s: s.steps < 10)
    scene.run(1)
    assert scene.steps == 10 and not scene.has_ended
    scene.clear_calls()
    scene.run(steps=3)
    assert scene.steps == 13


def test_an_exception_ends_the_run_and_comes_with_its_traceback():
    scene = tower("run")
    scene.write_energy(1e-3)

    def mistake(s):
        raise KeyError("mine")

    scene.every_steps(7, mistake)
    with pytest.raises(KeyError, match="mine") as caught:
        scene.run(1)
    assert any(frame.name == "mistake" for frame in traceback.extract_tb(caught.value.__traceback__))
    assert scene.steps == 7 and scene.has_ended
    assert len(pendular.table("run-energy.csv")) >= 1  # the outputs are complete
    with pytest.raises(pendular.InputError, match="has stopped .a function that the scene calls raised KeyError"):
        scene.run(2)


def test_errors_of_the_kernel_keep_their_class():
    with pytest.raises(ValueError, match="density"):
        pendular.Scene().add_species("LinearViscoelastic", density=-1)
    scene = tower()
    scene.every_steps(1, lambda s: s.set_velocity((0, 0, -1e6), identities=[3]))
    with pytest.raises(RuntimeError, match="moves|moved") as caught:
        scene.run(0.01)
    assert isinstance(caught.value, pendular.RunError)


def interrupt_after(seconds):
    def send():
        time.sleep(seconds)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=send, daemon=True).start()


def test_control_c_between_steps():
    """A run that would take years ends; the scene goes on. Tools/Python/measure-overheads.py measures how soon."""
    scene = tower("run")
    scene.keep_restart_file()
    interrupt_after(0.2)
    with pytest.raises(KeyboardInterrupt):
        scene.run(1e6)
    stopped, bits = scene.time, scene.hash()
    other = tower("other")
    other.restart_from("run-restart.h5")
    other.initialise()
    assert other.time == stopped and other.hash() == bits
    other.run(steps=10)
    scene.run(steps=10)
    assert scene.hash() == other.hash()


def test_control_c_in_a_function():
    scene, steps = tower(), []

    def wait(s):
        steps.append(s.steps)
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(1)

    scene.every_steps(4, wait)
    with pytest.raises(KeyboardInterrupt):
        scene.run(1)
    assert steps == [4] and scene.steps == 4
    scene.clear_calls()
    scene.run(steps=2)
    assert scene.steps == 6


@pytest.mark.parametrize("shape", [None, pendular.clump([[0, 0, -0.4, 0.5], [0, 0, 0.4, 0.5]])], ids=["grains", "clumps"])
def test_control_c_in_a_dense_insertion(shape):
    """It would take 10 s of the processor, and is not done to its end. The scene is as before, and can go on."""
    scene, count = tower(), 200_000 if shape is None else 40_000
    interrupt_after(0.7)
    edge = (count * 1e-9 / 0.55) ** (1 / 3)
    with pytest.raises(KeyboardInterrupt):
        scene.insert(scene.glass, pendular.even_sizes(1.1e-3, 1.3e-3),
                     pendular.box((0, 0, 0.1), (edge, edge, 0.1 + edge)), shape=shape, number=count)
    assert len(scene) == 4
    plain = tower()
    scene.run(steps=100)
    plain.run(steps=100)
    assert scene.hash() == plain.hash()


def test_other_threads_go_on_and_are_refused():
    scene = tower()
    seen, ticks = [], []

    def look():
        while not seen:
            ticks.append(1)
            try:
                scene.position
            except pendular.RunError as error:
                seen.append(str(error))
            time.sleep(0.001)
        scene.stop()

    other = threading.Thread(target=look)
    other.start()
    with pytest.raises(pendular.RunStopped):
        scene.run(1e6)
    other.join()
    assert "Another thread" in seen[0] and ticks


def test_two_scenes_in_two_threads():
    alone = [tower(count=n) for n in (3, 5)]
    for scene in alone:
        scene.run(0.01)
    together = [tower(count=n) for n in (3, 5)]
    threads = [threading.Thread(target=scene.run, args=(0.01,)) for scene in together]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [s.hash() for s in together] == [s.hash() for s in alone]


def test_restart_keeps_bits_calls_and_what_is_remembered():
    def scene(name):
        made = tower(name)
        made.remembered = {"calls": 0.0, "places": np.zeros((4, 3))}

        def note(s):
            s.remembered["calls"] += 1
            s.remembered["places"] += s.position

        made.every_steps(3, note)
        made.every_time(7e-4, note)
        return made

    whole = scene("whole")
    whole.run(0.01)
    first = scene("part")
    first.run(0.004)
    first.write_restart("at-4ms.h5")
    second = scene("part2")
    second.restart_from("at-4ms.h5")
    second.run(0.01)
    assert second.hash() == whole.hash()
    assert second.remembered["calls"] == whole.remembered["calls"] > 0
    assert np.array_equal(second.remembered["places"], whole.remembered["places"])


def test_the_end_completes_files():
    with tower("run") as scene:
        scene.write_energy(1e-3)
        scene.run(0.0025)
        assert not os.path.exists("run-energy.csv") or len(pendular.table("run-energy.csv")) < 4
    assert scene.has_ended
    assert pendular.table("run-energy.csv")["time_s"].iloc[-1] == pytest.approx(scene.time, rel=1e-9)


def test_progress_is_told():
    scene, told = tower(), []
    scene.run(0.01, progress=told.append)
    assert told[-1] == scene.time


def test_progress_bar(capsys):
    tower().run(0.002, progress=True)
    assert "0.002" in capsys.readouterr().err


def test_the_log_goes_to_standard_error_of_python(capsys):
    scene = tower(quiet=False)
    scene.write_summary()
    scene.run(0.002)
    scene.finish()
    assert "grains" in capsys.readouterr().err


def test_scenes_with_functions_that_know_them_are_collected():
    """The scene and its function hold each other."""
    def lost():
        scene = tower()
        scene.every_steps(1, lambda _: scene.time)
        scene.run(steps=2)
        return weakref.ref(scene)

    gone = lost()
    gc.collect()
    assert gone() is None


def test_the_garbage_collector_meets_objects_that_are_being_made():
    """It is asked at each allocation, also while the first scene has no content yet."""
    code = ("import gc, pendular\ngc.set_threshold(1)\nclass Own(pendular.Scene): pass\nfor kind in (pendular.Scene, Own):\n"
            "    scene = kind()\n    g = scene.add_species('LinearViscoelastic', density=1)\n"
            "    print(scene.add_plane(g, (0, 0, 1), (0, 0, 0)))\n")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stdout == 2 * "<pendular.Wall 0: plane>\n", done.stderr


def test_a_scene_that_lives_to_the_end_of_the_interpreter():
    code = ("import pendular\nscene = pendular.Scene('left', quiet=False)\n"
            "g = scene.add_species('LinearViscoelastic', density=2500, stiffness=300, dissipation=1e-3)\n"
            "scene.add_grains(g, [[0, 0, 0]], 1e-3)\nscene.time_step = 1e-5\nscene.write_energy(1e-3)\n"
            "scene.every_steps(1, lambda s: scene.time)\nscene.run(3e-3)\n")
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
    assert len(pendular.table("left-energy.csv")) >= 3


def test_function_of_progress_may_go_on_with_the_run():
    """Its last call is after the last step; while the scene steps it is refused."""
    scene, calls = tower(), []

    def more(time):
        calls.append(time)
        try:
            scene.run(steps=1)
        except (pendular.InputError, pendular.RunError):
            pass

    scene.run(steps=3, progress=more)
    assert calls and scene.steps == 4
