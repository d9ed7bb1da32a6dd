"""Reading what runs have written, and pictures of scenes."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Optional, Tuple, Union

import numpy as np

from . import _kernel

if TYPE_CHECKING:
    import pandas

Path = Union[str, "os.PathLike[str]"]
Columns = Dict[str, np.ndarray]


# HDF5 files are read by the kernel, in a process of its own: the library itself crashes on some damaged ones.
def _existing(file: Path) -> str:
    if not os.path.isfile(file):
        raise _kernel.InputError(f"There is no file {os.fspath(file)}.")
    return os.fspath(file)


def _numbers(numbers: np.ndarray) -> np.ndarray:
    """As the arrays of a scene are: tensors are 3 x 3, single columns have one axis."""
    if numbers.shape[1] == 1:
        return numbers[:, 0]
    return numbers.reshape(-1, 3, 3) if numbers.shape[1] == 9 else numbers


def _columns(file: str, part: str) -> Columns:
    """Those of a part of a frame."""
    begin = f"{part}/"
    tables = _kernel._read_tables(_existing(file), begin)
    columns = {name[len(begin):]: _numbers(table) for name, table in tables.items() if isinstance(table, np.ndarray)}
    if not columns:
        parts = sorted({name.split("/")[0] for name in _kernel._table_names(file)})
        raise _kernel.InputError(f"The frame {file} has no {part}; it has {', '.join(parts)}.")
    return columns


def frames(file: Path, part: str = "particles") -> Iterator[Tuple[float, Columns]]:
    """The time (s) and the columns of each frame of NAME-fields.h5 (write_hdf5()), by the names that Scene.grains() has.

    file: its name; the frames are NAME-fields-STEP.h5 beside it. part: particles, contacts, walls or droplets; of files of
    write_fields(hdf5=True): fields. Raises InputError.
    """
    for time, frame in _kernel._frame_list(_existing(file)):
        yield time, _columns(os.fspath(frame), part)


def table(file: Path) -> pandas.DataFrame:
    """A table of a run (a file NAME-energy.csv, ...) with the units in the names of its columns."""
    import pandas

    if not os.path.isfile(file):
        raise _kernel.InputError(f"There is no file {os.fspath(file)}.")
    try:
        return pandas.read_csv(file)
    except (UnicodeDecodeError, pandas.errors.ParserError, pandas.errors.EmptyDataError) as problem:
        raise _kernel.InputError(f"{os.fspath(file)} is no table of numbers with commas between them.") from problem


def restart(file: Path) -> Columns:
    """All tables of a restart file, by their names: "particles/translation", ... (the page on output lists them)."""
    return _kernel._read_tables(_existing(file), "")


def draw(scene: _kernel.Scene, color: Union[str, np.ndarray, None] = None, *, along: str = "y",
         axes: Optional[Any] = None, colormap: str = "viridis", walls: bool = True) -> Any:
    """Draws the grains of a scene as discs by matplotlib, as seen along an axis, those in front last; returns the axes.

    color: the name of a column of grains() (a vector is taken by its length), or a number for each grain, shown by
    colormap. axes: those of matplotlib to draw into; else a new figure has them. walls: as lines, behind the grains. A
    grain that is no sphere is the disc of the ball around it.
    """
    import matplotlib.pyplot as plt
    from matplotlib.collections import EllipseCollection, PolyCollection

    if not isinstance(scene, _kernel.Scene):
        raise TypeError(f"draw(): scene = {scene!r} must be a Scene.")
    if along not in ("x", "y", "z"):
        raise _kernel.InputError(f"draw() looks along 'x', 'y' or 'z'; not {along!r}.")
    across, up = {"x": (1, 2), "y": (0, 2), "z": (0, 1)}[along]
    depth = 3 - across - up
    columns = scene.grains()
    place, radius = columns["position_m"], columns["radius_m"]
    values, label = _colors(columns, color)
    front = np.argsort(place[:, depth] if along != "y" else -place[:, depth], kind="stable")
    if axes is None:
        axes = plt.subplots()[1]
    width = 2 * radius[front]
    discs = EllipseCollection(width, width, np.zeros(len(front)), units="xy", offsets=place[front][:, [across, up]],
                              transOffset=axes.transData, array=values[front], cmap=colormap, edgecolors="k",
                              linewidths=0.3)
    axes.add_collection(discs)
    shown = [place - radius[:, None], place + radius[:, None]]
    if walls:
        polygons = _polygons(scene)
        corners = [polygon[:, [across, up]] for polygon in polygons]
        axes.add_collection(PolyCollection(corners, facecolors="none", edgecolors="0.6", linewidths=0.5, zorder=0))
        shown += polygons
    axes.set(aspect="equal", xlabel=f"{'xyz'[across]} (m)", ylabel=f"{'xyz'[up]} (m)")
    if len(front):
        points = np.concatenate(shown)
        low, high = points.min(0), points.max(0)
        axes.set(xlim=(low[across], high[across]), ylim=(low[up], high[up]))
    if color is not None:
        axes.figure.colorbar(discs, ax=axes, label=label)
    return axes


def _polygons(scene: _kernel.Scene) -> List[np.ndarray]:
    """Those of the walls, N x 3 corners (m) each."""
    made = scene.wall_polygons()
    return np.split(made["points_m"], made["ends"][:-1]) if len(made["ends"]) else []


def _colors(columns: Columns, color: Union[str, np.ndarray, None]) -> Tuple[np.ndarray, str]:
    count = len(columns["radius_m"])
    if color is None:
        return np.zeros(count), ""
    if isinstance(color, str):
        if color not in columns:
            raise _kernel.InputError(f"Grains have no column {color!r}; they have {', '.join(columns)}.")
        values = columns[color]
        return np.sqrt((values**2).sum(axis=tuple(range(1, values.ndim)))) if values.ndim > 1 else values, color
    values = np.asarray(color, float)
    if values.shape != (count,):
        raise _kernel.InputError(f"color must be a number for each of {count} grains; it has the shape {values.shape}.")
    return values, ""


def to_pyvista(scene: _kernel.Scene) -> Any:
    """The grains as points of pyvista, with all their columns; scene.glyph(scale="diameter_m") draws spheres."""
    import pyvista

    columns = scene.grains()
    points = pyvista.PolyData(columns.pop("position_m"))
    for name, values in columns.items():
        points[name] = values.reshape(len(values), -1) if values.ndim > 1 else values
    points["diameter_m"] = 2 * columns["radius_m"]
    return points


def walls_to_pyvista(scene: _kernel.Scene) -> Any:
    """The walls of a scene as polygons of pyvista, with the number of the wall and its species."""
    import pyvista

    made = scene.wall_polygons()
    points, ends = made.pop("points_m"), made.pop("ends")
    starts = np.concatenate([[0], ends[:-1]]).astype(int)
    faces = [np.concatenate([[end - start], np.arange(start, end)]) for start, end in zip(starts, ends)]
    surface = pyvista.PolyData(points, np.concatenate(faces) if faces else np.zeros(0, int))
    for name, values in made.items():
        surface[name] = values
    return surface
