"""Prints what h5py finds in a series NAME-fields.h5: each frame's time, and each column with its unit, shape,
type, filters and numbers, as words."""
import sys

import h5py

with h5py.File(sys.argv[1], "r") as series:
    for step, time, name in zip(series["step"], series["time_s"], sorted(series["frames"])):
        frame = series["frames"][name]
        assert int(name) == step == frame.attrs["step"] and frame.attrs["time_s"] == time
        print("frame", name, repr(float(time)))
        columns = []
        frame.visititems(lambda path, item: columns.append(path) if isinstance(item, h5py.Dataset) else None)
        for path in sorted(columns):
            column = frame[path]
            unit = column.attrs.get("unit", b"-").decode().replace(" ", "_")
            packed = column.compression == "gzip" and column.shuffle or column.size == 0
            print(path, unit, column.dtype, "packed" if packed else "plain", column.ndim, *column.shape)
            print(*(repr(x) for x in column[...].ravel().tolist()))
