"""Runs that `view` starts, stops and goes on with: the same bits as from the command line, and the sentences of what
cannot be."""
import json
import os
import pathlib
import re
import subprocess
import time

import pytest
from conftest import driver_of

DRIVERS = pathlib.Path(os.environ["PENDULAR_DRIVERS"])
DRUM = {"--number": "120", "--softening": "1000", "--end-time-s": "0.01", "--interval-s": "0.001", "--energy-interval-s": "0.001"}
TABLES = ("zones.csv", "grains.csv", "run-energy.csv", "run-restart.h5")


def at_the_command_line(folder, options):
    words = [f"{name}={value}" for name, value in options.items()]
    subprocess.run([DRIVERS / "RotatingDrum/RotatingDrum", f"--output={folder}", *words], check=True, capture_output=True)


def bytes_of(folder):
    return {name: (folder / name).read_bytes() for name in TABLES}


def refusal(server, path, **wish):
    status, content, _ = server.ask(f"/api/{path}", "POST", json.dumps(wish).encode())
    assert status == 400
    return content.decode()


def test_a_run_from_the_form_is_that_of_the_command_line(serve, root, tmp_path):
    at_the_command_line(tmp_path / "plain", DRUM)
    server = serve()
    run = server.post("start", driver="RotatingDrum", name="", options=DRUM)["id"]
    assert run == "RotatingDrum-1/run"
    ended = server.wait_for(run, "ended", "failed")
    assert ended["state"] == "ended" and ended["healthy"] and ended["time"] == pytest.approx(0.01, rel=0.01)
    assert ended["start"] == {"driver": "RotatingDrum", "options": DRUM}
    assert bytes_of(root / "RotatingDrum-1") == bytes_of(tmp_path / "plain")
    table = server.get("table", id=run, name="zones.csv")
    assert table["columns"][0] == "time_s" and table["begins"]
    assert [row[0] for row in table["rows"]] == sorted(row[0] for row in table["rows"]) and len(table["rows"]) >= 11
    assert server.get("table", id=run, name="zones.csv", **{"from": table["next"]})["rows"] == []


def test_stopped_and_resumed_it_leaves_the_bytes_of_an_unbroken_run(serve, root, tmp_path):
    options = {**DRUM, "--end-time-s": "0.12", "--interval-s": "0.005", "--energy-interval-s": "0.005"}
    at_the_command_line(tmp_path / "whole", options)
    server = serve()
    run = server.post("start", driver="RotatingDrum", name="broken", options=options)["id"]
    server.wait_for(run, "running")
    while "zones.csv" not in server.get("run", id=run)["tables"] or server.get("table", id=run, name="zones.csv")["rows"] == []:
        time.sleep(0.02)
    server.post("stop", id=run)
    stopped = server.wait_for(run, "stopped", "ended")
    assert stopped["state"] == "stopped" and 0 <= stopped["time"] < 0.12  # 0: before its first step
    server.post("resume", id=run, options={"--threads": "2"})
    assert server.wait_for(run, "ended", "failed")["state"] == "ended"
    assert bytes_of(root / "broken") == bytes_of(tmp_path / "whole")


def test_preparing_is_said_and_a_queue_is_kept(serve, root):
    server = serve()
    slow = {**DRUM, "--number": "3000", "--softening": "10"}
    first = server.post("start", driver="RotatingDrum", name="first", options=slow)["id"]
    second = server.post("start", driver="RotatingDrum", name="second", options=DRUM)["id"]
    preparing = server.wait_for(first, "preparing")
    while preparing["time"] is None:
        preparing = server.get("run", id=first)
    assert preparing["state"] == "preparing" and preparing["endTime"] > 0 and preparing["grains"] == 3000
    assert server.get("run", id=second)["state"] == "waiting"
    server.post("stop", id=first)
    server.wait_for(first, "stopped", "failed")
    assert server.wait_for(second, "ended", "failed")["state"] == "ended"


def test_another_server_stops_what_it_has_not_started(serve, root):
    one, other = serve(), serve()
    run = one.post("start", driver="RotatingDrum", name="far", options={**DRUM, "--end-time-s": "100"})["id"]
    other.wait_for(run, "running", "preparing")
    other.post("stop", id=run)
    other.wait_for(run, "stopped")


def test_the_end_of_a_run_that_says_nothing_is_noted_for_other_servers(serve, root, tmp_path):
    drivers = tmp_path / "programs"
    driver_of(drivers, "Signal", ("", "kill -KILL $$"))
    driver_of(drivers, "Long", ("", "exec sleep 60"))
    one, other = (serve("--drivers", str(drivers)) for _ in range(2))
    killed = one.post("start", driver="Signal", name="killed", options={})["id"]
    assert other.wait_for(killed, "failed", "stopped")["reason"].startswith("it was ended by the signal 9")
    stopped = one.post("start", driver="Long", name="stopped", options={})["id"]
    other.wait_for(stopped, "running")
    other.post("stop", id=stopped)
    assert other.wait_for(stopped, "failed", "stopped")["state"] == "stopped"
    # The note of one that runs again is gone; what is no note counts as none.
    one.post("resume", id=stopped)
    assert "end" not in other.wait_for(stopped, "running")["start"]
    one.post("stop", id=stopped)
    for number, end in enumerate(("[]", '{"state": 1}', '{"state": "<b>", "reason": {}}', '{"state": "ended"}')):
        folder = root / f"note-{number}"
        folder.mkdir()
        (folder / "view-start.json").write_text('{"driver": "Long", "options": {}, "end": %s}' % end)
        (folder / "view-output.txt").write_text("")
        assert other.get("run", id=f"note-{number}/run")["state"] == "silent"


def test_a_run_that_cannot_begin_says_why(serve):
    server = serve()
    run = server.post("start", driver="RotatingDrum", name="few", options={"--number": "1"})["id"]
    failed = server.wait_for(run, "failed")
    assert "has room for" in failed["reason"] and failed["reason"] in failed["log"]


def test_each_end_of_a_run_is_told_as_it_was(serve, root, tmp_path):
    drivers = tmp_path / "programs"
    driver_of(drivers, "Well", ("", "echo done"))
    driver_of(drivers, "Signal", ("", "echo 50 percent; kill -KILL $$"))
    driver_of(drivers, "Code", ("", "echo 50 percent; exit 3"))
    driver_of(drivers, "Error", ("", "echo 'Error: no grains.'; echo 50 percent; exit 1"))
    driver_of(drivers, "Mute", ("", "echo 50 percent; exit 1"))
    driver_of(drivers, "Long", ("", "exec sleep 60"))
    driver_of(drivers, "Gone", ("", ""))
    server = serve("--drivers", str(drivers))
    ends = {"Well": ("ended", ""), "Signal": ("failed", "it was ended by the signal 9"), "Code": ("failed", "it ended with the exit code 3"),
            "Error": ("failed", "Error: no grains."), "Mute": ("failed", "it ended with an error")}
    for name, (state, reason) in ends.items():
        run = server.wait_for(server.post("start", driver=name, name="", options={})["id"], "ended", "failed", "stopped")
        assert run["state"] == state and run["reason"].startswith(reason) and (reason or not run["reason"]), run
        assert run["healthy"] is (False if state == "failed" else None)
    first, second = (server.post("start", driver=name, name="", options={})["id"] for name in ("Long", "Gone"))
    running = server.wait_for(first, "running")
    assert running["reason"] == "" and server.get("run", id=second)["state"] == "waiting" and server.get("run", id=second)["reason"] == ""
    (drivers / "Gone" / "Gone").write_text("#!/no/such/shell\n")
    server.post("stop", id=first)
    assert server.wait_for(first, "stopped", "failed")["state"] == "stopped"
    assert "cannot be started: No such file" in server.wait_for(second, "failed", "ended")["reason"]


def test_runs_from_outside_the_repository_say_how_they_ended(serve, root):
    """They have a name and an output, and no RunSummary."""
    for kind, code in (("ends", 0), ("warned", 0), ("fails", 1), ("killed", -9)):
        (root / kind).mkdir()
        assert subprocess.run([os.environ["PENDULAR_VIEW_FRAMES"], "outside", str(root / kind), kind]).returncode == code
    server = serve()
    ends, warned, fails, killed = (server.get("run", id=f"{kind}/run") for kind in ("ends", "warned", "fails", "killed"))
    assert ends["state"] == "ended" and ends["healthy"] and ends["reason"] == "" and ends["grains"] == 1
    assert ends["time"] == ends["endTime"] == pytest.approx(1e-6, rel=1e-9)
    assert warned["state"] == "ended" and not warned["healthy"] and "2.5 kg/m^3" in warned["complaints"][0]
    assert fails["state"] == "failed" and "moves at" in fails["reason"]
    assert killed["state"] == "silent" and "killed" in killed["reason"]


def test_a_driver_that_could_not_say_its_options_is_asked_again(serve, root, tmp_path):
    drivers = tmp_path / "programs"
    driver_of(drivers, "Late", (f"[ -e {tmp_path}/ready ] || exit 1", ""))
    server = serve("--drivers", str(drivers))
    assert server.get("drivers") == []
    (tmp_path / "ready").touch()
    end = time.time() + 30
    while [driver["driver"] for driver in server.get("drivers")] != ["Late"]:
        assert time.time() < end
        time.sleep(0.5)


def test_the_form_is_checked_by_the_drivers_own_description(serve, root):
    server = serve()
    drivers = {description["driver"]: description for description in server.get("drivers")}
    options = {option["name"]: option for option in drivers["RotatingDrum"]["options"]}
    assert options["--end-time-s"]["default"] == "5" and options["--end-time-s"]["unit"] == "s" and options["--end-time-s"]["type"] == "number"
    assert options["--number"]["type"] == "count" and options["--number"]["excludes"] == ["--grains"]
    assert options["--threads"]["range"] == {"lowest": 1, "highest": 4096, "lowestIncluded": True, "highestIncluded": True}
    for wrong, words in (({"--none": "1"}, "has no option"), ({"--end-time-s": "long"}, "is no number"), ({"--number": "1.5"}, "is no whole number"),
                         ({"--number": "-1"}, "is no whole number"), ({"--threads": "0"}, "threads"), ({"--output": "/tmp"}, "cannot be given"),
                         ({"--grains": "/etc/passwd"}, "cannot be given"), ({"--restart": "x"}, "cannot be given"), ({"--resume": "true"}, "cannot be given"),
                         ({"--end-time-s": "1\n2"}, "no text"), ({"--end-time-s": 1}, "must be a text"), ({"--end-time-s": "1" * 1000}, "longer than")):
        assert words in refusal(server, "start", driver="RotatingDrum", name="", options=wrong), wrong
    # What the driver refuses when it starts is refused before: not-a-number, infinity, what is out of the range of a usual option.
    for option, value, words in (("--end-time-s", "nan", "not a finite number"), ("--end-time-s", "-1", "out of range"), ("--end-time-s", "inf", "not a finite number"),
                                 ("--interval-s", "0", "out of range"), ("--interval-s", "NaN", "not a finite number"), ("--number", "0", "out of range"),
                                 ("--softening", "-2", "out of range"), ("--speed-rad/s", "nan", "not a finite number"), ("--energy-interval-s", "-1", "out of range"),
                                 ("--end-time-s", "1e999", "no number")):
        for path in ("check", "start"):
            assert words in refusal(server, path, driver="RotatingDrum", name="new", options={option: value}), (path, option, value)
    for name in ("../x", "a/b", ".x", "a b", "x" * 200, "-", "a;b"):
        if name == "-":
            continue
        assert "cannot be that of a folder" in refusal(server, "start", driver="RotatingDrum", name=name, options={}), name
    (root / "there").mkdir()
    assert "is there already" in refusal(server, "start", driver="RotatingDrum", name="there", options={})
    assert "not under way" in refusal(server, "stop", id="nobody/run")
    assert "was started from this page" in refusal(server, "resume", id="nobody/run")
    assert "is there already" in refusal(server, "check", driver="RotatingDrum", name="there", options={})
    assert "is no number" in refusal(server, "check", driver="RotatingDrum", name="new", options={"--end-time-s": "x"})
    assert server.post("check", driver="RotatingDrum", name="new", options=DRUM) == {"told": "It can start."}
    assert sorted(path.name for path in root.iterdir()) == ["there"]


def test_every_driver_describes_what_its_help_says():
    """All that are built, against the help that a person reads: each option with its default."""
    seen = 0
    for program in sorted(DRIVERS.glob("*/*")):
        if program.parent.name != program.name or not os.access(program, os.X_OK):
            continue
        told = json.loads(subprocess.run([program, "--describe-options"], check=True, capture_output=True, text=True).stdout)
        text = subprocess.run([program, "--help"], check=True, capture_output=True, text=True).stdout
        names = {word.split(",")[0].split("=")[0].split()[0] for line in text.splitlines() for word in [line.strip()] if word.startswith("--")}
        described = {option["name"] for option in told["options"]}
        assert names - {"--describe-options"} == described, program.name
        for option in told["options"]:
            says_path = re.search(r"\bfile\b|^folder for ", option["text"]) and option["type"] == "text"
            assert option["path"] == bool(says_path), (program.name, option)
            assert option["text"] and option["type"] in ("number", "whole", "count", "text", "flag")
            if option["default"]:
                first = option["default"].split(",")[0]  # CLI11 2.3 writes =3000 or =[1,2], 2.4 writes [3000] or [[1,2]]
                assert re.search(rf"(=\[?|\[){re.escape(first)}", text), (program.name, option)
        seen += 1
    assert seen > 0
