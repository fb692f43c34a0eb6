"""One process that is given cases by number and says what came of each, until it is ended or dies of one.

Reads lines "SEED" and writes lines of JSON: null where all was well, else what was wrong in one text.
"""

import contextlib
import json
import os
import resource
import sys
import traceback
import warnings
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from facepin.core.errors import LONGEST, FacepinError
from fuzz.kinds import KINDS, Kind
from fuzz.mutations import BYTES, one_of

BASE, TIMES = 160 << 20, 20
"""Memory a case may take beyond what the process has: bytes, and bytes for each byte of its files."""
NOT_ENOUGH = "does not fit into memory"


def kind_of(seed: int) -> Kind:
    """Return which kind of file a case is about."""
    return KINDS[seed % len(KINDS)]


def write_case(seed: int, folder: Path) -> Path:
    """Write the files of a case into an empty folder; return the broken one."""
    kind, rng = kind_of(seed), np.random.default_rng(seed)
    kind.make(folder)
    files = sorted(path for path in folder.rglob("*") if path.suffix in kind.mutations)
    chosen = files[int(rng.integers(len(files)))]
    content = one_of(kind.mutations[chosen.suffix])(chosen.read_bytes(), rng)
    for _ in range(int(rng.choice([0, 0, 0, 1, 3]))):
        content = one_of(BYTES)(content, rng)
    chosen.write_bytes(content)
    return chosen


def outcome(seed: int) -> str | None:
    """Run a case; return what is wrong, None if it is read or refused in one line."""
    kind = kind_of(seed)
    with TemporaryDirectory(prefix="fuzz-") as name, _limited_to(Path(name)) as limit:
        folder = Path(name)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            write_case(seed, folder)
        limit()
        try:
            kind.read(folder)
        except FacepinError as error:
            line = str(error)
            if NOT_ENOUGH in line:
                return f"took more than its share of memory: {line}"
            if not line.strip() or "\n" in line or len(line) > LONGEST:
                return f"not one line: {line!r}"
        except (Exception, SystemExit):
            return traceback.format_exc()
    return None


@contextlib.contextmanager
def _limited_to(folder: Path):
    """Give a function that limits the memory of the process in proportion to the files in a folder."""
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)

    def limit() -> None:
        size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
        here = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (here + BASE + TIMES * size, hard))

    try:
        yield limit
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def main() -> None:
    """Answer seeds until there are no more."""
    warnings.simplefilter("error")
    for seed in range(len(KINDS)):  # whatever is imported late is there before memory is counted
        with TemporaryDirectory() as folder:
            KINDS[seed].make(Path(folder))
            KINDS[seed].read(Path(folder))
    with os.fdopen(os.dup(1), "w") as answers:
        os.dup2(2, 1)  # nothing else is an answer
        print("ready", file=answers, flush=True)
        for line in sys.stdin:
            print(json.dumps(outcome(int(line))), file=answers, flush=True)


if __name__ == "__main__":
    main()
