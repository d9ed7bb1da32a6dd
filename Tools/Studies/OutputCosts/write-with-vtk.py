"""Writes frames that Tools/Studies/output-costs has left once more with VTK's own writer, with zlib, and prints rows
as it does: bytes, and the processor time of Write(), the least of fifteen.
usage: write-with-vtk.py FOLDER STEP_TIME_S"""
import os
import sys
import time

import vtk

folder, step_time = sys.argv[1], float(sys.argv[2])


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def write(data, raw):
    """Bytes, and seconds of a processor."""
    path = os.path.join(folder, "vtk.vtp")
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.SetCompressorTypeToZLib()  # at level 5, the standard
    writer.SetDataModeToAppended()
    if raw:
        writer.EncodeAppendedDataOff()
    before = time.process_time()
    assert writer.Write() == 1
    taken = time.process_time() - before
    size = os.path.getsize(path)
    os.remove(path)
    return size, taken


for contacts, source in (("no", "vtp-32"), ("yes", "vtp-32-contacts")):
    source = os.path.join(folder, source)
    parts = {name: read(os.path.join(source, name)) for name in os.listdir(source) if name.endswith(".vtp")}
    grains = next(data.GetNumberOfPoints() for name, data in parts.items() if "-particles-" in name)
    for raw, encoding in ((True, "raw"), (False, "base64")):
        tries = [[write(data, raw) for _ in range(15)] for data in parts.values()]
        size = sum(t[0][0] for t in tries)
        taken = sum(min(seconds for _, seconds in t) for t in tries)
        print(f"VTK {vtk.VTK_VERSION},vtp-32-{encoding},{contacts},{grains},{size},{taken:.4g},"
              f"{0.1 * taken / step_time:.3g}")
