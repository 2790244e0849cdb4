"""Install wheel and sdist away from the repository, with newest and lowest dependencies, and run what is shipped.

    python tools/install_matrix.py                                 # this Python, newest and lowest
    python tools/install_matrix.py --python 3.11 3.12 3.13 3.14    # those of them that `pythonX.Y` or uv finds
    python tools/install_matrix.py --quick                         # cases validated, one run
    python tools/install_matrix.py --write-constraints             # the files of packaging/constraints, from here

Each combination has an environment of its own in a temporary folder. Lowest dependencies are the lower bounds of
pyproject.toml, written as `name==bound`; tested ones are those of the environment that the tests last passed in.
Warnings of Python are errors (`-W error`), but deprecations of libraries. What the sdist installs is compared with
what the wheel installs, file by file: where they are equal, as expected, its cases are validated and two of them run,
and the runs of the wheel's hold for both. A line for each combination; exit code 1 where one is not green.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from importlib import metadata
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WARNINGS = "error,ignore::DeprecationWarning,ignore::PendingDeprecationWarning"
RUN = ("6208_full_ceramic", "moes_20_10")  # run where the others are validated only


CONSTRAINTS = ROOT / "packaging" / "constraints"
EXTRAS = "cluster,parquet,html,optimise"


def tested() -> list[str]:
    """The versions of the environment of the tests, as exact versions."""
    return (CONSTRAINTS / "tested.txt").read_text(encoding="utf-8").split()


def write_constraints() -> None:
    """Lowest versions, those of this environment, and the newest that fit together, one a line."""
    names = ["pip", "install", "--dry-run", "--ignore-installed", "--quiet", "--report", "-", f"{ROOT}[{EXTRAS}]"]
    report = subprocess.run([sys.executable, "-P", "-m", *names], capture_output=True, text=True, check=True).stdout
    found = [item["metadata"] for item in json.loads(report[report.index("{") :])["install"]]
    newest = {re.sub(r"[-_.]+", "-", one["name"]).lower(): one["version"] for one in found if one["name"] != "oilfilm"}
    here = {name: version for name in newest if (version := installed_version(name))}
    CONSTRAINTS.mkdir(exist_ok=True)
    for name, lines in (("newest", exact(newest)), ("tested", exact(here)), ("lowest", lowest())):
        (CONSTRAINTS / f"{name}.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def exact(versions: dict[str, str]) -> list[str]:
    return [f"{name}=={version}" for name, version in sorted(versions.items())]


def installed_version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return ""


def lowest() -> list[str]:
    """The lower bounds of the dependencies, as exact versions."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return [re.sub(r">=([\w.]+)", r"==\1", dependency) for dependency in project["dependencies"]]


def run(words: list[str], folder: Path, **more: str) -> subprocess.CompletedProcess[str]:
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV")}
    return subprocess.run(words, cwd=folder, env=environment | more, capture_output=True, text=True, check=False)


def interpreter(version: str) -> str | None:
    """A Python of a version: on the path, or one that uv knows."""
    if version == f"{sys.version_info.major}.{sys.version_info.minor}":
        return sys.executable
    found = shutil.which(f"python{version}")
    if found is None and shutil.which("uv"):
        answer = subprocess.run(["uv", "python", "find", version], capture_output=True, text=True, check=False)
        found = answer.stdout.strip() or None
    runs = found and subprocess.run([found, "-c", ""], capture_output=True, check=False).returncode == 0
    return found if runs else None  # a name on the path may stand for a Python that is not there


def built(folder: Path) -> list[Path]:
    """Wheel and sdist, built in an environment of their own."""
    run([sys.executable, "-m", "venv", "build"], folder)
    python = str(folder / "build" / "bin" / "python")
    run([python, "-m", "pip", "install", "-q", "build"], folder)
    answer = run([python, "-m", "build", "--outdir", str(folder / "dist"), str(ROOT)], folder)
    files = sorted((folder / "dist").glob("oilfilm-*"))
    if len(files) != 2:
        sys.exit(f"wheel and sdist were not built: {answer.stdout[-1500:]}{answer.stderr[-1500:]}")
    return files


def installed(own: str, package: Path, exact: list[str], folder: Path) -> list[str]:
    """What is wrong with an installation."""
    answer = run([own, "-m", "pip", "install", "-q", "--prefer-binary", str(package), *exact], folder)
    return [f"not installed: {answer.stderr[-800:]}"] * bool(answer.returncode)


def contents(own: str, folder: Path) -> dict[str, str]:
    """Digests of the files that a package brought, by their names."""
    place = run(
        [own, "-c", "import pathlib; from oilfilm import ehl; print(pathlib.Path(ehl.__file__).parents[1])"], folder
    ).stdout.strip()
    files = [path for path in sorted(Path(place).rglob("*")) if path.is_file()]
    return {
        path.relative_to(place).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in files
        if "__pycache__" not in path.parts
    }


def versions(own: str, folder: Path) -> str:
    """Python and the libraries that matter most, with their versions."""
    names = ("numpy", "scipy", "numba", "pydantic", "typer", "h5py", "scikit-fem", "pyvista", "vtk", "matplotlib")
    code = (
        "import platform; from importlib.metadata import version as v; "
        f"print(platform.python_version(), *(n + ' ' + v(n) for n in {names}), sep=', ')"
    )
    return run([own, "-c", code], folder).stdout.strip()


def failures(own: str, folder: Path, *, quick: bool) -> list[str]:
    """What does not run with the Python of an environment that has the package."""
    oilfilm = [str(Path(own).with_name("oilfilm"))]
    wrong = []
    commands = run([*oilfilm, "--help"], folder, PYTHONWARNINGS=WARNINGS)
    names = re.findall(r"^  ([a-z]+)  ", commands.stdout.partition("Commands:")[2], re.MULTILINE)
    wrong += [] if names else [f"--help: {commands.stderr[-300:]}"]
    for name in names:
        answer = run([*oilfilm, name, "--help"], folder, PYTHONWARNINGS=WARNINGS)
        wrong += [f"{name} --help: {answer.stderr[-300:]}"] * bool(answer.returncode)
    cases = run([own, "-c", "from oilfilm.cases.format.shipped import shipped_cases; print(*shipped_cases())"], folder)
    for case in cases.stdout.split():
        whole = not quick or case in RUN
        kind = run([own, "-c", f"import oilfilm; print(type(oilfilm.load_case({case!r})).__name__)"], folder)
        command = "contact" if "ContactCase" in kind.stdout else "run"
        words = [command, case, "-q", "-o", case] if whole else ["validate", case]
        start = time.monotonic()
        answer = run([*oilfilm, *words], folder, PYTHONWARNINGS=WARNINGS)
        if whole:
            print(f"    {case}: code {answer.returncode}, {time.monotonic() - start:.0f} s", flush=True)
        wrong += [f"{' '.join(words)}: code {answer.returncode}: {answer.stderr[-300:]}"] * (answer.returncode > 1)
    return wrong if cases.stdout.split() else [*wrong, f"no shipped cases: {cases.stderr[-300:]}"]


def cell(python: str, packages: list[Path], exact: list[str], folder: Path, *, quick: bool) -> dict[str, list[str]]:
    """What is wrong with wheel and sdist on one Python with one set of dependencies."""
    folder.mkdir()
    found = {}
    brought: dict[str, dict[str, str]] = {}
    for package in sorted(packages, key=lambda path: path.suffix != ".whl"):  # the wheel first
        kind = "wheel" if package.suffix == ".whl" else "sdist"
        place = folder / kind
        place.mkdir()
        run([python, "-m", "venv", "env"], place)
        own = str(place / "env" / "bin" / "python")
        start = time.monotonic()
        wrong = installed(own, package, exact, place)
        if not wrong:
            brought[kind] = contents(own, place)
            equal = kind == "sdist" and brought[kind] == brought.get("wheel")
            print(f"  {kind}: {versions(own, place)}; {len(brought[kind])} files", flush=True)
            if kind == "sdist" and not equal:
                wrong = ["what it installs is not what the wheel installs"]
            wrong += failures(own, place, quick=quick or equal)
        print(f"  {kind}: {time.monotonic() - start:.0f} s", flush=True)
        found[kind] = wrong
        shutil.rmtree(place)
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--python", nargs="+", default=[f"{sys.version_info.major}.{sys.version_info.minor}"])
    parser.add_argument("--quick", action="store_true", help="validate cases, run two of them")
    parser.add_argument("--only", choices=("newest", "tested", "lowest"), help="one set of dependencies")
    parser.add_argument("--write-constraints", action="store_true", help="write packaging/constraints, nothing else")
    chosen = parser.parse_args()
    if chosen.write_constraints:
        write_constraints()
        return 0
    red = 0
    with tempfile.TemporaryDirectory(prefix="install-") as name:
        folder = Path(name)
        packages = built(folder)
        for version in chosen.python:
            python = interpreter(version)
            if python is None:
                print(f"{version}: there is no such Python here")
                red += 1
                continue
            for which, versions in (("newest", []), ("tested", tested()), ("lowest", lowest())):
                if chosen.only not in (None, which):
                    continue
                found = cell(python, packages, versions, folder / f"{version}-{which}", quick=chosen.quick)
                for kind, wrong in found.items():
                    print(f"{version}, {kind}, {which}: {'green' if not wrong else 'RED'}", flush=True)
                    for problem in wrong:
                        print(f"    {problem}", flush=True)
                    red += bool(wrong)
    return bool(red)


if __name__ == "__main__":
    sys.exit(main())
