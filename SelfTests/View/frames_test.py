"""What the server gives to be drawn: frames for ParaView and of HDF5 files, droplets, and maps of fields of coarse graining."""
import json
import math
import struct
import urllib.parse

import pytest


def columns(server, path, **words):
    """The text and the columns of an answer (Tools/View/Columns.h)."""
    status, content, _ = server.ask(f"/api/{path}?{urllib.parse.urlencode(words)}")
    assert status == 200, content
    length = struct.unpack_from("<I", content)[0]
    head = json.loads(content[4:4 + length])
    for column in head["columns"]:
        head[column["name"]] = struct.unpack_from(f"<{column['count']}f", content, 4 + length + column["begin"])
    return head


def refused(server, path, **words):
    status, content, _ = server.ask(f"/api/{path}?{urllib.parse.urlencode(words)}")
    assert 400 <= status < 500, content
    return content.decode()


def test_hdf5_frames_are_as_those_for_paraview(serve, write_frames):
    write_frames("picture", "plain")
    write_frames("hdf5", "hdf5")
    server = serve()
    assert [run["id"] for run in server.get("runs")["runs"]] and server.get("run", id="hdf5/run")["frames"] == [0, 0.5]
    for field in ("velocity_m_per_s", "velocity_m_per_s.z", "radius_m"):
        plain = columns(server, "frame", id="plain/run", frame=0, field=field, contacts=1, wallField="wear_depth_m")
        hdf5 = columns(server, "frame", id="hdf5/run", frame=1, field=field, contacts=1, wallField="wear_depth_m")
        assert plain["droplets"] == pytest.approx((1.5e-3, -2e-3, 1.5e-3, 3e-4))  # from the middle of the grains
        assert plain["wallValue"] == pytest.approx([0, 0, 2e-6, 2e-6]) and [field["name"] for field in plain["wallFields"]] == ["wall", "wear_depth_m"]
        for name in ("value", "walls", "wallValue", "bridges", "contacts", "droplets", "origin", "low", "high"):
            assert hdf5[name] == pytest.approx(plain[name], rel=1e-6, abs=1e-9), name
        assert [abs(x) for x in hdf5["grains"]] == pytest.approx([abs(x) for x in plain["grains"]], rel=1e-6, abs=1e-9)
        assert hdf5["time"] == 0.5 and hdf5["grains"][51] > 0 > plain["grains"][51]  # the cube is a ball there
    assert not {"droplets", "wallValue"} & set(columns(server, "frame", id="hdf5/run", frame=0, droplets=0))
    assert columns(server, "frame", id="hdf5/run", frame=0, wallField="none")["wallValue"] == ()
    for of, row in (("grains", 8), ("contacts", 0)):
        plain = {field["name"]: field["value"] for field in server.get("row", id="plain/run", frame=0, of=of, row=row)["fields"]}
        assert plain == {field["name"]: field["value"] for field in server.get("row", id="hdf5/run", frame=0, of=of, row=row)["fields"]}


def test_a_frame_that_is_none_is_refused(serve, write_frames, root):
    write_frames("hdf5", "hdf5")
    server = serve()
    good = (root / "hdf5/run-fields-000000000.h5").read_bytes()
    for bad in (b"", good[:3000], b"\x89HDF\r\n\x1a\n" + b"\0" * 500, (root / "hdf5/run-fields.h5").read_bytes()):
        (root / "hdf5/run-fields-000000000.h5").write_bytes(bad)
        assert refused(server, "frame", id="hdf5/run", frame=0).count(".\n") == 1
    (root / "hdf5/run-fields.h5").write_bytes(b"no list")
    assert server.get("run", id="hdf5/run")["frames"] == [] and "run-fields.h5" in server.get("run", id="hdf5/run")["frameProblem"]
    assert server.ask("/api/runs")[0] == 200


def gauss(x):
    return math.exp(-x * x / (2 * 3e-3 ** 2))


def test_maps_are_fields_of_one_grain(serve, write_frames):
    """The kernel is a Gauss function (width 3 mm, cut off at 3 widths): a field falls with it from point to point."""
    write_frames("fields", "one")
    server = serve()
    assert [run["id"] for run in server.get("runs")["runs"]] == ["one/run"]  # the series of fields is no run of its own
    run = server.get("run", id="one/run")
    assert run["maps"] == [{"name": "run-coarse.pvd", "times": [0, 0.1]}, {"name": "run-space.h5", "times": [0, 0.1]}]
    density = columns(server, "map", id="one/run", name="run-coarse.pvd", frame=1, field="density_kg_per_m3")
    places = [1e-3 * (2 * k + 1) for k in range(10)]
    for axis, name in ((density["across"], "x"), (density["up"], "z")):
        assert axis["name"] == name and axis["places"] == pytest.approx(places)
    assert density["normal"]["name"] == "y" and len(density["normal"]["places"]) == 1 and len(density["value"]) == 100
    highest = density["value"][3 * 10 + 5]  # at x = 11 mm, z = 7 mm, where the grain is
    # A Gauss in two directions, over the length of the third one; the part beyond the cut-off is 1 %.
    assert highest == pytest.approx(1e-3 / (2 * math.pi * 3e-3 ** 2 * 0.02), rel=0.02)
    for row in range(10):
        for column in range(10):
            away = math.hypot(places[column] - 0.011, places[row] - 0.007)
            share = density["value"][10 * row + column] / highest
            assert share == pytest.approx(gauss(away) if away < 9e-3 else 0, rel=1e-5, abs=1e-7)

    middle = columns(server, "map", id="one/run", name="run-space.h5", frame=1, field="velocity_m_per_s.z")
    assert middle["slice"] == 5 and middle["normal"]["places"][5] == pytest.approx(0.011)
    for words, value in (({"frame": 0}, 0), ({"frame": 1}, 2), ({"frame": 1, "field": "velocity_m_per_s.x"}, 0), ({"frame": 1, "field": "velocity_m_per_s"}, 2),
                         ({"frame": 1, "field": "momentum_kg_per_m2s", "normal": 2, "slice": 3}, None)):
        found = columns(server, "map", **{"id": "one/run", "name": "run-space.h5", "field": "velocity_m_per_s.z", **words})
        inside = [v for v in found["value"] if not math.isnan(v)]
        assert 0 < len(inside) <= 100
        if value is not None:
            assert inside == pytest.approx([value] * len(inside), abs=1e-6)
        else:
            assert (found["across"]["name"], found["up"]["name"], found["normal"]["name"]) == ("x", "y", "z")
            assert found["value"].index(max(found["value"])) == 4 * 10 + 5  # y = 9 mm, x = 11 mm
    # The grain goes straight up: all of j_z j_z / rho is in the flow, and the pressure is the mean of the diagonal.
    stress = [columns(server, "map", id="one/run", name="run-space.h5", frame=1, field=f"kinetic_stress_Pa{part}")["value"] for part in ("", ".xx", ".yy", ".zz")]
    for mean, *parts in zip(*stress):
        assert math.isnan(mean) or mean == pytest.approx(sum(parts) / 3, abs=1e-6)

    for words, told in (({"field": "none"}, "has no field 'none'"), ({"field": "density_kg_per_m3.x"}, "no part x"), ({"field": "velocity_m_per_s.q"}, "no part q"),
                        ({"field": "velocity_m_per_s.xx"}, "no part xx"), ({"slice": 10}, "no such slice"), ({"normal": 3}, "0, 1 or 2"), ({"frame": 2}, "no such map"),
                        ({"name": "run-restart.h5"}, "no such map"), ({"name": "../x.pvd"}, "no such map"), ({"frame": "x"}, "whole number"), ({"slice": "-1"}, "whole number")):
        assert told in refused(server, "map", **{"id": "one/run", "name": "run-space.h5", "frame": 0, **words}), words
    table = server.get("table", id="one/run", name="run-line.csv")
    assert table["columns"][:3] == ["time_s", "z_m", "number_density_per_m3"] and len(table["rows"]) == 20
