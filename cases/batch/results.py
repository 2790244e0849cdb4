"""The finished points of a batch, gathered, and the files made of them."""

from pathlib import Path
from typing import Any

from postprocess.batch.results import BatchPoint, BatchResults
from postprocess.batch.summary import batch_summary
from postprocess.batch.write import write_batch_csv, write_batch_netcdf
from postprocess.files import write_json

from ..runs.integrity import write_digests
from ..version import version
from .engine import Batch
from .store import DATA, SUMMARY, TABLE, read_point

MISSING: dict[str, Any] = {
    "status": "lost",
    "message": "its file is damaged; --resume computes it again",
    "summary": None,
}


def gathered(batch: Batch) -> BatchResults:
    """Every point of a batch with its summary, in the order of the sweep file."""
    points = []
    for point in batch.sweep.points:
        record = read_point(batch.directory, point.key) or MISSING
        points.append(
            BatchPoint(
                number=point.number,
                block=point.block,
                values=point.values,
                case=point.resolved,
                key=point.key,
                resumed=point.key in batch.resumed,
                **{name: record[name] for name in MISSING},
            )
        )
    sweep = batch.sweep
    same = ("title", "case", "keys", "messages", "assumed", "plot")
    return BatchResults(
        version=version(),
        sweep=sweep.text,
        points=tuple(points),
        timing={"total": batch.wall},
        **{name: getattr(sweep, name) for name in same},
    )


def write_batch(results: BatchResults, directory: Path) -> None:
    """Write the table, the data set and, last, the summary of a batch."""
    write_batch_csv(results, directory / TABLE)
    write_batch_netcdf(results, directory / DATA)
    write_json(batch_summary(results), directory / SUMMARY)
    write_digests(directory, (TABLE, DATA, SUMMARY))
