"""Runs that others compute, queue or stop beside a server of `view`: another server, a program that no server has started,
a full disk, a server that is killed."""
import fcntl
import json
import os
import pathlib
import signal
import stat
import subprocess

import pytest
from conftest import Server, driver_of

LOCKS = {".pendular-lock": "running", "run.pendular-lock": "running", "preparation.pendular-lock": "preparing"}


def refusal(server, path, **wish):
    status, content, _ = server.ask(f"/api/{path}", "POST", json.dumps(wish).encode())
    assert status == 400, content
    return content.decode()


def identity_of(file):
    return file.stat().st_ino, file.read_bytes()


@pytest.fixture
def drivers(tmp_path):
    """Well ends at once; Long goes on; Error fails. None of them takes a lock, so that only the server's own tell of it."""
    folder = tmp_path / "programs"
    driver_of(folder, "Well", ("", "echo done"))
    driver_of(folder, "Long", ("", f"echo $$ >> {tmp_path}/processes; exec sleep 60"))
    driver_of(folder, "Error", ("", "echo 'Error: no grains.'; exit 1"))
    return folder


@pytest.fixture
def servers(root, drivers, tmp_path):
    """Starts servers in one folder; what is left of their runs is killed at the end."""
    all_servers = []

    def start(**options):
        all_servers.append(Server(root, "--drivers", str(drivers), **options))
        return all_servers[-1]

    yield start
    for server in all_servers:
        if server.process.poll() is None:
            server.end()
    processes = tmp_path / "processes"
    for process in processes.read_text().split() if processes.exists() else []:
        if pathlib.Path(f"/proc/{process}/comm").exists() and pathlib.Path(f"/proc/{process}/comm").read_text() == "sleep\n":
            os.kill(int(process), signal.SIGKILL)


@pytest.mark.parametrize("name", LOCKS)
@pytest.mark.parametrize("driver", ["Well", "Error"])
def test_a_run_that_computes_is_not_resumed_and_is_not_failed(servers, root, name, driver):
    server = servers()
    run = server.post("start", driver=driver, name="one", options={})["id"]
    server.wait_for(run, "ended", "failed")
    start = identity_of(root / "one/view-start.json")
    with open(root / "one" / name, "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        now = server.get("run", id=run)
        assert now["state"] == LOCKS[name] and now["reason"] == ""
        told = refusal(server, "resume", id=run, options={})
        assert "under way" in told and str(os.getpid()) in told and told.count("\n") == 1 and "/proc/" not in told
        assert ("prepar" in told) == (name == "preparation.pendular-lock")
        assert identity_of(root / "one/view-start.json") == start
        assert [entry["state"] for entry in server.get("runs")["runs"]] == [LOCKS[name]]
    server.post("resume", id=run, options={})
    server.wait_for(run, "ended" if driver == "Well" else "failed")
    assert not (root / "one" / "run.pendular-lock").exists() and not list((root / "one").glob("*.part"))


def test_two_servers_do_not_compute_one_run_twice(servers, root):
    one, other = servers(), servers()
    run = one.post("start", driver="Long", name="shared", options={})["id"]
    start = identity_of(root / "shared/view-start.json")
    assert one.wait_for(run, "running", "failed")["state"] == "running"
    assert other.get("run", id=run)["state"] == "running"
    assert "under way" in refusal(other, "resume", id=run, options={})
    assert other.get("run", id=run)["state"] == one.get("run", id=run)["state"] == "running"
    assert identity_of(root / "shared/view-start.json") == start
    assert other.post("stop", id=run) == {"told": "It was asked to stop."}  # by what it prints into: it has no lock
    assert one.wait_for(run, "stopped", "failed")["state"] == "stopped"
    assert "not under way" in refusal(other, "stop", id=run)


def test_what_failed_here_and_was_resumed_elsewhere_is_as_it_is_now(servers, root, drivers):
    one, other = servers(), servers()
    run = one.post("start", driver="Error", name="mended", options={})["id"]
    assert one.wait_for(run, "failed")["reason"] == "Error: no grains."
    program = drivers / "Error" / "Error"
    program.write_text(program.read_text().replace("exit 1", "exit 0"))
    (root / "mended/run-summary.csv").write_text("quantity,value,unit\nstate,at its end,\n")
    other.post("resume", id=run, options={})
    other.wait_for(run, "ended")
    assert one.get("run", id=run)["state"] == "ended"


def test_the_queue_of_another_server_is_told_and_kept(servers, root):
    one, other = servers(), servers()
    first = one.post("start", driver="Long", name="first", options={})["id"]
    second = one.post("start", driver="Long", name="second", options={})["id"]
    one.wait_for(first, "running")
    assert one.get("run", id=second)["reason"] == ""
    waiting = other.get("run", id=second)
    assert waiting["state"] == "waiting" and f"queue of another server (process {one.process.pid})" in waiting["reason"]
    for path in ("stop", "resume"):
        assert "in the queue of" in refusal(other, path, id=second, options={})
    assert one.get("run", id=second)["state"] == "waiting"
    assert one.post("stop", id=second) == {"told": "It was taken from the queue."}
    for server in (one, other):
        taken = server.get("run", id=second)
        assert taken["state"] == "stopped" and "has not been started" in taken["reason"]
    one.post("stop", id=first)
    one.wait_for(first, "stopped")
    other.post("resume", id=second, options={})
    other.wait_for(second, "running")
    other.post("stop", id=second)
    other.wait_for(second, "stopped")


@pytest.mark.parametrize("end", [signal.SIGTERM, signal.SIGKILL])
def test_runs_that_waited_for_a_server_that_has_ended_can_be_started(servers, end):
    one = servers()
    first = one.post("start", driver="Long", name="first", options={})["id"]
    waited = [one.post("start", driver="Well", name=name, options={})["id"] for name in ("second", "third")]
    one.wait_for(first, "running")
    one.process.send_signal(end)
    one.process.wait(20)
    if end == signal.SIGTERM:
        assert one.process.returncode == 0
        assert one.process.stdout.read() == "2 runs that waited were not started: second/run, third/run. Resume them from the page to start them.\n"
    other = servers()
    assert "under way" in refusal(other, "resume", id=first, options={})
    for run in waited:
        now = other.get("run", id=run)
        assert now["state"] == "stopped" and "has not been started" in now["reason"] and "killed" not in now["reason"]
        other.post("resume", id=run, options={})
        other.wait_for(run, "ended")


def test_the_options_on_record_are_those_that_compute(servers, root, drivers):
    option = {"name": "--x", "type": "number", "unit": "", "text": "", "default": "1", "several": False, "choices": [], "excludes": [], "needs": [], "path": False}
    told = json.dumps({"driver": "Options", "description": "", "options": [option]})
    program = driver_of(drivers, "Options", ("", "echo \"$@\"; pwd"))
    program.write_text(program.read_text().replace(json.dumps({"driver": "Options", "description": "", "options": []}), told))
    server = servers()
    run = server.post("start", driver="Options", name="options", options={"--x": "1"})["id"]
    server.wait_for(run, "ended")
    long = server.post("start", driver="Long", name="long", options={})["id"]
    server.post("resume", id=run, options={"--x": "2"})
    assert server.get("run", id=run)["state"] == "waiting"
    assert json.loads((root / "options/view-start.json").read_text())["options"] == {"--x": "1"}
    assert "waits in the queue already" in refusal(server, "resume", id=run, options={"--x": "3"})
    server.post("stop", id=long)
    log = server.wait_for(run, "ended")["log"]
    assert json.loads((root / "options/view-start.json").read_text())["options"] == {"--x": "2"}
    assert str(root / "options") in log
    assert "--x=1" in log and "--x=2 --output=." in log and "--resume" in log and "--x=3" not in log


def test_a_start_on_a_full_disk_leaves_no_folder(root, drivers, tmp_path):
    """A file system in memory of eight pages, which only the server sees."""
    program = tmp_path / "view-on-a-small-disk"
    program.write_text(f"#!/bin/sh\nexec unshare -m sh -c 'mount -t tmpfs -o size=32k tmpfs \"$0\" && exec {os.environ['PENDULAR_VIEW']} \"$0\" \"$@\"' \"$@\"\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    if subprocess.run(["unshare", "-m", "mount", "-t", "tmpfs", "-o", "size=32k", "tmpfs", str(root)], check=False, capture_output=True).returncode != 0:
        pytest.skip("this user may not mount a file system")
    server = Server(root, "--drivers", str(drivers), program=str(program))
    disk = pathlib.Path(f"/proc/{server.process.pid}/root{root}")
    for pages in (8, 7):  # of 7, there is room for view-start.json once, and not for the one that is written when the run begins
        (disk / "full").write_bytes(b"x" * 4096 * pages)
        told = refusal(server, "start", driver="Well", name="late", options={})
        assert "No space left on device" in told and told.count("\n") == 1
        assert [path.name for path in disk.iterdir()] == ["full"]
    (disk / "full").unlink()
    assert server.post("start", driver="Well", name="late", options={})["id"] == "late/run"
    server.wait_for("late/run", "ended")
    server.end()


def test_a_run_that_belongs_to_nobody_is_stopped_by_nobody(servers, root):
    """The process that has a lock is a server itself, for a moment, or gone: it is not stopped."""
    server = servers()
    run = server.post("start", driver="Well", name="done", options={})["id"]
    server.wait_for(run, "ended")
    assert "not under way" in refusal(server, "stop", id=run)
    assert "not under way" in refusal(server, "stop", id="none/run")


def test_names_that_are_no_utf8_can_be_opened(servers, root):
    for folder in (b"caf\xe9", "café".encode(), b"100%", b"%E9", b"\xff\xfe/in\xc3"):
        path = os.path.join(os.fsencode(root), folder)
        os.makedirs(path)
        with open(os.path.join(path, b"run-summary.csv"), "w") as file:
            file.write("quantity,value,unit\nstate,at its end,\n")
        with open(os.path.join(path, b"t\xe9.csv"), "w") as file:
            file.write(f"time_s,{folder.hex()}\n0,1\n")
    server = servers()
    names = {"caf%E9/run": b"caf\xe9", "café/run": "café".encode(), "100%25/run": b"100%", "%25E9/run": b"%E9", "%FF%FE/in%C3/run": b"\xff\xfe/in\xc3"}
    assert {run["id"] for run in server.get("runs")["runs"]} == set(names)
    for run, folder in names.items():
        assert server.get("run", id=run)["tables"] == ["t%E9.csv"]
        assert server.get("table", id=run, name="t%E9.csv")["columns"] == ["time_s", folder.hex()]
    for none in ("caf%e9/run", "caf%C3%A9/run", "%E9/run", "100%/run", "caf%2Frun"):
        assert server.ask(f"/api/run?id={none.replace('%', '%25')}")[0] == 404, none
