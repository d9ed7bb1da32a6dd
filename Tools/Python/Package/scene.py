"""The scene: what _kernel.Scene has, and what is shorter in Python."""
from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, Callable, List, Optional, Sequence, Union

import numpy as np

from . import _kernel

Progress = Union[bool, Callable[[float], None], None]

# Attributes of scenes under other usual names.
_OTHER_WORDS = {other: [word] for word, others in {
    "position": "pos positions centers centres", "velocity": "velocities vel", "spin": "spins angular_velocity angular_velocities",
    "radius": "radii", "mass": "masses", "film": "films film_volume film_volumes liquid_volume", "force": "forces",
    "torque": "torques", "identity": "identities ids", "temperature": "temperatures",
    "time_step": "dt delta_t step_size", "end_time": "max_time time_max t_max tmax t_end final_time maximum_time",
    "gravity": "g gravitational_acceleration", "threads": "number_of_threads num_threads n_threads nthreads thread_count",
}.items() for other in others.split()}


class Scene(_kernel.Scene):
    """A scene of grains, and its run.

    Scene(name="", *, threads=1, quiet=False, superquadrics=None)

    name: what the names of its files begin with; a folder may be in it. threads: the results do not depend on it.
    quiet: no warnings (they are pendular.SceneWarning, of Python's `warnings`), no summary. superquadrics: the name of its one species type, where grains are superquadrics or
    blocks (pendular.shaped_species() has the names).

    Arrays have a row for each grain, in the order of identities, and are copies. All numbers are in SI units. Raises
    InputError (a ValueError) for what cannot be right, and RunError (a RuntimeError) where a run cannot go on.
    """

    def add_box(self, species: _kernel.Species, lowest: Sequence[float], highest: Sequence[float],
                *, lid: bool = True, forces: bool = False) -> List[_kernel.Wall]:
        """Adds the planes of a box: along x, y and z the lower and the upper one.

        species: the material of their surfaces; lowest, highest: m, corners of the box. lid: without it not the last
        plane. forces: they are kept, as by Wall.keep_forces().
        """
        corners = np.array([lowest, highest], dtype=float)
        if corners.shape != (2, 3) or not np.all(np.isfinite(corners)) or not np.all(corners[0] < corners[1]):
            raise _kernel.InputError(f"add_box(): lowest = {list(lowest)}, highest = {list(highest)}; they must be three "
                                     "numbers (m) each, and the lowest below the highest.")
        walls = []
        for axis in range(3):
            outward = np.zeros(3)
            outward[axis] = 1
            walls.append(self.add_plane(species, -outward, lowest, forces=forces))
            if axis < 2 or lid:
                walls.append(self.add_plane(species, outward, highest, forces=forces))
        return walls

    if TYPE_CHECKING:  # mypy lets a property be assigned only what it returns
        temperature: _kernel._Array
    else:

        @property
        def temperature(self) -> np.ndarray:
            """K, N: of the grains, after conduct_heat(); also the column `temperature`."""
            try:
                return self.column("temperature")
            except _kernel.InputError as problem:
                raise _kernel.InputError("Grains have no temperature before conduct_heat().") from problem

        @temperature.setter
        def temperature(self, values: Any) -> None:
            self.set_column("temperature", values)

    def run(self, until: Optional[float] = None, *, steps: Optional[int] = None, progress: Progress = False) -> Scene:
        """Begins the run, or goes on with it, until a time (s), or for so many steps; it may be called again.

        progress: True shows a bar (by tqdm where it is installed), a function is called with the time (s). Ctrl-C is
        KeyboardInterrupt after the step, with a whole restart file where one is kept, and the scene can go on. Other
        threads of Python go on while it runs.
        """
        if (until is None) == (steps is None):
            raise _kernel.InputError("run() takes the time (s) until which it runs, or steps.")
        if steps is not None:
            if steps < 0:
                raise _kernel.InputError(f"run() takes at least 0 steps; they are {steps}.")
            if progress is True:
                with _bar(self.time, self.time + steps * self.time_step, self.name) as show:
                    self._run_steps(steps, show)
            else:
                self._run_steps(steps, progress if callable(progress) else None)
        elif progress is True:
            with _bar(self.time, float(until), self.name) as show:  # type: ignore[arg-type]
                self._run_to(until, show)  # type: ignore[arg-type]
        else:
            self._run_to(until, progress if callable(progress) else None)  # type: ignore[arg-type]
        return self

    if not TYPE_CHECKING:  # mypy would take any name then

        def __setattr__(self, name: str, value: Any) -> None:
            """Attributes of your own are kept, but one of the scene that cannot be set, or nearly its name, is a mistake."""
            if hasattr(type(self), name):
                fixed = _why_fixed(type(self), name)
                if fixed:
                    raise AttributeError(f"A Scene's {fixed}.")
            elif name not in self.__dict__:
                import difflib  # for attributes of your own, and mistakes

                near = _OTHER_WORDS.get(name.lower()) or difflib.get_close_matches(name, dir(type(self)), 1, 0.8)
                if near:
                    fixed = _why_fixed(type(self), near[0])
                    advice = f"its {fixed}." if fixed else f"did you mean {near[0]}?"
                    raise AttributeError(f"A Scene has no attribute {name}; {advice}")
            super().__setattr__(name, value)

    def __enter__(self) -> Scene:
        return self

    def __exit__(self, kind: Any, *_: Any) -> None:
        """Ends the run: its last outputs are written."""
        if kind is None and self.steps > 0 and not self.has_ended:
            self.finish()

    def __repr__(self) -> str:
        try:
            return f"<pendular.Scene {self.name!r}: {len(self)} grains, {self.time:.6g} s>"
        except _kernel.RunError:
            return "<pendular.Scene, in which another thread is at work>"


def _why_fixed(kind: type, name: str) -> str:
    """Why an attribute of scenes cannot be assigned; empty where it can."""
    own = getattr(kind, name, None)
    if isinstance(own, property):
        return "" if own.fset else f"{name} can be read, but not assigned"
    is_method = callable(own) and own is getattr(Scene, name, None)
    return f"{name}() is a method and cannot be assigned" if is_method else ""


class _bar:
    """Progress by tqdm, or as a line on standard error."""

    def __init__(self, start: float, end: float, name: str) -> None:
        self.start, self.end, self.name = start, end, name
        self.bar: Any = None  # of tqdm, whose types mypy knows or not

    def __enter__(self) -> Callable[[float], None]:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return self._line
        form = "{desc}: {percentage:3.0f}% |{bar}| {n:.4g} of {total:.4g} s [{elapsed}<{remaining}]"
        self.bar = tqdm(total=self.end, initial=self.start, desc=self.name, bar_format=form)
        return self._move

    def _move(self, time: float) -> None:
        self.bar.update(min(time, self.end) - self.bar.n)

    def _line(self, time: float) -> None:
        print(f"\r{self.name}: {time:.4g} of {self.end:.4g} s", end="", file=sys.stderr, flush=True)

    def __exit__(self, *_: Any) -> None:
        if self.bar is not None:
            self.bar.close()
        else:
            print(file=sys.stderr)
