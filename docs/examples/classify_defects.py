"""A classifier of defects, learned from simulated records.

The batch `6205_defects` simulates a 6205 with and without spalls; races and balls of each seed have a form of their
own. The features of a record are its level and its envelope at multiples of the frequencies of outer ring, inner ring
and ball. A linear classifier trained on one seed identifies the records of the other.
"""

import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import scipy.signal
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import ConfusionMatrixDisplay
from sklearn.model_selection import LeaveOneGroupOut, cross_val_predict
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

import oilfilm
from oilfilm.cases.batch import LocalPool
from oilfilm.cases.batch.results import load_results, write_batch

BODIES = ("ball_pass_outer", "ball_pass_inner", "ball_spin")


def features(record, rate, passing):
    """Logarithms of the level and of the envelope at four multiples of each frequency."""
    envelope = abs(scipy.signal.hilbert(record))
    amplitude = abs(np.fft.rfft((envelope - envelope.mean()) * np.hanning(record.size)))
    places = np.rint(np.outer(passing, [1, 2, 3, 4]) * record.size / rate).astype(int)
    combs = [np.mean([amplitude[k - 1 : k + 2].max() for k in row]) for row in places]
    return np.log([record.std(), *(combs / np.median(amplitude))])


if __name__ == "__main__":  # the workers are processes that read this file, too
    shutil.rmtree("defects", ignore_errors=True)
    sweep = oilfilm.read_sweep("6205_defects")
    batch = oilfilm.run_batch(sweep, Path("defects"), lambda: LocalPool(2))
    write_batch(load_results(batch), Path("defects"))
    with oilfilm.open_results("defects") as tree:
        data = tree.to_dataset().load()
    names = [f"frequencies_Hz.with_slip.{body}" for body in BODIES]
    passing = np.column_stack([data[name].values for name in names]) * [1.0, 1.0, 2.0]
    records = data["record.acceleration_m_s2"].values
    rates = data["record.sample_rate_Hz"].values
    X = [features(*one) for one in zip(records, rates, passing, strict=True)]
    words = [text.split(", ") for text in data["record.defects"].values]
    body = np.array([parts[1] if len(parts) > 1 else "none" for parts in words])
    model = make_pipeline(StandardScaler(), LogisticRegression(C=10.0))
    seeds = data["form.seed"].values
    found = cross_val_predict(model, X, body, groups=seeds, cv=LeaveOneGroupOut())
    figure, axes = plt.subplots(figsize=(5.0, 4.0), layout="constrained")
    ConfusionMatrixDisplay.from_predictions(body, found, ax=axes, colorbar=False, cmap="Blues")
    axes.set(xlabel="identified defect", ylabel="simulated defect")
    figure.savefig("classify_defects.png")
