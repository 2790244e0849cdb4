"""A classifier of defects, learned from simulated records.

The batch `6205_defects` simulates a 6205 with and without spalls, records of 0.25 s each with races and balls of their
own form. A linear classifier learns body and size-independent signs: the envelope at the frequencies of the bodies, and
the kurtosis. It is tried on records whose form it has not seen.
"""

import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import ConfusionMatrixDisplay
from sklearn.model_selection import LeaveOneGroupOut, cross_val_predict
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

import oilfilm
from oilfilm.cases.batch import LocalPool, load_results, write_batch

BODIES = ("ball_pass_outer", "ball_pass_inner", "ball_spin_twice")
if __name__ == "__main__":  # the workers are processes that read this file, too
    shutil.rmtree("defects", ignore_errors=True)
    sweep = oilfilm.read_sweep("6205_defects")
    batch = oilfilm.run_batch(sweep, Path("defects"), lambda: LocalPool(2))
    write_batch(load_results(batch), Path("defects"))
    with oilfilm.open_results("defects") as tree:
        data = tree.to_dataset().load()
    body = np.array(
        [text.split(", ")[1] if ", " in text else "none" for text in data["record.defects"].values]
    )
    level = data["acceleration_m_s2"].values
    lines = [data[f"envelope_{name}_m_s2"].values / level for name in BODIES]
    signs = np.log(np.column_stack([*lines, data["kurtosis_number"].values]))
    model = make_pipeline(StandardScaler(), LogisticRegression(C=10.0))
    found = cross_val_predict(
        model, signs, body, groups=data["form.seed"].values, cv=LeaveOneGroupOut()
    )
    print(f"{np.mean(found == body):.0%} of {len(body)} records named rightly")
    figure, axes = plt.subplots(figsize=(5.0, 4.0), layout="constrained")
    ConfusionMatrixDisplay.from_predictions(body, found, ax=axes, colorbar=False, cmap="Blues")
    axes.set(xlabel="named", ylabel="simulated defect")
    figure.savefig("classify_defects.png")
