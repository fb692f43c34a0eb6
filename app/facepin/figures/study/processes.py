"""Independent pieces of work on all cores."""

from collections.abc import Callable, Iterator
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from os import environ
from signal import SIG_IGN, SIGINT, signal
from typing import TypeVar

from facepin.core.errors import FacepinError

Result = TypeVar("Result")


def spread(work: Callable[[int], Result], count: int, jobs: int) -> Iterator[tuple[int, Result]]:
    """Yield (number, work(number)) for every number below `count`, in the order in which they get done.

    Parameters
    ----------
    work : callable
        Sent to each process once, so it may carry data (a bound method of a value); has to be picklable.
    jobs : int
        Processes; with one, everything is done in this one.

    Raises
    ------
    FacepinError
        When a process ends before its work is done.
    """
    jobs = min(jobs, count)
    if jobs <= 1:
        yield from ((number, work(number)) for number in range(count))
        return
    # Before the new processes import numpy: threads of their own would only be in each other's way.
    environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    context = get_context("spawn")
    todo = iter(range(count))
    lines = []
    for _ in range(jobs):
        here, there = context.Pipe()
        # A daemon: it ends with the program, whatever ends that.
        context.Process(target=_serve, args=(work, there), daemon=True).start()
        there.close()
        here.send(next(todo))
        lines.append(here)
    while lines:
        ready = wait(lines)
        for line in [each for each in lines if each in ready]:
            try:
                done: tuple[int, Result] = line.recv()
            except EOFError as error:
                raise FacepinError("a process ended before its work was done (out of memory?)") from error
            following = next(todo, None)
            line.send(following)
            if following is None:
                lines.remove(line)
            yield done


def _serve(work: Callable[[int], object], line: Connection) -> None:
    """Do what comes through the line until that is None."""
    signal(SIGINT, SIG_IGN)  # Ctrl-C is for the program that waits
    while (number := line.recv()) is not None:
        line.send((number, work(number)))
