"""Many small scenes at once: collisions of two bodies, and scenes of any make in threads."""
from __future__ import annotations

from typing import Any, Callable, Dict, Iterable, List, Optional, TypeVar

import numpy as np

from . import _kernel

Case = TypeVar("Case")
Answer = TypeVar("Answer")


def collisions(species: str, *, radius: _kernel.ArrayLike, normal_velocity: _kernel.ArrayLike,
               tangential_velocity: _kernel.ArrayLike = 0.0, radius2: Optional[_kernel.ArrayLike] = None,
               spin1: _kernel.ArrayLike = 0.0, spin2: _kernel.ArrayLike = 0.0, steps_in_contact: _kernel.ArrayLike = 200.0,
               time_step: Optional[_kernel.ArrayLike] = None, energies: bool = False, threads: Optional[int] = None,
               **fields: Any) -> Dict[str, np.ndarray]:
    """Collisions of two spheres, or of a sphere with a plane wall, each in a scene of its own, on all cores.

    Each number may be an array: all are broadcast against each other, and what is returned has their shape. The bits do not
    depend on the number of threads. Grain 1 moves along x, towards the other body and, by tangential_velocity, past it along
    y; spins are about z. There is no gravity, and liquid that moves forms no films. Normal and tangential directions are
    those of the first touch, in free flight: grains that attract each other before may touch elsewhere.

    species: the name of the laws, as for add_species(). fields: its values, as for add_species(): density (kg/m^3), ...
    radius, radius2: m, of the two grains; radius2 = inf is a plane wall, and without it the grains are equal.
    normal_velocity: m/s, of approach; tangential_velocity: m/s, of grain 1 relative to the other body; spin1, spin2: rad/s.
    steps_in_contact: steps in the shortest contact that is sound, so that one at a low speed has more; time_step: s, instead,
    at most a tenth of that contact. energies: also the energy ledger, which takes twice as long. threads: 1 to 4096; all
    processors without it.

    Returns arrays by their names: parted; end ("parted", "drawn back": a bridge or an attraction holds the grains, or
    "creeps": overdamped, or they sinter); restitution (0 unless they part; along the first normal, so that it is negative
    where grains part after an oblique impact in which they turned far about each other); tangential_restitution (of the
    contact points, positive where their sliding is reversed; NaN where they did not slide, or stay together);
    normal_velocity_after_m_per_s (of parting), tangential_velocity_after_m_per_s, spin1_after_rad_per_s,
    spin2_after_rad_per_s; contact_time_s of the first touch (inf where it does not end), and duration_s until the end;
    largest_overlap_m; largest_normal_force_N (repulsion), largest_attraction_N (also of a dashpot),
    largest_tangential_force_N; rupture_distance_m, the gap at which a bridge ruptured or an adhesion ended (0 without one);
    energy_before_J and energy_lost_J, of the relative motion and of spins (of grains that stay together until the end that
    was seen, with what is stored in their contact or bridge then); time_step_s and steps; with energies those of the ledger,
    as lost_in_sliding_J.

    Raises InputError and RunError with the index of the collision: also where grains pass each other without a touch.
    """
    numbers = {"radius": radius, "normal_velocity": normal_velocity, "tangential_velocity": tangential_velocity,
               "spin1": spin1, "spin2": spin2, "steps_in_contact": steps_in_contact}
    numbers.update({name: given for name, given in {"radius2": radius2, "time_step": time_step}.items() if given is not None})
    arrays = _broadcast({**numbers, **fields})
    shape = next(iter(arrays.values())).shape
    count = _thread_count("collisions()", threads)
    try:
        return _kernel._collisions(species, {name: arrays[name] for name in numbers}, {name: arrays[name] for name in fields},
                                   shape, count, energies)
    except _kernel.InputError:
        _refuse_misspelt(species, fields)
        raise


def run_many(work: Callable[[Case], Answer], cases: Iterable[Case], *, threads: Optional[int] = None) -> List[Answer]:
    """What work(case) returns for each of the cases, in their order; several run at the same time, in threads.

    work: a function that makes a scene of a case, runs it, and returns what is asked of it. Scenes step at the same time,
    while what they do in Python takes turns; a scene of its own is best left with threads=1. Scenes that are made already are
    cases as well: run_many(lambda scene: scene.run(0.1), scenes). threads: 1 to 4096; all processors without it.

    An exception in work is raised as the work under way has ended, with a note which case it was (Python 3.11); no other case
    begins. Ctrl-C stops all scenes that run, until no work is under way.
    """
    from concurrent.futures import Future, ThreadPoolExecutor, wait  # takes time to import

    if not callable(work):
        raise _kernel.InputError(f"run_many(): work = {work!r:.60} must be a function of a case.")
    try:
        rest = iter(cases)
    except TypeError as problem:
        raise _kernel.InputError(f"run_many(): cases = {cases!r:.60} must be a list or another iterable.") from problem
    stopped: List[bool] = []

    def one(number: int, case: Case) -> Optional[Answer]:
        if stopped:
            return None
        try:
            return work(case)
        except BaseException as problem:
            stopped.append(True)
            if hasattr(problem, "add_note"):  # Python 3.11
                problem.add_note(f"run_many(): this is of cases[{number}].")
            raise

    futures: List[Future[Optional[Answer]]] = []
    with ThreadPoolExecutor(_thread_count("run_many()", threads)) as pool:
        try:
            for number, case in enumerate(rest):
                futures.append(pool.submit(one, number, case))
            # Cases begin in order, so that the first one that fails is found, whatever the others do.
            return [future.result() for future in futures]  # type: ignore[misc]
        except BaseException as problem:
            stopped.append(True)
            # Work that goes on with another run is stopped in that one.
            while isinstance(problem, KeyboardInterrupt) and wait(futures, timeout=0.05).not_done:
                _kernel._stop_all()
            raise


def _refuse_misspelt(species: str, fields: Dict[str, Any]) -> None:
    """Raises InputError for a name that is like that of an argument, and is no field of the species."""
    import difflib  # for mistakes only
    import inspect

    own = [name for name, one in inspect.signature(collisions).parameters.items() if one.kind is not one.VAR_KEYWORD]
    for name in fields:
        near = difflib.get_close_matches(name, own, 1, 0.75)
        if near and name not in [row[1] for row in _kernel.fields(species)]:
            raise _kernel.InputError(f"collisions() has no argument {name}; did you mean {near[0]}?") from None


def _broadcast(numbers: Dict[str, Any]) -> Dict[str, np.ndarray]:
    """Arrays of doubles of one shape."""
    arrays = {}
    for name, given in numbers.items():
        try:
            array: np.ndarray = np.asarray(given)
        except (TypeError, ValueError) as problem:
            raise _kernel.InputError(_no_numbers(name, given)) from problem
        if array.dtype.kind not in "biuf":
            raise _kernel.InputError(_no_numbers(name, given))
        if np.ma.is_masked(given):
            raise _kernel.InputError(f"collisions(): {name} has masked values; give numbers without a mask.")
        arrays[name] = array.astype(float)
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError as problem:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items() if array.shape)
        raise _kernel.InputError(f"collisions(): these arrays cannot be broadcast against each other: {shapes}.") from problem
    return {name: np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(shape) for name, array in arrays.items()}


def _no_numbers(name: str, given: Any) -> str:
    return f"collisions(): {name} = {' '.join(repr(given).split()):.60} must be numbers."


def _thread_count(function: str, threads: Optional[int]) -> int:
    if threads is None:
        return _kernel._processor_count()
    if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)) or not 1 <= threads <= 4096:
        raise _kernel.InputError(f"{function}: threads = {threads!r:.60} must be a whole number from 1 to 4096, or None.")
    return int(threads)
