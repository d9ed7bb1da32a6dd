"""Who may ask the server of `view`, and what it bears: wrong hosts, tokens and pages, paths that lead out of its folder,
bodies, heads and connections without end."""
import json
import os
import shutil
import signal
import socket
import subprocess
import time
import urllib.parse

import pytest
from conftest import Server, driver_of

START = json.dumps({"driver": "RotatingDrum", "name": "", "options": {}}).encode()


def refused(server, path, method="GET", body=None, **headers):
    status, content, _ = server.ask(path, method, body, **headers)
    assert 400 <= status < 500, (path, method, headers, status, content)
    return status, content.decode()


@pytest.fixture
def served(serve, write_frames, tmp_path):
    write_frames("picture", "wet")
    (tmp_path / "secret.csv").write_text("time_s,secret\n1,2\n")
    return serve()


def test_the_token_becomes_a_cookie_that_scripts_do_not_see(served):
    status, content, headers = served.ask(f"/?token={served.token}", Cookie=None)
    assert status == 200 and b'content="0; url=."' in content and served.token.encode() not in content
    assert headers["Set-Cookie"].startswith(served.cookie + ";")
    assert "HttpOnly" in headers["Set-Cookie"] and "SameSite=Strict" in headers["Set-Cookie"]
    assert served.ask("/")[0] == 200
    for run, word in (("wet/run", "wet%2Frun"), ("\"><script>&", "%22%3E%3Cscript%3E%26"), ("", "")):
        content = served.ask(f"/?token={served.token}&run={urllib.parse.quote(run, safe='')}", Cookie=None)[1].decode()
        assert f'content="0; url=.{"#run=" if run else ""}{word}"' in content and "<script>" not in content
    policy = served.ask("/")[2]["Content-Security-Policy"]
    assert "default-src 'none'" in policy and "frame-ancestors 'none'" in policy and "unsafe" not in policy


def test_in_a_package_it_finds_page_and_drivers(root, tmp_path):
    """Programs of a package are in one folder, lib/.../pendular/LEVEL; the page and the names of the drivers in share/pendular."""
    own, shared = tmp_path / "usr/lib/x/pendular/level", tmp_path / "usr/share/pendular"
    own.mkdir(parents=True)
    (shared / "ViewPage").mkdir(parents=True)
    for name in ("index.html", "main.js"):
        (shared / "ViewPage" / name).write_text(f"of the package: {name}")
    shutil.copy(os.environ["PENDULAR_VIEW"], own / "view")
    for name in ("Drum", "NoDriver", "NotListed"):
        driver_of(tmp_path / "made", name, ("", "echo done")).rename(own / name)
    (shared / "drivers.txt").write_text("Drum\nGone\n")
    server = Server(root, page=None, program=own / "view")
    assert server.ask("/")[1] == b"of the package: index.html"
    assert [driver["driver"] for driver in server.get("drivers")] == ["Drum"]
    refused(server, "/api/start", "POST", json.dumps({"driver": "NotListed"}).encode())
    run = server.post("start", driver="Drum", name="", options={})["id"]
    server.wait_for(run, "ended")
    server.end()


def test_it_ends_with_its_input(root):
    for ends in (lambda server: server.process.stdin.close(), lambda server: server.process.send_signal(signal.SIGTERM)):
        server = Server(root, "--end-with-input", stdin=subprocess.PIPE)
        server.process.stdin.write("anything\n")
        server.process.stdin.flush()
        time.sleep(0.5)
        assert server.ask("/")[0] == 200
        ends(server)
        assert server.process.wait(20) == 0


def test_it_is_known_by_the_names_that_it_was_given(serve):
    server = serve("--listen", "127.0.0.2", "--host-name", "Cluster.Example", "--frame-of", "http://LOCALHOST:8888")
    assert server.address.startswith(f"http://localhost:{server.port}/")  # of the notebook's site, or its cookie is kept back
    for host in (f"127.0.0.2:{server.port}", "cluster.example", "CLUSTER.EXAMPLE:443"):
        assert server.ask("/api/runs", Host=host, at="127.0.0.2")[0] == 200, host
    assert server.ask("/api/runs", Host="example", at="127.0.0.2")[0] == 403


def test_strangers_are_refused(served):
    other = "0" * 32
    name = served.cookie.split("=")[0]
    for headers in ({"Cookie": None}, {"Cookie": f"{name}={other}"}, {"Cookie": f"{name}="}, {"Cookie": f"{name}={served.token}0"},
                    {"Cookie": f"other={served.token}"}, {"Host": "evil.example"}, {"Host": f"evil.example:{served.port}"},
                    {"Host": None}, {"Host": ""}, {"Host": f"127.0.0.1.evil.example:{served.port}"}, {"Host": "localhost:80:80"},
                    {"Host": "localhost@evil.example"}, {"Host": "a" * 1000}):
        for path in ("/", "/api/runs", "/api/frame?id=wet/run&frame=0"):
            refused(served, path, **headers)
    refused(served, f"/?token={other}", Cookie=None)
    refused(served, f"/?token={served.token}&x=1", Cookie=None, Host="evil.example")


def test_only_the_own_page_changes_something(served, root):
    before = sorted(root.iterdir())
    for headers in ({"Origin": None}, {"Origin": "null"}, {"Origin": "http://evil.example"}, {"Origin": f"http://127.0.0.1:{served.port + 1}"},
                    {"X_Pendular": None}, {"Content_Type": "text/plain"}, {"Content_Type": None}, {"Content_Type": "application/x-www-form-urlencoded"},
                    {"Cookie": None}, {"Host": "evil.example"}):
        for path in ("/api/start", "/api/stop", "/api/resume"):
            refused(served, path, "POST", START, **headers)
    for method in ("PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "HEAD", "CONNECT", "XYZ"):
        status, _, _ = served.ask("/api/start", method, START)
        assert status == 405, method
    for path in ("/api/start", "/api/stop?id=wet/run", "/api/resume"):
        refused(served, path)
    assert sorted(root.iterdir()) == before


def test_no_path_leads_out_of_the_folder(served, root, tmp_path):
    os.symlink(tmp_path, root / "link")
    os.symlink(tmp_path / "secret.csv", root / "wet" / "linked.csv")
    os.symlink(tmp_path, root / "wet" / "run-link")
    (tmp_path / "secret-summary.csv").write_text("quantity,value,unit\nstate,at its end,\n")
    hidden = root / ".hidden"
    hidden.mkdir()
    (hidden / "run-summary.csv").write_text("quantity,value,unit\nstate,at its end,\n")
    ids = ["../secret", "link/secret", ".hidden/run", "wet/../../secret", "/etc/passwd", "wet//run", "wet/./run", "", ".", "..",
           "wet/run/", "%2e%2e/secret", "wet/run%00", "wet\\run", "a" * 5000, "x/" * 20 + "run"]
    for run in ids:
        refused(served, f"/api/run?id={run}")
        refused(served, f"/api/frame?frame=0&id={run}")
    for table in ("../secret.csv", "linked.csv", "/etc/passwd", "run-summary.csv", "", "..", "view-start.json", "wet/run.pvd"):
        refused(served, f"/api/table?id=wet/run&name={table}")
    for path in ("/../secret.csv", "/main.js/../../secret.csv", "/%2e%2e/secret.csv", "//etc/passwd", "/etc/passwd", "/src/main.js", "/index.html%00"):
        refused(served, path)
    assert [run["id"] for run in served.get("runs")["runs"]] == ["wet/run"]


def test_a_series_that_names_files_elsewhere_shows_none_of_them(served, root, tmp_path):
    evil = root / "evil"
    evil.mkdir()
    for name in ("run-particles-000000000.vtp", "linked.vtp"):
        (tmp_path / name).write_bytes((root / "wet" / "run-particles-000000000.vtp").read_bytes())
    os.symlink(tmp_path / "linked.vtp", evil / "run-particles-000000001.vtp")
    files = [f"{tmp_path}/run-particles-000000000.vtp", "../../run-particles-000000000.vtp", "run-particles-000000001.vtp"]
    rows = "".join(f'<DataSet timestep="{k}" name="particles" file="{file}"/>\n' for k, file in enumerate(files))
    (evil / "run.pvd").write_text(f"<VTKFile>\n{rows}</VTKFile>\n")
    assert served.get("run", id="evil/run")["frames"] == []


def test_words_that_are_no_numbers_fields_or_json(served):
    for words in ("frame=1", "frame=-1", "frame=", "frame=0x0", "frame=0&field=none", "frame=0&field=velocity_m_per_s.w", "frame=0&origin=1,2",
                  "frame=99999999999999999999", "frame=0&field=" + "a" * 3000, "frame=0&origin=a,b,c"):
        refused(served, f"/api/frame?id=wet/run&{words}")
    for row in ("-1", "1000", "x"):
        refused(served, f"/api/row?id=wet/run&frame=0&of=grains&row={row}")
    for body in (b"", b"[]", b"{", b"null", b'"x"', b"{" * 60000, b'{"driver": 1}', b'{"driver": "../../bin/sh"}', b'{"driver": "Nobody"}',
                 b'{"driver": "RotatingDrum", "options": []}', b'{"driver": "RotatingDrum", "options": {"--output": "/tmp/x"}}', b"\xff\xfe\x00"):
        refused(served, "/api/start", "POST", body)


def test_frames_that_no_run_writes_are_refused_in_one_sentence(serve, write_frames):
    server = serve()
    for kind, words in (("lines", "no line between two points"), ("ends", "no line between two points"), ("identity", "more than one number each")):
        run = write_frames("damaged", kind, kind)
        _, told = refused(server, f"/api/frame?id={run}&frame=0&contacts=1")
        assert words in told and told.count(".\n") == 1, told
    assert server.ask("/api/runs")[0] == 200


def test_waiting_for_the_server_itself_takes_nobody_s_time(serve, tmp_path):
    """Two drivers that think for longer than a sender has: five who ask for them are all answered, and so is the list."""
    for name in ("One", "Two"):
        driver_of(tmp_path / "programs", name, ("sleep 6", ""))
    server = serve("--drivers", str(tmp_path / "programs"))
    head = f"Host: 127.0.0.1:{server.port}\r\nCookie: {server.cookie}\r\n\r\n"
    asking = [socket.create_connection(("127.0.0.1", server.port), timeout=60) for _ in range(5)]
    for connection in asking:
        connection.sendall(f"GET /api/drivers HTTP/1.1\r\n{head}".encode())
    time.sleep(1)
    with socket.create_connection(("127.0.0.1", server.port), timeout=60) as late:  # all who compute are busy
        late.sendall(f"GET /api/runs HTTP/1.1\r\n{head}".encode())
        assert late.recv(100).startswith(b"HTTP/1.1 200")
    for connection in asking:
        assert connection.recv(100).startswith(b"HTTP/1.1 200")
        connection.close()


def send(server, text, wait=5):
    """What a bare connection hears."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=wait) as connection:
        heard = b""
        try:
            connection.sendall(text)
            while True:
                more = connection.recv(65536)
                if not more:
                    return heard
                heard += more
        except OSError:
            return heard


def test_bodies_and_heads_are_bounded(served):
    before = served.memory()
    status, _ = refused(served, "/api/start", "POST", b" " * 100000)
    assert status == 413
    host = f"Host: localhost:{served.port}\r\nCookie: {served.cookie}\r\n".encode()
    for text in (b"GET / HTTP/1.1\r\n" + host + b"X: " + b"a" * 100000 + b"\r\n\r\n", b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n" + host + b"\r\n",
                 b"GET / HTTP/1.1\r\n" + host + b"".join(b"X%d: y\r\n" % k for k in range(20000)) + b"\r\n", b"\x00" * 1000, b"\r\n" * 10000,
                 b"GET / HTTP/1.1\r\n" + host + b"Content-Length: -5\r\n\r\n", b"POST /api/start HTTP/1.1\r\n" + host + b"Transfer-Encoding: chunked\r\n\r\nFFFFFFFFFFFFFFFFF\r\n"):
        heard = send(served, text, wait=12)
        assert b" 200 " not in heard.split(b"\r\n")[0], text[:60]
    assert served.memory() - before < 5000
    assert served.ask("/")[0] == 200


def test_slow_senders_are_cut_off_and_a_thousand_connections_borne(served):
    served.get("runs")
    before, begin = served.memory(), time.time()
    connections = []
    for _ in range(1000):
        connection = socket.socket()
        connection.setblocking(False)
        connection.connect_ex(("127.0.0.1", served.port))
        connections.append(connection)
    slow = connections[:150]

    def is_closed(connection):
        try:
            return connection.recv(100) == b""
        except BlockingIOError:
            return False
        except OSError:
            return True

    # A sign each second, never to the end of the head. They are cut off after 10 s; a busy machine may take longer.
    while time.time() - begin < 13 or (time.time() - begin < 120 and not all(map(is_closed, slow))):
        for connection in slow:
            try:
                connection.send(b"G" if time.time() - begin < 1.5 else b"E")
            except OSError:
                pass
        time.sleep(1)
    assert all(map(is_closed, slow))
    assert served.memory() - before < 5000
    for connection in connections:
        connection.close()
    assert served.ask("/api/runs")[0] == 200
