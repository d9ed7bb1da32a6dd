"""The page as a person uses it: the list, a run with its charts, the form, comparing, the keyboard; and what axe says of it.
PENDULAR_VIEW_PICTURE=FILE keeps a picture of the page."""
import functools
import http.server
import os
import pathlib
import threading
import time

import pytest

browser = pytest.importorskip("browser")
if browser.what_is_missing():
    pytest.skip(browser.what_is_missing(), allow_module_level=True)

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

DRUM = {"--number": "300", "--softening": "1000", "--end-time-s": "0.01", "--interval-s": "0.001", "--energy-interval-s": "0.001", "--paraview-interval-s": "0.002"}
AXE = pathlib.Path(os.environ.get("PENDULAR_AXE", ""))


def check_with_axe(page):
    """axe-core's rules of WCAG 2.1 A and AA, contrast among them."""
    page.js(AXE.read_text())
    violations = page.driver.execute_async_script(
        "const done = arguments[0]; axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa']})"
        ".then(({violations}) => done(violations.map(({id, nodes}) => [id, nodes.map(({html}) => html)])))")
    assert violations == []


def test_from_the_form_to_the_charts(serve, root):
    server = serve()
    with browser.page() as page:
        page.open(server, "start")
        page.wait("document.querySelectorAll('#driver option').length > 0")
        page.js("const d = document.getElementById('driver'); d.value = 'RotatingDrum'; d.dispatchEvent(new Event('change'))")
        for name, value in DRUM.items():
            page.driver.find_element(By.ID, f"option{name}").send_keys(value)
        threads = page.driver.find_element(By.ID, "option--threads")
        threads.send_keys("0")
        assert "at least 1" in page.js("return arguments[0].validationMessage", threads)
        threads.clear()
        if AXE.is_file():
            check_with_axe(page)
        page.driver.find_element(By.CSS_SELECTOR, "button[type=submit]").click()
        page.wait("location.hash.startsWith('#run=RotatingDrum-1')")
        page.wait("document.querySelector('.state.ended')", 120)
        page.wait("pendular.viewer.loads > 0 && pendular.viewer.times.length === 6")
        page.wait("document.querySelectorAll('.chart canvas[width]').length >= 2")

        if "PENDULAR_VIEW_PICTURE" in os.environ:  # the one in Tools/View/README.md
            page.driver.save_screenshot(os.environ["PENDULAR_VIEW_PICTURE"])

        # The keyboard alone: frames, camera, playing.
        canvas = page.driver.find_element(By.CSS_SELECTOR, "canvas.picture")
        last = page.js("return pendular.viewer.shown")
        canvas.send_keys(",")
        page.wait(f"pendular.viewer.shown === {last - 1}")
        turn = page.js("return pendular.viewer.scene.camera.turn")
        canvas.send_keys(Keys.ARROW_LEFT)
        assert page.js("return pendular.viewer.scene.camera.turn") == pytest.approx(turn + 0.1)
        canvas.send_keys("5")
        assert page.js("return pendular.viewer.scene.camera.tilt") == pytest.approx(1.5708, abs=1e-4)
        canvas.send_keys(" ")
        page.wait("pendular.viewer.playing && pendular.viewer.shown === 0")
        canvas.send_keys(" ")
        if AXE.is_file():
            check_with_axe(page)

        # On a telephone nothing is wider than the screen.
        page.driver.set_window_size(500, 800)
        page.wait("document.documentElement.scrollWidth <= innerWidth", 10)
        page.driver.set_window_size(1200, 800)

        # A second run, and both beside each other.
        server.post("start", driver="RotatingDrum", name="other", options={**DRUM, "--speed-rad/s": "4"})
        server.wait_for("other/run", "ended", "failed")
        page.go(server, "runs")
        page.wait("document.querySelectorAll('.runs li').length === 2 && document.querySelectorAll('.runs img').length === 2")
        if AXE.is_file():
            check_with_axe(page)
        for box in page.driver.find_elements(By.CSS_SELECTOR, ".runs input"):
            box.click()
        page.driver.find_element(By.XPATH, "//button[text()='Compare the chosen']").click()
        page.wait("document.body.innerText.includes('--speed-rad/s')")
        assert page.js("return document.querySelectorAll('canvas.picture').length") == 2
        assert page.problems() == []


def test_a_run_is_followed(serve, root):
    """A frame that is on the disk is on the screen soon after."""
    server = serve()
    options = {**DRUM, "--end-time-s": "100", "--paraview-interval-s": "0.005"}
    run = server.post("start", driver="RotatingDrum", name="live", options=options)["id"]
    with browser.page() as page:
        page.open(server, "run=live%2Frun")
        page.wait("pendular.viewer && pendular.viewer.loads > 0", 120)
        frames = page.js("return pendular.viewer.times.length")
        page.wait(f"pendular.viewer.times.length > {frames} && pendular.viewer.shown >= {frames}")
        server.post("stop", id=run)
        page.wait("document.querySelector('.state.stopped')")
        assert page.problems() == []


def test_the_list_goes_on_under_the_focus_and_contexts_are_given_back(serve, root, write_frames):
    server = serve()
    write_frames("picture", "wet")
    server.post("start", driver="RotatingDrum", name="live", options={**DRUM, "--end-time-s": "100"})
    server.wait_for("live/run", "running")
    with browser.page() as page:
        page.open(server)
        page.wait("document.querySelector('.state.running')")
        page.js("document.querySelector('[data-key=\"act live/run\"]').focus()")
        ActionChains(page.driver).send_keys(Keys.ENTER).perform()  # stops it
        page.wait("document.querySelector('.state.stopped')")
        page.wait("document.activeElement.getAttribute('data-key') === 'act live/run'")  # now: goes on
        assert page.js("return document.querySelector('nav [aria-current=page]').textContent") == "Runs"
        page.js("document.getElementById('skip').click()")
        assert page.js("return [document.activeElement.id, location.hash]") == ["page", "#runs"]
        for _ in range(18):  # a browser keeps 16 contexts
            page.js("location.hash = 'run=wet%2Frun'")
            page.wait("pendular.viewer && !pendular.viewer.isOver && pendular.viewer.loads > 0")
            page.js("location.hash = 'start'")
            page.wait("pendular.viewer.isOver")
        assert not [entry for entry in page.driver.get_log("browser") if "Too many active WebGL" in entry["message"]]


def test_a_run_without_frames_shows_its_latest_restart_file(serve, root):
    server = serve()
    options = {name: value for name, value in DRUM.items() if name != "--paraview-interval-s"}
    run = server.post("start", driver="RotatingDrum", name="plain", options={**options, "--end-time-s": "100", "--restart-interval-s": "1"})["id"]
    with browser.page() as page:
        page.open(server, "run=plain%2Frun")
        page.wait("pendular.viewer && pendular.viewer.loads > 0", 120)
        first = page.js("return pendular.viewer.scene.frame.time")
        page.wait(f"pendular.viewer.scene.frame.time > {first}")
        server.post("stop", id=run)
        page.wait("document.querySelector('.state.stopped')")
        assert page.problems() == []


def test_maps_of_fields(serve, write_frames):
    """Fields of coarse graining: images and HDF5 files as maps of space, a table of one direction as a map over time."""
    write_frames("fields", "one")
    server = serve()
    with browser.page() as page:
        page.open(server, "run=one%2Frun")
        page.wait("pendular.maps?.size === 2 && [...pendular.maps.values()].every((map) => map.loads > 0)")
        page.wait("document.querySelectorAll('canvas.map').length === 3")
        page.js("window.plane = pendular.maps.get('run-coarse.pvd'); window.colour = (column, row) => [...plane.map.canvas.getContext('2d').getImageData(column, 9 - row, 1, 1).data]")
        assert page.js("return plane.shown") == 1  # the last of both
        page.js("const s = plane.fieldSelect; s.value = 'density_kg_per_m3'; s.dispatchEvent(new Event('change'))")
        page.wait("plane.map.content.unit === 'kg/m^3'")
        # The grain is at x = 11 mm, z = 7 mm: there the map has its last colour, and far away its first one.
        assert page.js("return colour(5, 3)") == [0xFD, 0xE7, 0x25, 255]
        assert page.js("return colour(0, 9)") == [0x44, 0x01, 0x54, 255]
        assert page.js("return plane.map.legend.unit.textContent") == "kg/m^3"
        assert [float(page.js(f"return plane.map.{end}.textContent")) for end in ("left", "right", "bottom", "top")] == pytest.approx([0, 0.02, 0, 0.02], abs=1e-12)
        box = page.js("const {width, height} = plane.map.canvas.getBoundingClientRect(); return [width, height]")
        assert box[0] == pytest.approx(box[1], rel=0.02)  # 20 mm x 20 mm
        # The value is said, by the pointer and by the keyboard; where there is no grain there is no colour.
        page.js("plane.map.say(5, 3)")
        assert page.js("return plane.map.said.textContent").startswith("x (m) 0.011, z (m) 0.007: ")
        plane = page.js("return plane.map.canvas")
        plane.send_keys(Keys.ARROW_RIGHT)
        assert page.js("return plane.map.said.textContent").startswith("x (m) 0.013, z (m) 0.007: ")
        page.js("const s = plane.fieldSelect; s.value = 'velocity_m_per_s.z'; s.dispatchEvent(new Event('change'))")
        page.wait("plane.map.content.unit === 'm/s'")
        assert page.js("return colour(0, 9)[3]") == 0 and page.js("return colour(5, 3)[3]") == 255
        # The time before, when the grain was at rest; a fixed range.
        page.js("const t = plane.timeSlider; t.value = 0; t.dispatchEvent(new Event('input'))")
        page.wait("plane.when.textContent.startsWith('0 s, 1 of 2') && plane.map.content.values.some((v) => v === 0)")
        page.js("const [a, b] = plane.map.range.ends; a.value = '-1'; b.value = '1'; b.dispatchEvent(new Event('change'))")
        assert page.js("return [plane.map.legend.low.textContent, plane.map.legend.high.textContent]") == ["-1", "1"]
        assert page.js("return colour(5, 3)")[:3] == pytest.approx([0x23, 0x8A, 0x8D], abs=6)  # the middle of the colours
        # Of three directions a slice.
        page.js("window.space = pendular.maps.get('run-space.h5'); const s = space.normalSelect; s.value = 2; s.dispatchEvent(new Event('change'))")
        page.wait("space.map.content.up.label === 'y (m)'")
        page.js("const s = space.sliceSlider; s.value = 3; s.dispatchEvent(new Event('input'))")
        page.wait("space.map.content.values.reduce((best, v, k, all) => (all[best] >= v ? best : k), 0) === 45")
        # Of one direction: over time. The grain is at z = 7 mm.
        profile = "pendular.charts.charts.get('run-line.csv').map"
        page.js(f"const p = {profile}; p.select.value = [...p.select.options].find(({{text}}) => text === 'density_kg_per_m3').value; p.draw()")
        values = page.js(f"return [...{profile}.map.content.values]")
        assert len(values) == 20 and values.index(max(values)) in (6, 7)
        if AXE.is_file():
            check_with_axe(page)
        assert page.problems() == []


# Answers whose address has the word `late` come when they are let go; those with the word `broken` never do.
HOLD = """
window.held = [], window.late = window.broken = null;
const real = window.fetch;
window.fetch = (address, ...more) => {
    const has = (word) => word && address.startsWith("api/") && address.includes(word);
    if (has(window.broken)) return Promise.reject(new Error("The line is down."));
    if (!has(window.late)) return real(address, ...more);
    return new Promise((done) => held.push(() => real(address, ...more).then((answer) => { done(answer); setTimeout(() => { window.came = true; }, 200); })));
};
"""
CHOOSE = "window.choose = (select, value) => { select.value = value; select.dispatchEvent(new Event('change')); };"


def test_answers_that_come_late_or_not_at_all(serve, write_frames):
    """What was chosen last is what is shown, also where the answer to a choice before comes after it."""
    write_frames("fields", "one")
    write_frames("picture", "wet")
    server = serve()
    with browser.page() as page:
        page.open(server, "run=one%2Frun")
        page.wait("pendular.maps?.size === 2 && [...pendular.maps.values()].every((map) => map.loads > 0)")
        page.js(HOLD + CHOOSE + "window.plane = pendular.maps.get('run-coarse.pvd')")
        page.js("window.late = 'field=velocity'; choose(plane.fieldSelect, 'velocity_m_per_s.z'); choose(plane.fieldSelect, 'density_kg_per_m3')")
        page.wait("plane.map.content.unit === 'kg/m^3' && held.length === 1")
        page.js("held.pop()()")
        page.wait("window.came")
        assert page.js("return [plane.field, plane.fieldSelect.value, plane.map.content.unit]") == ["density_kg_per_m3", "density_kg_per_m3", "kg/m^3"]
        # The first answer of a map does not come: it is asked for again, as long as it takes.
        told = page.js("window.broken = 'api/map'; window.other = new plane.constructor(plane.id, plane.name);"
                       "return other.setTimes(plane.times).then(() => other.setTimes(plane.times)).then(() => document.getElementById('told').textContent)")
        assert told == "The line is down." and page.js("return other.loads ?? 0") == 0
        assert page.js("window.broken = null; return other.setTimes(plane.times).then(() => other.setTimes(plane.times)).then(() => [other.loads, document.getElementById('told').textContent])") == [1, ""]

        page.go(server, "run=wet%2Frun")
        page.wait("pendular.viewer?.loads > 0")
        page.js(HOLD + CHOOSE + "window.names = [...pendular.viewer.fieldSelect.options].map(({value}) => value).filter((name) => name !== pendular.viewer.field)")
        page.js("window.late = 'field='; for (const name of names.slice(0, 2)) choose(pendular.viewer.fieldSelect, name); window.late = null; window.loads = pendular.viewer.loads; held.pop()()")
        page.wait("pendular.viewer.loads === loads + 2")
        assert page.js("return pendular.viewer.field === names[1] && pendular.viewer.fieldSelect.value === names[1]")
        assert page.problems() == []


def test_tables_of_ones_own(root, serve, write_frames):
    """A grain's path is a chart, though its columns are those of a profile: times x places would be 1.6e9 here."""
    write_frames("fields", "one")
    head, own = "time_s,z_m,velocity_m_per_s\n", root / "one"
    (own / "run-path.csv").write_text(head + "".join(f"{k * 1e-4:g},{-k * k * 1e-9:.12g},{k * 1e-5:g}\n" for k in range(40000)))
    (own / "run-pair.csv").write_text(head + "0,1,0\n0,2,0\n")  # one time with two places, until there is more
    server = serve()
    with browser.page() as page:
        page.open(server, "run=one%2Frun")
        page.js("window.chart = (name) => pendular.charts.charts.get(name)")
        page.wait("chart('run-path.csv')?.chart?.data.datasets[0]?.data.length > 100 && chart('run-line.csv')?.map && chart('run-pair.csv')?.map")
        assert page.js("const {map, table} = chart('run-path.csv'); return [!map, table.values[0].length]") == [True, 40000]
        with (own / "run-pair.csv").open("a") as file:
            file.write("".join(f"{k},{1 - k * k},0\n{k},{2 - k * k},0\n" for k in range(1, 5)))
        page.wait("!chart('run-pair.csv').map && chart('run-pair.csv').chart?.data.datasets[0].data.length === 10")
        assert page.js("const {element} = chart('run-pair.csv'); return [element.querySelectorAll('canvas.map').length, element.querySelectorAll('.chart canvas').length, element.querySelectorAll('input').length]") == [0, 1, 2]
        assert page.problems() == []


def test_on_a_telephone(serve, write_frames):
    write_frames("picture", "wet")
    write_frames("fields", "one")
    server = serve()
    with browser.page() as page:
        page.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        page.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
        page.open(server)
        page.wait("document.querySelectorAll('.runs li').length === 2")
        for hash_, ready in (("runs", "true"), ("start", "document.querySelector('#driver option')"), ("run=one%2Frun", "pendular.maps?.size === 2"),
                             ("run=wet%2Frun", "pendular.viewer?.loads > 0")):
            page.go(server, hash_)
            page.wait(ready)
            assert page.js("return [innerWidth, document.documentElement.scrollWidth <= 390]") == [390, True], hash_
        place = page.js("const {x, y, width, height} = document.querySelector('canvas.picture').getBoundingClientRect(); return [x + width / 2, y + height / 2]")
        touch = lambda kind, *apart: page.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [
            {"x": place[0] + side * half, "y": place[1], "id": k} for half in apart for k, side in enumerate((-1, 1))]})
        distance, turn = page.js("const {distance, turn} = pendular.viewer.scene.camera; return [distance, turn]")
        touch("touchStart", 20), touch("touchMove", 60), touch("touchEnd")
        assert page.js("return pendular.viewer.scene.camera.distance") < 0.6 * distance  # two fingers come near
        page.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": place[0], "y": place[1]}]})
        page.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [{"x": place[0] + 50, "y": place[1]}]})
        touch("touchEnd")
        assert page.js("return pendular.viewer.scene.camera.turn") == pytest.approx(turn - 0.3, abs=0.05)


def test_a_film_a_picture_and_drawing_while_the_camera_moves(serve, write_frames):
    write_frames("lattice", "wet", 500, 400, 5)
    server = serve()
    with browser.page() as page:
        page.open(server, "run=wet%2Frun")
        page.wait("pendular.viewer?.loads > 0")
        page.js("window.saved = []; URL.createObjectURL = ((make) => (blob) => { saved.push(blob); return make.call(URL, blob); })(URL.createObjectURL)")
        page.js("pendular.viewer.saveFilm()")
        page.wait("saved.length === 1")
        film = page.driver.execute_async_script(
            "const done = arguments[0], video = document.createElement('video'); video.onloadeddata = () => done([saved[0].type, saved[0].size, video.videoWidth, video.videoHeight]);"
            "video.onerror = () => done(video.error.message); video.src = URL.createObjectURL(saved[0])")
        canvas = page.js("const {width, height} = pendular.viewer.canvas; return [width, height]")
        assert film[0].startswith("video/") and film[1] > 5000 and film[2:] == canvas, film
        page.driver.find_element(By.CSS_SELECTOR, "canvas.picture").send_keys("s")
        page.wait("saved.at(-1).type === 'image/png'")
        # What takes long to draw is drawn coarsely while the camera moves, and whole when it rests.
        page.js("pendular.viewer.drawing = 1000")
        page.driver.find_element(By.CSS_SELECTOR, "canvas.picture").send_keys(Keys.ARROW_LEFT)
        page.wait(f"pendular.viewer.canvas.width === {canvas[0] // 2} || pendular.viewer.canvas.width === {(canvas[0] + 1) // 2}", 5)
        page.wait(f"pendular.viewer.canvas.width === {canvas[0]}", 5)
        assert page.problems() == []


def test_hdf5_frames_are_shown(serve, write_frames):
    write_frames("hdf5", "wet")
    server = serve()
    with browser.page(dark=True) as page:
        page.open(server, "run=wet%2Frun")
        page.wait("pendular.viewer?.loads > 0 && pendular.viewer.times.length === 2")
        assert page.js("return pendular.viewer.shown") == 1 and page.js("return pendular.viewer.scene.frame.grains.length") == 4 * 13
        assert page.js("return pendular.viewer.when.textContent") == "0.5 s, 2 of 2"
        assert page.problems() == []


def test_a_frame_of_a_notebook(serve, write_frames, tmp_path):
    """As pendular.view() shows it: in a frame of a page of another port of localhost; a page of another host gets nothing."""
    write_frames("picture", "wet")
    server = serve("--frame-of", "http://localhost:*")
    (tmp_path / "notebook.html").write_text(f'<!doctype html><iframe width="900" height="700" src="{server.address}&amp;run=wet%2Frun"></iframe>')
    notebook = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(http.server.SimpleHTTPRequestHandler, directory=tmp_path))
    threading.Thread(target=notebook.serve_forever, daemon=True).start()
    with browser.page() as page:
        for host, is_shown in (("localhost", True), ("127.0.0.1", False)):
            page.driver.get(f"http://{host}:{notebook.server_port}/notebook.html")
            page.driver.switch_to.frame(0)
            if is_shown:
                page.wait("window.pendular?.viewer?.loads > 0")
                assert page.js("return location.hash") == "#run=wet%2Frun"
            else:
                time.sleep(2)
                assert page.js("return window.pendular === undefined")
    notebook.shutdown()
