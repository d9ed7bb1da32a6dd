"""A browser without a screen, for tests of the page: Debian's Chromium, which draws in software."""
import contextlib
import os
import shutil
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

FLAGS = ("--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
         "--disable-dev-shm-usage", "--hide-scrollbars", "--force-device-scale-factor=1", "--enable-precise-memory-info")


def is_there():
    return all(map(shutil.which, ("chromium", "chromedriver")))


def what_is_missing():
    """A sentence, for a test that is left out; empty where there is all."""
    if not is_there():
        return "Chromium is not installed"
    if not os.path.exists(os.path.join(os.environ.get("PENDULAR_VIEW_PAGE", ""), "main.js")):
        return "the page is not built: cmake --build BUILD --target view-page"
    return ""


class Page:
    def __init__(self, width=1200, height=800, dark=False):
        options = webdriver.ChromeOptions()
        for flag in FLAGS + (f"--window-size={width},{height}",) + (("--force-dark-mode",) if dark else ()):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        options.binary_location = shutil.which("chromium")
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_script_timeout(300)

    def js(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def wait(self, condition, limit=60):
        """Until an expression of JavaScript is true; returns how long that took (s)."""
        begin = time.time()
        while not self.js(f"return !!({condition})"):
            assert time.time() - begin < limit, (condition, self.js("return document.body.innerText"), self.problems())
            time.sleep(0.02)
        return time.time() - begin

    def open(self, server, hash_="runs"):
        self.driver.get(server.address)  # moves the token into the cookie
        self.go(server, hash_)

    def go(self, server, hash_):
        self.driver.get("about:blank")  # else only the part behind # would change
        self.driver.get(f"http://127.0.0.1:{server.port}/#{hash_}")

    def problems(self):
        """What the browser has complained of since it was asked last."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]


@contextlib.contextmanager
def page(**options):
    opened = Page(**options)
    try:
        yield opened
    finally:
        opened.driver.quit()
