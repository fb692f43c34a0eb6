"""Breaks files of every kind the program reads, and reads them.

    PYTHONPATH=tests python -m fuzz --hours 8

Each case has a number.  It may be read or refused in one line; a traceback, a crash, more than ten seconds or
more than its share of memory is a finding: printed, and its files kept in a folder.
"""

import argparse
import contextlib
import itertools
import json
import os
import select
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

from fuzz.worker import kind_of, write_case

PATIENCE = 10.0
"""Seconds of processor time for one case."""
ASLEEP = 12.0
"""How many times longer a case may take by the clock: the machine may be busy."""


class Worker:
    """A process that runs cases; it is started when it is needed, and anew when it has hung or died."""

    def __init__(self) -> None:
        self.process: subprocess.Popen[str] | None = None

    def _started(self) -> "subprocess.Popen[str]":
        here = Path(__file__).resolve().parents[1]
        paths = os.pathsep.join([str(here), *filter(None, sys.path)])
        env = {**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        process = subprocess.Popen(
            [sys.executable, "-m", "fuzz.worker"],
            env=env,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        assert process.stdout is not None
        if process.stdout.readline().strip() != "ready":
            raise RuntimeError("whole files can't be read: `python -m fuzz.worker` says which")
        return process

    def run(self, seed: int, patience: float = PATIENCE) -> str | None:
        """Return what was wrong with a case, or None."""
        self.process = self.process or self._started()
        stdin, stdout = self.process.stdin, self.process.stdout
        assert stdin is not None and stdout is not None
        with contextlib.suppress(BrokenPipeError):  # it died since: then it has no answer either
            stdin.write(f"{seed}\n")
            stdin.flush()
        ready, began, used = [], time.monotonic(), _processor_time(self.process.pid)
        while not ready and _processor_time(self.process.pid) - used <= patience:
            ready, _, _ = select.select([stdout], [], [], min(patience, 0.25))
            if time.monotonic() - began >= ASLEEP * patience:
                break
        line = stdout.readline() if ready else ""
        if line:
            return json.loads(line)
        end = self.end()
        return f"the process ended with {end}" if ready else f"took more than {patience:g} seconds"

    def end(self) -> int | None:
        """End the process; return how it ended."""
        if self.process is None:
            return None
        self.process.kill()
        with contextlib.suppress(BrokenPipeError):
            self.process.communicate()
        end, self.process = self.process.returncode, None
        return end


def _processor_time(process: int) -> float:
    """Return how many seconds a process has computed."""
    user, system = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")


def findings(
    seeds: Iterator[int], until: float, jobs: int, patience: float = PATIENCE
) -> Iterator[tuple[int, str]]:
    """Run cases on several processes until a time of the monotonic clock; yield what was found."""
    lock, found = threading.Lock(), list[tuple[int, str]]()

    def work() -> None:
        worker = Worker()
        try:
            while time.monotonic() < until:
                with lock:
                    seed = next(seeds, None)
                if seed is None:
                    return
                if (wrong := worker.run(seed, patience)) is not None:
                    found.append((seed, wrong))
        finally:
            worker.end()

    threads = [threading.Thread(target=work) for _ in range(jobs)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads) or found:
        if found:
            yield found.pop(0)
        else:
            time.sleep(0.05)


def keep(seed: int, wrong: str, folder: Path) -> Path:
    """Write the files of a finding, and what was found."""
    place = folder / f"{seed}-{kind_of(seed).name.replace(' ', '-')}"
    if not place.exists():
        place.mkdir(parents=True)
        write_case(seed, place)
        (place / "FOUND.txt").write_text(f"seed {seed}\n{wrong}\n")
    return place


def main() -> int:
    """Run until the time is over; 1 if something was found."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hours", type=float, default=8.0)
    parser.add_argument("--seconds", type=float, help="instead of hours")
    parser.add_argument("--seed", type=int, default=0, help="of the first case")
    parser.add_argument("--only", help="kinds with this in their name")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--out", type=Path, default=Path("fuzz-findings"))
    chosen = parser.parse_args()
    run = 0

    def seeds() -> Iterator[int]:
        nonlocal run
        for seed in itertools.count(chosen.seed):
            if chosen.only is None or chosen.only in kind_of(seed).name:
                run += 1
                yield seed

    seconds = 3600 * chosen.hours if chosen.seconds is None else chosen.seconds
    count = 0
    for seed, wrong in findings(seeds(), time.monotonic() + seconds, chosen.jobs):
        count += 1
        place = keep(seed, wrong, chosen.out)
        print(
            f"seed {seed}, {kind_of(seed).name}: {wrong.strip().splitlines()[-1][:300]}\n  {place}",
            flush=True,
        )
    print(f"{run} cases, {count} findings")
    return int(count > 0)


if __name__ == "__main__":
    sys.exit(main())
