"""Damage files at random, byte by byte, and hand them to the functions that read them, thousands a minute.

    python tools/fuzz/readers.py --seed 5117 --count 10000

`damaged.py` calls whole commands, some thousand a day; here each reader is called in a process of its own for a few
files at a time. Right are a result, and an error that a command turns into exit 2; wrong are all other errors,
signals, and more than `PATIENCE` seconds or `ROOM` bytes of memory.
"""

from __future__ import annotations

import argparse
import errno
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from damaged import damage, prepare

PATIENCE = 60  # [s]
ROOM = 6_000_000_000  # beside the libraries [bytes]
FILES = 25  # a process


def results(folder: Path) -> None:
    """All numbers of a folder, as report, workbook and pictures read them."""
    from oilfilm.postprocess.open_results import open_results
    from oilfilm.postprocess.report.page import report_page

    report_page(folder)
    with open_results(folder) as tree:
        tree.load()


def workbook(folder: Path) -> None:
    from oilfilm.postprocess.report.pdf_and_workbook import write_workbook

    write_workbook(folder, folder / "numbers.xlsx")


def comparison(folder: Path) -> None:
    from oilfilm.postprocess.compare import compare

    compare(folder, folder)


def history(folder: Path) -> None:
    from oilfilm.postprocess.dynamics.read import open_history

    with open_history(folder) as data:
        data.load()


def points(folder: Path) -> None:
    """Every record, as a batch that is resumed reads it, and its summary."""
    from oilfilm.postprocess.batch.store import (
        StoredPoints,
        holds_rows,
        is_sound,
        layout_names,
        store_files,
        summary_of,
        unpacked_numbers,
    )

    for path in store_files(folder):
        is_sound(path), holds_rows(path)
    stored = StoredPoints(store_files(folder))
    for record in stored.records(list(stored.status)):
        if record is not None:
            summary_of(record)
            unpacked_numbers(record.numbers, sum(map(len, layout_names(record.layout))))


def contact(folder: Path) -> None:
    from oilfilm.cases.batch.shared_tables import load_object
    from oilfilm.ehl import ContactSolution

    for path in folder.iterdir():
        load_object(path, ContactSolution)


def film(folder: Path) -> None:
    from oilfilm.cases.batch.shared_tables import load_object
    from oilfilm.ehl.traction_table.film import FilmSample

    for path in folder.iterdir():
        load_object(path, FilmSample)


def tables(folder: Path) -> None:
    from oilfilm.bearing.friction.tables import load_tables

    for path in folder.iterdir():
        load_tables(path)


def arrays(folder: Path) -> None:
    from oilfilm.ehl.data_files import read_arrays

    for path in folder.iterdir():
        read_arrays(path)


def cases(folder: Path) -> None:
    from oilfilm.cases.format.document import read_text, validate_text

    for path in folder.iterdir():
        validate_text(read_text(path), path.name)


READERS: dict[str, tuple[Callable[[Path], None], ...]] = {
    "bearing": (results, workbook, comparison),
    "contact": (results, comparison),
    "slip": (results, workbook),
    "stiffness": (results, workbook),
    "dynamics": (results, history, comparison),
    "batch": (results, points, workbook),
    "contacts": (contact,),
    "films": (film,),
    "tables": (tables,),
    "arrays": (arrays,),
    "cases": (cases,),
}


def prepare_caches(home: Path) -> None:
    """A contact, a film, tables, arrays and cases as the program writes them."""
    from math import log

    from oilfilm.bearing import solve_quasistatic
    from oilfilm.bearing.friction.tables import table_contacts, table_range
    from oilfilm.bearing.geometry import Race
    from oilfilm.cases import load_case
    from oilfilm.cases.batch.shared_tables import ContactCache, stored_film_sampler
    from oilfilm.cases.format.film_model import NEWTONIAN
    from oilfilm.ehl import Lubricant, MoesConditions, SolverOptions

    for name in ("contacts", "films", "tables", "arrays", "cases"):
        (home / name).mkdir(exist_ok=True)
    oil = Lubricant(viscosity=0.04, pressure_viscosity=20e-9)
    conditions = MoesConditions(load_parameter=10.0, lubricant_parameter=5.0, lubricant=oil)
    ContactCache(home / "contacts").solve(conditions, SolverOptions(points=33), NEWTONIAN)
    case = load_case("6208_full_ceramic")
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    one = table_contacts(state, case.lubricant, case.rheology)[Race.INNER]
    sample = stored_film_sampler(home / "films")
    sample(one, table_range(state, case.lubricant), (log(500.0), log(10.0)), 65)
    library = Path(sys.modules["oilfilm.cases.format.shipped"].__file__ or "").parents[1] / "library"
    shutil.copy(library / "dynamics" / "7008_oil_table.zip", home / "tables")
    shutil.copy(library.parents[1] / "ehl" / "closed_form" / "starvation_law.npz", home / "arrays")
    shutil.copy(library / "full_ceramic" / "6208_full_ceramic.toml", home / "cases")


def attempts(home: Path, folder: Path, rng: random.Random, kinds: list[str], report: Callable[[str], None]) -> None:
    """Some damaged files, one after the other; what is done is reported before."""
    every = [path for kind in READERS for path in (home / kind).rglob("*") if path.is_file()]
    for _ in range(FILES):
        kind = rng.choice(kinds)
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(home / kind, folder)
        path = rng.choice([path for path in sorted(folder.rglob("*")) if path.is_file() and path.suffix != ".png"])
        how = damage(path, every, rng)
        reader = rng.choice(READERS[kind])
        report(f"{reader.__name__}: {kind}/{path.relative_to(folder)} {how}: ")
        signal.alarm(PATIENCE)
        report(f"{outcome(reader, folder)}\n")
        signal.alarm(0)


def outcome(reader: Callable[[Path], None], folder: Path) -> str:
    """Exit code that a command gives: 0, 2, or an error of this program with its place."""
    from oilfilm.cases.cli.terminal import reading

    try:
        with reading(folder):  # as commands read results
            reader(folder)
    except ValueError:  # also `CaseError` and `DamagedFileError`
        return "2"
    except OSError as error:
        return "4, the disk" if error.errno == errno.ENOSPC else "2"
    except Exception as error:
        lines = traceback.extract_tb(error.__traceback__)
        place = next((f"{line.filename}:{line.lineno}" for line in reversed(lines) if "oilfilm" in line.filename), "")
        return f"4, {type(error).__name__}: {str(error)[:100]} {place} {lines[-1].filename}:{lines[-1].lineno}"
    return "0"


def process(home: Path, seed: str, kinds: list[str]) -> str:
    """What a process of its own reports, and how it ends where it does not come to its end."""
    reader, writer = os.pipe()
    child = os.fork()
    if not child:
        os.close(reader)
        now = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (now + ROOM, now + ROOM))
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1), os.dup2(null, 2)
        with tempfile.TemporaryDirectory(prefix="readers-") as folder:
            place = Path(folder) / "damaged"
            try:
                attempts(home, place, random.Random(seed), kinds, lambda text: os.write(writer, text.encode()) and None)
            except BaseException:  # also what ends a program
                os.write(writer, f"4, {' '.join(traceback.format_exc().split())[-600:]}\n".encode())
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as stream:
        text = stream.read().decode(errors="replace")
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return text if code == 0 else f"{text}4, the process ended with {code}\n"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=5117)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--kinds", default=",".join(READERS))
    parser.add_argument("--home", type=Path, help="folder of an earlier call with its results")
    arguments = parser.parse_args()
    home = arguments.home or Path(tempfile.mkdtemp(prefix="damaged-"))
    home.mkdir(exist_ok=True)
    if not (home / "batch").exists():
        prepare(home)
    if not (home / "cases").exists():
        prepare_caches(home)
    import oilfilm.cases.batch.compute
    import oilfilm.postprocess.compare
    import oilfilm.postprocess.report.pdf_and_workbook  # noqa: F401 - before processes are made

    codes: Counter[str] = Counter()
    number = 0
    while sum(codes.values()) < arguments.count:
        for line in process(home, f"{arguments.seed} {number}", arguments.kinds.split(",")).splitlines():
            code = line.rpartition(": ")[2] if line.endswith((": 0", ": 2")) else "wrong"
            codes[code] += 1
            if code == "wrong":
                print(line, flush=True)
        number += 1
    print(f"{sum(codes.values())} damaged files: {dict(sorted(codes.items()))}")
    sys.exit("wrong" in codes)


if __name__ == "__main__":
    main()
