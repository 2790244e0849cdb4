"""The live program beside its targets: numbers 100 ms and scene 200 ms after a move (95 % of moves), a map in 20 s.

    python benchmarks/live.py                       # a bearing under given temperature and a self-heated one
    python benchmarks/live.py --moves 50 --map 10 --case 7012AC

A move changes the radial load. "processor" is what its numbers take of a core, "numbers" the time by the
clock from the request to the readings of the page, "scene" that until the films in the scene are exchanged. The
browser's own share is not in it.
Measured values stand in docs/tutorial/live.md.
"""

from __future__ import annotations

import argparse
import asyncio
import random
import resource
import time

import numpy as np

from oilfilm.cases.app.design import start
from oilfilm.cases.app.pictures import polar
from oilfilm.cases.app.readings import tiles
from oilfilm.cases.app.workers import Field, Worker, evenly, prepare, refined_order
from oilfilm.postprocess.scene.live import LiveScene

LOAD = "operation.radial_load_N"
SPEED = "operation.inner_speed_rpm"
HEAT = tuple(f"friction.{key}" for key in ("heat_transfer_W_K", "ambient_C", "cooling_oil_mL_min", "cooling_oil_C"))


def cases(name):
    """The case of a designation, and the same at a given temperature without a heat balance."""
    design = start(name)
    given = design.with_value("operation.temperature", "given")
    for key in HEAT:
        given = given.with_value(key, None)
    return {"given temperature": given, "self-heated": design}


async def moves(design, count, seed):
    """Seconds of each move: point, numbers of the page, scene."""
    worker, scene, draw = Worker(), LiveScene(), random.Random(seed)
    load = design.document["operation"]["radial_load_N"] or 500.0
    await worker.ask("point", design.document)  # kernels are loaded
    found = []
    for _ in range(count):
        own = design.with_value(LOAD, round(load * draw.uniform(0.7, 1.3), 1))
        begun = time.perf_counter()
        own.problems()
        answer = await worker.ask("point", own.document)
        tiles(answer["summary"])
        polar(answer["summary"], "load_N", "load", "N", 1)
        numbers = time.perf_counter()
        scene.show(await worker.ask("scene"))
        found.append((answer["processor"], numbers - begun, time.perf_counter() - begun))
    worker.end()
    return np.array(found)


async def fill(design, size):
    """Seconds of a map of size x size points."""
    field = Field()
    load = design.document["operation"]["radial_load_N"] or 500.0
    speed = design.document["operation"]["inner_speed_rpm"]
    x, y = evenly((0.5 * speed, 1.5 * speed), size), evenly((0.5 * load, 1.5 * load), size)

    def points():
        for i, j, _ in refined_order(size, size):
            yield (i, j), design.with_value(SPEED, x[i]).with_value(LOAD, y[j]).document

    await asyncio.gather(*(worker.ask("numbers", design.document) for worker in field.workers))
    begun = time.perf_counter()
    await field.fill(points(), lambda _name, _numbers: None)
    seconds = time.perf_counter() - begun
    field.end()
    return seconds


async def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--case", default="7012AC")
    parser.add_argument("--moves", type=int, default=200)
    parser.add_argument("--map", type=int, default=40, help="points each way; 0: none")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    options = parser.parse_args()
    prepare()
    print(f"{options.case}, {options.moves} moves, seed {options.seed}")
    for name, design in cases(options.case).items():
        times = 1e3 * await moves(design, options.moves, options.seed)
        for label, column in zip(("processor", "numbers", "scene"), times.T, strict=True):
            median, most = np.percentile(column, (50, 95))
            print(f"{name:18} {label:9} median {median:7.0f} ms, 95 % {most:7.0f} ms")
        if options.map:
            seconds = await fill(design, options.map)
            print(f"{name:18} map of {options.map**2} points {seconds:.0f} s")
    print(f"memory of this process {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")


if __name__ == "__main__":
    asyncio.run(main())
