"""What the tests of `view` share. CTest says where the programs are: PENDULAR_VIEW, PENDULAR_VIEW_FRAMES,
PENDULAR_DRIVERS, PENDULAR_VIEW_PAGE."""
import http.client
import json
import os
import re
import signal
import subprocess
import time
import urllib.parse

import pytest


class Server:
    """`view` in a folder, and one who asks it as its page does."""

    def __init__(self, root, *options, program=None, page=os.environ.get("PENDULAR_VIEW_PAGE", ""), stdin=None):
        """page: None where the program is to find page and drivers by itself"""
        command = [program or os.environ["PENDULAR_VIEW"], str(root), *options]
        if page is not None:
            command += ["--page", self.page_in(root.parent, page)]
        if page is not None and "--drivers" not in options:
            command += ["--drivers", os.environ["PENDULAR_DRIVERS"]]
        self.process = subprocess.Popen(command, stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while True:
            line = self.process.stdout.readline()
            found = re.match(r"http://[^:]+:(\d+)/\?token=([0-9a-f]{32})$", line)
            if found:
                break
            assert line, self.process.stderr.read()
        self.address = line.strip()
        self.port, self.token = int(found[1]), found[2]
        self.cookie = f"pendular-{self.token[:8]}={self.token}"

    @staticmethod
    def page_in(folder, page):
        """The built page, or, where it has not been built, one that is enough for what asks the server itself."""
        if os.path.exists(os.path.join(page, "main.js")):
            return page
        (folder / "page").mkdir(exist_ok=True)
        for name in ("index.html", "main.js", "main.css", "icon.svg"):
            (folder / "page" / name).write_text("<!doctype html>")
        return str(folder / "page")

    def ask(self, path, method="GET", body=None, at="127.0.0.1", **headers):
        """Status, content and headers of the answer; None takes a header away."""
        given = {"Host": f"127.0.0.1:{self.port}", "Cookie": self.cookie}
        if method == "POST":
            given.update({"Origin": f"http://127.0.0.1:{self.port}", "Content-Type": "application/json", "X-Pendular": "1"})
        given.update({name.replace("_", "-"): value for name, value in headers.items()})
        connection = http.client.HTTPConnection(at, self.port, timeout=60)
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in given.items():
            if value is not None:
                connection.putheader(name, value)
        if body is not None:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        answer = connection.getresponse()
        return answer.status, answer.read(), dict(answer.getheaders())

    def get(self, path, **words):
        status, content, _ = self.ask(f"/api/{path}?{urllib.parse.urlencode(words)}")
        assert status == 200, content
        return json.loads(content)

    def post(self, path, **wish):
        status, content, _ = self.ask(f"/api/{path}", "POST", json.dumps(wish).encode())
        assert status == 200, content
        return json.loads(content)

    def wait_for(self, run, *states, limit=120):
        """Until the run is in one of the states."""
        end = time.time() + limit
        while True:
            now = self.get("run", id=run)
            if now["state"] in states:
                return now
            assert time.time() < end, (now["state"], now["reason"], now["log"])
            time.sleep(0.1)

    def memory(self):
        """kB, as the system counts what is the process's own."""
        with open(f"/proc/{self.process.pid}/status") as status:
            return int(re.search(r"VmRSS:\s+(\d+)", status.read())[1])

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(20) == 0


def driver_of(folder, name, lines):
    """A program that describes itself as a driver, and then does what the lines say."""
    (folder / name).mkdir(parents=True)
    program = folder / name / name
    told = json.dumps({"driver": name, "description": "", "options": []})
    program.write_text(f"#!/bin/sh\nif [ \"$1\" = --describe-options ]; then\n{lines[0]}\necho '{told}'; exit\nfi\n{lines[1]}\n")
    program.chmod(0o755)
    return program


@pytest.fixture
def root(tmp_path):
    folder = tmp_path / "runs"
    folder.mkdir()
    return folder


@pytest.fixture
def serve(root):
    """Starts a server in the folder of the test; it must end well."""
    servers = []

    def start(*options):
        servers.append(Server(root, *options))
        return servers[-1]

    yield start
    for server in servers:
        server.end()


@pytest.fixture
def write_frames(root):
    def write(kind, name, *numbers):
        (root / name).mkdir()
        subprocess.run([os.environ["PENDULAR_VIEW_FRAMES"], kind, str(root / name), *map(str, numbers)], check=True)
        return f"{name}/run"

    return write
