"""A batch in shards that are killed, run into a full disk and find their files damaged, against an undisturbed one.

    python tools/fuzz/shards.py --seed 7193 --points 2000 --shards 8 --rounds 40

Each round starts a shard and, after a random share of the time that it takes, kills it (SIGKILL, SIGTERM or SIGINT),
or limits the size of its files so that the disk is full, or changes bytes of a file of points when it has ended. At the
end all shards are run once more undisturbed and collected. A fault is an exit code other than those of the command's
help, a traceback, more than `WITHIN` seconds from SIGINT or SIGTERM to the end (after SIGKILL its server of processes
keeps the stream of errors until it has loaded its modules, 16 s beside 14 other programs), or a table or data set that
differs in one byte from those of the batch that nothing disturbed.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
HANG = 900.0  # of a shard, beside other computations [s]
WITHIN = 5.0  # from a signal to the end, beside other computations; 2 s with none [s]
SWEEP = """case = "6208_full_ceramic"
[fixed]
"ehl.film_maps" = "none"
[sweep]
"operation.inner_speed_rpm" = {speeds}
"operation.radial_load_N" = {loads}
"""
FILMS = """
[[combinations]]
"ehl.film_maps" = "loaded"
"ehl.points" = 33
"operation.radial_load_N" = {load}
"surface.inner_ring_roughness_um" = 0.05
"surface.outer_ring_roughness_um" = 0.05
"surface.ball_roughness_um" = {roughness}
"""  # points with solved films, of which two each share theirs
SOLVED = 40  # of them
KINDS = ("kill", "kill", "term", "int", "full", "flip", "cut", "zero", "journal", "contact")
PLACES = {"journal": "points-*.sqlite-wal", "contact": "contacts/*.contact"}
SAME = ("batch.csv", "results.nc")


def sweep(wanted: int) -> tuple[str, int]:
    """Text of a sweep with about as many points as wanted, most without films, and how many they are."""
    loads = np.linspace(400.0, 3000.0, 20).round(3).tolist()
    speeds = np.linspace(1000.0, 10000.0, max(1, (wanted - SOLVED) // 20)).round(3).tolist()
    films = "".join(FILMS.format(load=500.0 + 20.0 * (k // 2), roughness=(0.01, 0.02)[k % 2]) for k in range(SOLVED))
    return SWEEP.format(speeds=speeds, loads=loads) + films, len(speeds) * len(loads) + SOLVED


def oilfilm(words: str, folder: Path, room: int | None = None) -> subprocess.Popen[str]:
    """A command; `room`: of each file that it writes [bytes]."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, resource.RLIM_INFINITY))

    return subprocess.Popen(
        [sys.executable, "-m", "oilfilm.cases.cli", *words.split()],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": f"{ROOT}:{os.environ.get('PYTHONPATH', '')}"},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=None if room is None else limit,
    )


def ended(
    process: subprocess.Popen[str], allowed: tuple[int, ...], what: str, longest: float | None = HANG
) -> list[str]:
    """What is wrong with an end, after at most `longest` [s]."""
    try:
        errors = process.communicate(timeout=longest)[1]
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return [f"{what}: did not end within {longest:g} s"]
    wrong = [f"{what}: exit code {process.returncode}: {errors[-500:]}"] * (process.returncode not in allowed)
    return wrong + [f"{what}: {errors[-1500:]}"] * ("Traceback" in errors or "internal error" in errors)


def damage(kind: str, folder: Path, rng: random.Random) -> str:
    """Change a file of points or a shared contact that nobody writes; its name."""
    pattern = PLACES.get(kind, "points-*.sqlite")
    files = [path for path in sorted(folder.glob(pattern)) if path.stat().st_size > 200]
    if not files:
        return "nothing"
    path = rng.choice(files)
    data = bytearray(path.read_bytes())
    place = rng.randrange(len(data))
    if kind == "cut":
        del data[place:]
    elif kind == "zero":
        data[place : place + 4096] = bytes(len(data[place : place + 4096]))
    else:
        data[place] ^= 1 << rng.randrange(8)
    path.write_bytes(data)
    return path.name


def disturbed(kind: str, words: str, folder: Path, rng: random.Random, longest: float) -> list[str]:
    """A shard that something happens to; what is wrong with how it ends."""
    if kind == "full":
        out = folder / "out"
        largest = max((path.stat().st_size for path in out.glob("points-*.sqlite*")), default=0)
        return ended(oilfilm(words, folder, largest + rng.randrange(60_000)), (0, 1, 4), "full disk")
    process = oilfilm(words, folder)
    numbers = {"kill": signal.SIGKILL, "term": signal.SIGTERM, "int": signal.SIGINT}
    if kind in numbers:
        try:
            process.wait(rng.uniform(0.05, 1.0) * longest)
        except subprocess.TimeoutExpired:
            process.send_signal(numbers[kind])
        sent = time.monotonic()
        wrong = ended(process, (0, 3, -signal.SIGKILL), kind)
        late = time.monotonic() - sent
        return wrong + [f"{kind}: took {late:.1f} s to end"] * (kind != "kill" and late > WITHIN)
    wrong = ended(process, (0,), "undisturbed")
    damage(kind, folder / "out", rng)
    return wrong


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, default=7193)
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--shards", type=int, default=8)
    parser.add_argument("--rounds", type=int, default=40)
    parser.add_argument("--workers", type=int, default=2)
    chosen = parser.parse_args()
    rng = random.Random(chosen.seed)
    text, points = sweep(chosen.points)
    with tempfile.TemporaryDirectory(prefix="shards-") as name:
        folder = Path(name)
        (folder / "sweep.toml").write_text(text)
        words = f"batch sweep.toml -q --workers {chosen.workers}"
        start = time.monotonic()
        faults = ended(oilfilm(f"{words} -o calm", folder), (0,), "the undisturbed batch", None)
        longest = max(3.0, (time.monotonic() - start) / chosen.shards + 3.0)
        spent = resource.getrusage(resource.RUSAGE_CHILDREN)
        print(
            f"undisturbed: {time.monotonic() - start:.0f} s, {spent.ru_utime + spent.ru_stime:.0f} s of processors",
            flush=True,
        )
        counts: dict[str, int] = {}
        for k in range(chosen.rounds):
            begun = time.monotonic()
            kind = rng.choice(KINDS)
            counts[kind] = counts.get(kind, 0) + 1
            shard = f"{rng.randrange(chosen.shards) + 1}/{chosen.shards}"
            found = disturbed(kind, f"{words} -o out --shard {shard}", folder, rng, longest)
            faults += [f"round {k}, shard {shard}: {fault}" for fault in found]
            print(f"round {k}: {kind}, shard {shard}, {time.monotonic() - begun:.0f} s", *found, sep="\n  ", flush=True)
        for k in range(chosen.shards):
            faults += ended(oilfilm(f"{words} -o out --shard {k + 1}/{chosen.shards}", folder), (0,), "at the end")
        faults += ended(oilfilm("batch sweep.toml -q -o out --collect", folder), (0,), "collecting")
        for file in SAME:
            calm, out = folder / "calm" / file, folder / "out" / file
            if not out.exists() or calm.read_bytes() != out.read_bytes():
                faults.append(f"{file} differs from that of the undisturbed batch")
    for fault in faults:
        print(fault)
    told = ", ".join(f"{number} {kind}" for kind, number in sorted(counts.items()))
    print(f"{points} points, {chosen.shards} shards, {chosen.rounds} rounds ({told}): {len(faults)} faults")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
