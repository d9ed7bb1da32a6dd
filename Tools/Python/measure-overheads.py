#!/usr/bin/env python3
"""What the module costs: import, calls, copies, views, Ctrl-C, and a run beside the same run of a C++ program. Prints a table
(CSV) with the targets; times are those of the processor, so that other programs count little, or of the clock where it says so.

    measure-overheads.py [--grains N] [--repeat N] [--program build/release/SelfTests/SameBits] > overheads.csv
"""
import argparse
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import numpy as np

import pendular

GLASS = dict(density=2500, effective_elastic_modulus=1e7, effective_shear_modulus=4e6, dissipation=1e-5,
             sliding_friction_coefficient=0.4)
SPECIES = "HertzianViscoelasticMindlin"


def best(function, repeat, clock=time.thread_time):
    """s of this thread, of the fastest: what other programs do does not count"""
    taken = []
    for _ in range(repeat):
        start = clock()
        answer = function()
        taken.append(clock() - start)
        del answer
    return min(taken)


def places(count):
    """m, N x 3: a cubic grid of grains that just touch, in a random order"""
    side = int(np.ceil(count ** (1 / 3)))
    k = np.random.default_rng(1).permutation(side**3)[:count]
    return 1.99e-3 * (np.stack([k % side, k // side % side, k // side**2], 1) + 0.5)


def bed(count, threads=1, step=None):
    """The grains in a scene, and the time (s) to add them."""
    scene = pendular.Scene(threads=threads)
    glass = scene.add_species(SPECIES, **GLASS)
    place = places(count)
    start = time.thread_time()
    scene.add_grains(glass, place, 1e-3)
    taken = time.thread_time() - start
    scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
    scene.gravity = (0, 0, -9.81)
    scene.time_step = step or 0.05 * scene.stability_limit()
    return scene, taken


def imports():
    command = [sys.executable, "-c", "import time; t = time.process_time(); import pendular; print(time.process_time() - t)"]
    taken = [float(subprocess.run(command, capture_output=True, text=True, check=True).stdout) for _ in range(5)]
    yield "import pendular, with numpy", min(taken), "s", 0.1


def calls(repeat):
    """us of a call, as the difference of runs with and without"""
    def seconds(every, steps=100000):
        scene, _ = bed(2)
        if every:
            scene.every_steps(every, lambda s: None)
        scene.run(steps=10)
        return best(lambda: scene.run(steps=steps), repeat) / steps

    plain = seconds(0)
    yield "step of 2 grains without calls", 1e6 * plain, "us", None
    yield "a call in each step", 1e6 * (seconds(1) - plain), "us", 0.3
    scene, _ = bed(2)
    scene.run(steps=10)
    yield "run(steps=1) with its step", 1e6 * best(lambda: [scene.run(steps=1) for _ in range(2000)], repeat) / 2000, "us", None


def arrays(count, repeat):
    scene, taken = bed(count)
    yield "add_grains()", taken, "s", 0.5
    scene.initialise()
    targets = dict(position=25)
    for name in ("position", "velocity", "radius", "identity", "force", "mass"):
        yield name, 1e3 * best(lambda: getattr(scene, name), repeat), "ms", targets.get(name)
    yield "view('position')", 1e3 * best(lambda: [scene.view("position") for _ in range(1000)], repeat), "us", 2
    yield "time, a call that fits", 1e5 * best(lambda: [scene.time for _ in range(10000)], repeat), "ns", None
    yield "grains(), all fields", best(scene.grains, repeat), "s", None
    velocity = np.zeros((count, 3))
    yield "velocity = array", 1e3 * best(lambda: setattr(scene, "velocity", velocity), repeat), "ms", None
    rows = len(scene.contacts()["wall"])
    yield f"contacts(), {rows} rows, 1 thread", best(scene.contacts, repeat), "s", None
    scene.threads = 2
    scene.contacts()
    # Of a machine with nothing else to do the first one is the time of the clock.
    yield "contacts(), 2 threads, of the one that calls", best(scene.contacts, repeat), "s", 0.6
    yield "contacts(), 2 threads, of both", best(scene.contacts, repeat, time.process_time), "s", None
    yield "contacts(), 2 threads, of the clock", best(scene.contacts, repeat, time.perf_counter), "s", None


def interruptions(times=7, count=10000):
    """s, from the signal to the exception"""
    scene, _ = bed(count)
    clocks = {"": time.process_time, ", of the clock": time.perf_counter}
    taken = []
    for _ in range(times):
        sent = []

        def send():
            time.sleep(0.3)
            sent.extend(clock() for clock in clocks.values())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Thread(target=send).start()
        try:
            scene.run(1e6)
        except KeyboardInterrupt:
            taken.append([clock() - begin for clock, begin in zip(clocks.values(), sent)])
    step = best(lambda: scene.run(steps=50), 1) / 50
    for clock, seconds in zip(clocks, zip(*taken)):
        yield f"Ctrl-C in a run of {count} grains, median of {times}{clock}", statistics.median(seconds), "s", 0.1 + step
        yield f"the longest{clock}", max(seconds), "s", 0.1 + step


def beside_program(program, pairs, count=10000, steps=300):
    """Time of a run without calls over that of the program, in pairs of mirrored order; both have the same bits."""
    step = bed(count)[0].time_step
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "scene.txt")
        with open(file, "w") as out:
            print(f"type {SPECIES}Species", file=out)
            for name, value in GLASS.items():
                first, *others = name.split("_")
                print("set", first + "".join(word.title() for word in others), float(value).hex(), file=out)
            for x in places(count):
                print("grain", *(float(v).hex() for v in (*x, 1e-3, 0)), file=out)
            print("plane 0 0 -1 0 0 0", f"step {step.hex()}", f"steps {steps}", sep="\n", file=out)

        def of_program():
            words = subprocess.run([program, file, "time"], capture_output=True, text=True, check=True).stdout.split()
            return float(words[1]), words[0]

        def of_module():
            scene, _ = bed(count, step=step)
            scene.run(steps=steps)
            start = time.process_time()
            scene.run(steps=steps)
            return time.process_time() - start, scene.hash()

        module, other = [], []
        for pair in range(pairs):
            order = [(module, of_module), (other, of_program)]
            for times, run in order if pair % 2 else order[::-1]:
                times.append(run())
    if len({bits for _, bits in module + other}) != 1:
        sys.exit("measure-overheads.py: the program and the module do not have the same bits.")
    ratios = [m / o for (m, _), (o, _) in zip(module, other)]
    yield f"step of {count} grains, C++", 1e6 * statistics.median(t for t, _ in other) / steps, "us", None
    yield f"step of {count} grains, Python without calls", 1e6 * statistics.median(t for t, _ in module) / steps, "us", None
    yield f"Python over C++, median of {pairs} pairs", statistics.median(ratios), "", 1.01
    yield "Python over C++, the fastest of each", min(t for t, _ in module) / min(t for t, _ in other), "", 1.01


def main():
    options = argparse.ArgumentParser(description="What the Python module costs.")
    options.add_argument("--grains", type=int, default=1000000)
    options.add_argument("--repeat", type=int, default=5)
    options.add_argument("--program", help="SameBits of the same build, for a run beside a C++ program")
    options.add_argument("--pairs", type=int, default=10)
    given = options.parse_args()
    describe = Path(__file__).resolve().parents[1] / "describe-machine.sh"
    subprocess.run([describe, " ".join(["Tools/Python/measure-overheads.py", *sys.argv[1:]])], check=True)
    print("what,number,unit,target", flush=True)
    parts = [imports(), calls(given.repeat), arrays(given.grains, given.repeat), interruptions()]
    if given.program:
        parts.append(beside_program(given.program, given.pairs))
    for rows in parts:
        for what, number, unit, target in rows:
            print(f'"{what}",{number:.4g},{unit},{"" if target is None else f"{target:.4g}"}', flush=True)


if __name__ == "__main__":
    main()
