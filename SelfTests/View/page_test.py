"""The page as a person uses it: the list, a run with its charts, the form, comparing, the keyboard; and what axe says of it.
PENDULAR_VIEW_PICTURE=FILE keeps a picture of the page."""
import os
import pathlib
import time

import pytest

browser = pytest.importorskip("browser")
if not browser.is_there():
    pytest.skip("Chromium is not installed", allow_module_level=True)

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
    assert time.time() - max(path.stat().st_mtime for path in (root / "live").glob("*.vtp")) < 60


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
