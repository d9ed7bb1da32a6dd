"""Prints what VTK's own reader finds in a .vtp or .pvtp file: time, points, cells, fields, as words."""
import sys

import vtk

reader = vtk.vtkXMLPPolyDataReader() if sys.argv[1].endswith(".pvtp") else vtk.vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
observed = []
reader.AddObserver("ErrorEvent", lambda *_: observed.append("error"))
reader.Update()
data = reader.GetOutput()
if observed:
    sys.exit("VTK reports an error")

time = data.GetFieldData().GetArray("TimeValue")
words = [repr(time.GetValue(0)) if time else 0.0, data.GetNumberOfPoints()]
for k in range(data.GetNumberOfPoints()):
    words += [repr(x) for x in data.GetPoint(k)]
words.append(data.GetNumberOfCells())
ids = vtk.vtkIdList()
for k in range(data.GetNumberOfCells()):
    data.GetCellPoints(k, ids)
    words.append(ids.GetNumberOfIds())
    words += [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
for fields in (data.GetPointData(), data.GetCellData()):
    for f in range(fields.GetNumberOfArrays()):
        array = fields.GetArray(f)
        words += [array.GetName(), array.GetNumberOfComponents()]
        words += [repr(array.GetValue(i)) for i in range(array.GetNumberOfValues())]
print(*words)
