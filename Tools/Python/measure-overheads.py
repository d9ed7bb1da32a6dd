#!/usr/bin/env python3
"""What the module costs: calls, copies, views, in time of the processor. Prints a table: what,number,unit.

    measure-overheads.py [--grains N] [--repeat N]
"""
import argparse
import subprocess
import sys
import time

import numpy as np

import pendular


def best(function, repeat, clock=time.thread_time):
    """s of this thread, of the fastest: what other programs do does not count"""
    taken = []
    for _ in range(repeat):
        start = clock()
        answer = function()
        taken.append(clock() - start)
        del answer
    return min(taken)


def bed(count, threads=1):
    """Grains in a cubic grid that just touch, in a random order of adding; and the time (s) to add them."""
    scene = pendular.Scene(threads=threads)
    glass = scene.add_species("HertzianViscoelasticMindlin", density=2500, young_modulus=1e7, poisson_ratio=0.25,
                              restitution_coefficient=0.5, sliding_friction_coefficient=0.4)
    side = int(np.ceil(count ** (1 / 3)))
    k = np.random.default_rng(1).permutation(side**3)[:count]
    place = 1.99e-3 * (np.stack([k % side, k // side % side, k // side**2], 1) + 0.5)
    start = time.thread_time()
    scene.add_grains(glass, place, 1e-3)
    taken = time.thread_time() - start
    scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
    scene.choose_time_step()
    return scene, taken


def calls(repeat):
    """us of a call, as the difference of runs with and without"""
    def seconds(every, steps=100000):
        scene, _ = bed(2)
        if every:
            scene.every_steps(every, lambda s: None)
        scene.run(steps=10)
        return best(lambda: scene.run(steps=steps), repeat) / steps

    plain = seconds(0)
    yield "step of 2 grains without calls", 1e6 * plain, "us"
    yield "a call in each step", 1e6 * (seconds(1) - plain), "us"
    scene, _ = bed(2)
    scene.run(steps=10)
    yield "run(steps=1), and its step", 1e6 * best(lambda: [scene.run(steps=1) for _ in range(2000)], repeat) / 2000, "us"


def arrays(count, repeat):
    scene, taken = bed(count)
    yield "add_grains()", taken, "s"
    scene.initialise()
    for name in ("position", "velocity", "radius", "identity", "force", "mass"):
        yield name, 1e3 * best(lambda: getattr(scene, name), repeat), "ms"
    yield "view('position')", 1e6 * best(lambda: scene.view("position"), repeat), "us"
    yield "grains()", best(scene.grains, repeat), "s"
    velocity = np.zeros((count, 3))
    yield "velocity = array", 1e3 * best(lambda: setattr(scene, "velocity", velocity), repeat), "ms"
    for threads in (1, 2):
        scene.threads = threads
        contacts = scene.contacts()
        yield f"contacts(), {len(contacts['wall'])} rows, {threads} threads", best(scene.contacts, repeat, time.perf_counter), "s"
        if threads == 1:
            yield "the same, of the thread", best(scene.contacts, repeat), "s"


def main():
    options = argparse.ArgumentParser(description="What the Python module costs.")
    options.add_argument("--grains", type=int, default=1000000)
    options.add_argument("--repeat", type=int, default=3)
    given = options.parse_args()
    print("what,number,unit")
    command = [sys.executable, "-c", "import time; t = time.thread_time(); import pendular; print(time.thread_time() - t)"]
    imports = [float(subprocess.run(command, capture_output=True, text=True, check=True).stdout) for _ in range(5)]
    print(f"import with numpy,{min(imports):.3f},s")
    for rows in (calls(given.repeat), arrays(given.grains, given.repeat)):
        for what, number, unit in rows:
            print(f'"{what}",{number:.4g},{unit}', flush=True)


if __name__ == "__main__":
    main()
