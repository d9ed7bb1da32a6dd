#!/usr/bin/env python3
"""How long the page of `view` takes, and how much memory: in Debian's Chromium, which draws in software, with a lattice of grains.

    Tools/install-dependencies.sh --view --page --browser
    cmake --preset release -D PENDULAR_BUILD_TESTS=ON && cmake --build --preset release --target view view-page ViewFrames
    Tools/View/measure-view.py [--build build/release] [--output view.csv] [--runs 3]

Times on the clock, and of all processors (/proc/PID/stat, which other programs do not lengthen): medians of some runs.
"""
import argparse
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "SelfTests/View"))
import browser  # noqa: E402
from conftest import Server  # noqa: E402

SCENES = {"wet": (100000, 313000), "dry": (1000000, 0)}  # grains, bridges
TICK = os.sysconf("SC_CLK_TCK")


def descendants(process):
    """The process and all that it has started."""
    found = [process]
    for one in found:
        try:
            found += [int(word) for task in os.listdir(f"/proc/{one}/task") for word in open(f"/proc/{one}/task/{task}/children").read().split()]
        except OSError:
            pass
    return found


def processor_time(process):
    """s, of a process and its descendants."""
    ticks = 0
    for one in descendants(process):
        try:
            ticks += sum(map(int, open(f"/proc/{one}/stat").read().rpartition(")")[2].split()[11:13]))
        except OSError:
            pass
    return ticks / TICK


def memory(process, row):
    """MB, as the system counts it."""
    return int(re.search(rf"{row}:\s+(\d+)", open(f"/proc/{process}/status").read())[1]) / 1e3


def page_memory(page):
    """MB, of the process that has the page, without what it shares."""
    renderers = [one for one in descendants(page.driver.service.process.pid) if b"--type=renderer" in pathlib.Path(f"/proc/{one}/cmdline").read_bytes()]
    return max(memory(one, "RssAnon") for one in renderers)


class Watch:
    """Times of what is done in it: on the clock, and of the processors for browser and server together."""

    def __init__(self, page, server):
        self.processes = (page.driver.service.process.pid, server.process.pid)

    def __enter__(self):
        self.begin, self.used = time.time(), sum(map(processor_time, self.processes))
        return self

    def __exit__(self, *_):
        self.clock, self.processors = time.time() - self.begin, sum(map(processor_time, self.processes)) - self.used


def turned(page, count, how):
    """Draws so many times from new places."""
    page.js("const v = pendular.viewer.scene; for (let k = 0; k < arguments[0]; ++k) { v.camera.rotate(0.05, 0); v.render({finish: true, isCoarse: arguments[1]}); }", count, how)


def measure(root, scene):
    """Rows (what, clock s, processor s) and (what, MB) of a scene."""
    folder = root / scene / "wet"
    index = folder / "run.pvd"
    whole = index.read_text()
    second = whole.index('<DataSet timestep="0.01"')
    index.write_text(whole[:second] + "</Collection>\n</VTKFile>\n")
    server = Server(root / scene)
    rows = []
    with browser.page() as page:
        page.open(server, "start")
        with Watch(page, server) as watch:
            page.go(server, "run=wet%2Frun")
            page.wait("pendular.viewer && pendular.viewer.loads > 0", 300)
        rows.append(("first picture", watch.clock, watch.processors))
        for what, is_coarse in (("a frame", False), ("a frame while the camera moves", True)):
            turned(page, 2, is_coarse)
            with Watch(page, server) as watch:
                turned(page, 6, is_coarse)
            rows.append((what, watch.clock / 6, watch.processors / 6))
        page.js("pendular.viewer.scene.render({finish: true})")
        with Watch(page, server) as watch:
            index.with_suffix(".part").write_text(whole)
            index.with_suffix(".part").rename(index)
            page.wait("pendular.viewer.shown === 1", 300)
        rows.append(("frame on the disk to the screen", watch.clock, watch.processors))
        page.driver.execute_cdp_cmd("HeapProfiler.collectGarbage", {})
        rows.append(("memory of the page", page_memory(page)))
    rows += [("memory of the server at its peak", memory(server.process.pid, "VmHWM")), ("memory of the server after it", memory(server.process.pid, "VmRSS"))]
    server.end()
    index.write_text(whole)
    return rows


def main():
    wish = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    wish.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    wish.add_argument("--output", default="view.csv")
    wish.add_argument("--runs", type=int, default=3)
    wish = wish.parse_args()
    if not browser.is_there():
        sys.exit("measure-view.py: there is no Chromium (Tools/install-dependencies.sh --browser).")
    os.environ.update(PENDULAR_VIEW=str(wish.build / "Tools/view"), PENDULAR_DRIVERS=str(wish.build / "Drivers"))
    page = wish.build / "Tools/ViewPage"
    if not (page / "main.js").exists():
        sys.exit(f"measure-view.py: the page is not in {page}; build the target view-page.")
    Server.__init__.__kwdefaults__["page"] = str(page)
    machine = subprocess.run([ROOT / "Tools/describe-machine.sh", " ".join(["Tools/View/measure-view.py", *sys.argv[1:]])], capture_output=True, text=True).stdout
    with tempfile.TemporaryDirectory() as place, open(wish.output, "w") as table:
        root = pathlib.Path(place)
        chromium = subprocess.run(["chromium", "--version"], capture_output=True, text=True).stdout.strip()
        table.write(f"{machine}# browser: {chromium}, which draws in software; picture of the page at 1200 x 800\n")
        table.write("grains,bridges,what,clock_s,processors_s,memory_MB\n")
        for scene, (grains, bridges) in SCENES.items():
            folder = root / scene / "wet"
            folder.mkdir(parents=True)
            subprocess.run([wish.build / "SelfTests/ViewFrames", "lattice", folder, str(grains), str(bridges), "2"], check=True)
            runs = [measure(root, scene) for _ in range(wish.runs)]
            for same in zip(*runs):
                what, numbers = same[0][0], [statistics.median(one[k] for one in same) for k in range(1, len(same[0]))]
                cells = [f"{number:.3g}" for number in numbers]
                table.write(",".join([str(grains), str(bridges), what, *(cells if len(cells) == 2 else ["", "", *cells])]) + "\n")
                table.flush()
            shutil.rmtree(folder)
    print(pathlib.Path(wish.output).read_text(), end="")


main()
