"""What others have left in the folders of runs costs an answer at most: deep JSON, frames that claim what is not there, frames that
need more memory than reading may take, and files at which the HDF5 library crashes."""
import gzip
import json
import os
import pathlib
import re
import struct
import time
import zlib

import pytest

DEEP = {
    "open": "[" * 10**5,
    "closed": "[" * 10**5 + "]" * 10**5,
    "objects": '{"driver":' * 9 * 10**5,
    "options": '{"driver": "RotatingDrum", "options": {"--number": ' + "[" * 10**5 + "]" * 10**5 + "}}",
    "names": '{"driver": "[[[{{{\\"[", "options": {"' + "[" * 1000 + '": "]"}}',  # not deep: brackets in texts
}


def refused(server, path):
    status, content, _ = server.ask(path)
    assert 400 <= status < 500, content
    assert content.decode().count("\n") == 1, content
    return content.decode()


def peak(server):
    """kB: the most that the server itself has taken."""
    with open(f"/proc/{server.process.pid}/status") as status:
        return int(re.search(r"VmHWM:\s+(\d+)", status.read())[1])


def test_json_of_any_depth_leaves_all_other_runs_visible(serve, write_frames, root):
    write_frames("picture", "good")
    for name, text in DEEP.items():
        (root / name).mkdir()
        (root / name / "view-start.json").write_text(text)
    server = serve()
    assert {run["id"] for run in server.get("runs")["runs"]} == {"good/run"} | {f"{name}/run" for name in DEEP}
    for name in DEEP:
        start = server.get("run", id=f"{name}/run")["start"]
        assert start == (json.loads(DEEP[name]) if name == "names" else None), name
    for body in ("[" * 60000, "[" * 30000 + "]" * 30000, '{"driver": "RotatingDrum", "options": ' + '{"a":' * 10000 + "1" + "}" * 10001):
        status, content, _ = server.ask("/api/start", "POST", body.encode())
        assert status == 400 and content.count(b"\n") == 1
    assert server.ask("/api/frame?id=good/run&frame=0")[0] == 200


def blocks_of_zeros(size):
    """As VTK packs them (vtkZLibDataCompressor): number of blocks, their size, that of the last one, packed sizes, blocks."""
    whole, rest = divmod(size, 1 << 17)
    packed = [zlib.compress(bytes(1 << 17))] * whole + ([zlib.compress(bytes(rest))] if rest else [])
    return struct.pack(f"<{3 + len(packed)}Q", len(packed), 1 << 17, rest, *map(len, packed)) + b"".join(packed)


def write_many_points(folder, count):
    """A frame that is whole: all that it claims is packed in it."""
    folder.mkdir()
    arrays, xml = b"", ""

    def array(kind, name, components, size):
        nonlocal arrays
        row = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="appended" offset="{len(arrays)}"/>\n'
        arrays += blocks_of_zeros(size)
        return row

    xml += f'<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">\n'
    xml += f'<PolyData>\n<Piece NumberOfPoints="{count}" NumberOfVerts="0" NumberOfLines="0" NumberOfPolys="0">\n'
    xml += f'<PointData>\n{array("Float32", "radius_m", 1, 4 * count)}</PointData>\n<Points>\n{array("Float64", "Points", 3, 24 * count)}</Points>\n'
    xml += '</Piece>\n</PolyData>\n<AppendedData encoding="raw">\n_'
    (folder / "run-particles-000000000.vtp").write_bytes(xml.encode() + arrays + b"\n</AppendedData>\n</VTKFile>\n")
    row = '<DataSet timestep="0" part="0" name="particles" file="run-particles-000000000.vtp"/>'
    (folder / "run.pvd").write_text(f"<VTKFile>\n{row}\n</VTKFile>\n")


def test_a_frame_that_needs_too_much_memory_is_a_sentence(serve, root):
    write_many_points(root / "few", 1000)
    write_many_points(root / "many", 6 * 10**6)  # 168 MB of numbers in 0.2 MB, and copies of them
    server = serve("--memory-MB", "200")
    assert server.ask("/api/frame?id=few/run&frame=0")[0] == 200
    before = server.memory()
    for _ in range(3):
        assert "needed more than 200 MB of memory" in refused(server, "/api/frame?id=many/run&frame=0")
    assert server.memory() < before + 20_000 and peak(server) < 200_000
    assert len(server.get("runs")["runs"]) == 2


def test_a_frame_that_claims_more_than_is_stored_takes_no_memory(serve, root):
    """The same points, in blocks that have a byte each; the file is long enough for all of them."""
    write_many_points(root / "claims", 6 * 10**6)
    frame, size = root / "claims" / "run-particles-000000000.vtp", 24 * 6 * 10**6
    count = -(-size // (1 << 17))
    empty = struct.pack(f"<{3 + count}Q", count, 1 << 17, size % (1 << 17), *[1] * count) + os.urandom(size // 500)
    content = frame.read_bytes()
    assert blocks_of_zeros(size) in content
    frame.write_bytes(content.replace(blocks_of_zeros(size), empty))
    server = serve()
    assert "has data of the wrong size" in refused(server, "/api/frame?id=claims/run&frame=0") and peak(server) < 100_000


def test_a_field_whose_name_is_no_utf8(serve, root):
    write_many_points(root / "few", 10)
    frame = root / "few" / "run-particles-000000000.vtp"
    content = frame.read_bytes()
    row = re.search(rb"<DataArray [^\n]*radius_m[^\n]*\n", content)[0]
    frame.write_bytes(content.replace(row, row + row.replace(b"radius_m", b"f\xe9_m")))
    server = serve()
    for path in ("row?id=few/run&frame=0&of=grains&row=0", "frame?id=few/run&frame=0"):
        status, content, _ = server.ask(f"/api/{path}")
        assert status == 200, content


def test_a_summary_of_any_length_takes_no_memory(serve, root):
    texts = {"short": "grains,1,\n", "long": "grains,1,\n" * 10**6, "many": "".join(f"{k},1,J\n" for k in range(9 * 10**4)) + "grains,2,\n"}
    for name, rows in texts.items():
        (root / name).mkdir()
        (root / name / "run-summary.csv").write_text("quantity,value,unit\n" + rows)
    server = serve()
    assert server.get("run", id="short/run")["grains"] == 1
    assert server.get("run", id="long/run")["rows"] == []
    before = time.monotonic()
    assert {run["id"]: run["grains"] for run in server.get("runs")["runs"]} == {"short/run": 1, "long/run": None, "many/run": 2}
    assert time.monotonic() - before < 5  # as its rows, not as their square, which took 13 s of an idle machine
    assert peak(server) < 100_000


def shared(name):
    path = pathlib.Path(os.environ.get("PENDULAR_SHARED_DIR", "")) / "data/damaged" / name
    if not path.exists():
        pytest.skip(f"The reference data {path} is not there: this is NOT tested.")
    return path


def sealed(content):
    """As a restart file of today's format, with the checksum of what it has (Kernel/Foundation/State/RestartFile.cpp)."""
    header = pathlib.Path(__file__).parents[2] / "Kernel/Foundation/State/RestartFile.h"
    form = re.search(r"restartFormat = (\d+)", header.read_text())[1]
    checksum, rest = 0xcbf29ce484222325, content[512:]
    for (word,) in struct.iter_unpack("<Q", rest + bytes(-len(rest) % 8)):
        checksum = (checksum ^ word) * 0x100000001b3 % 2**64
    return f"Pendular restart file\nformat {form}\nbytes {len(content)}\nchecksum {checksum:016x}\n".encode().ljust(512, b"\0") + rest


def test_a_restart_file_at_which_the_library_crashes(serve, root):
    content = sealed(gzip.decompress(shared("restart-hdf5-crash.h5.gz").read_bytes()))
    (root / "crash").mkdir()
    (root / "crash" / "run-restart.h5").write_bytes(content)
    server = serve()
    assert server.get("run", id="crash/run")["frames"] == [None]
    assert "run-restart.h5" in refused(server, "/api/frame?id=crash/run&frame=0")
    assert [run["id"] for run in server.get("runs")["runs"]] == ["crash/run"]


def test_a_frame_with_one_changed_byte(serve, write_frames, root):
    content = shared("frame-one-byte.h5").read_bytes()
    write_frames("hdf5", "hdf5")
    (root / "hdf5" / "run-fields-000000000.h5").write_bytes(content)
    server = serve()
    before = server.memory()
    for _ in range(3):
        assert "particles/body" in refused(server, "/api/frame?id=hdf5/run&frame=0")
    assert server.memory() < before + 20_000 and peak(server) < 200_000
