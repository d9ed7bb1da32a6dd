"""Prints what VTK's own reader finds in a .vtp file: time, points, cells, fields, as words."""
import sys

import vtk

reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
observed = []
reader.AddObserver("ErrorEvent", lambda *_: observed.append("error"))
reader.Update()
data = reader.GetOutput()
if observed:
    sys.exit("VTK reports an error")

words = [repr(data.GetFieldData().GetArray("TimeValue").GetValue(0)), data.GetNumberOfPoints()]
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
