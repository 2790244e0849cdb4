"""netCDF files of others: no links to other files, no more than they hold."""

from __future__ import annotations

import os

import h5py
import numpy as np
import pytest

from oilfilm.cases.cli.terminal import reading
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.runs.output_directory import write_digests
from oilfilm.ehl.foreign_files import DamagedFileError
from oilfilm.postprocess.dynamics.read import open_history
from oilfilm.postprocess.netcdf_write import FIELDS_FILE
from oilfilm.postprocess.open_results import open_results


def external_link(file, secret):
    file["data"] = h5py.ExternalLink(str(secret), "/data")


def soft_link(file, _secret):
    file["data"] = h5py.SoftLink("/elsewhere")


def external_storage(file, secret):
    file.create_dataset("data", (8,), "u1", external=[(str(secret), 0, 8)])


def virtual(file, secret):
    layout = h5py.VirtualLayout((8,), "u1")
    layout[:] = h5py.VirtualSource(str(secret), "data", (8,))
    file.create_virtual_dataset("data", layout)


def declared(file, _secret):
    file.create_dataset("data", (10**12,), "f8", chunks=(1000,))


def declared_and_begun(file, _secret):
    file.create_dataset("data", (10**9,), "f8", chunks=(1000,), compression="gzip")[:1000] = np.zeros(1000)


def circle(file, _secret):
    file.create_group("a")
    file["a/b"] = file["a"]


ATTACKS = (external_link, soft_link, external_storage, virtual, declared, declared_and_begun, circle)


@pytest.mark.parametrize("attack", ATTACKS)
@pytest.mark.parametrize("opened", [open_results, open_history])
def test_a_file_that_leads_elsewhere_or_declares_more_is_damaged(tmp_path, attack, opened):
    secret = tmp_path / "secret.h5"
    with h5py.File(secret, "w") as file:
        file["data"] = np.arange(8, dtype="u1")
    path = tmp_path / (FIELDS_FILE if opened is open_results else "history.nc")
    with h5py.File(path, "w") as file:
        file.attrs.update(oilfilm_format=1, oilfilm_history=1, kind="contact")
        attack(file, secret)
    with pytest.raises(DamagedFileError, match=r"elsewhere|more than it holds"):
        opened(path)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes on this system")
def test_a_pipe_in_the_place_of_a_summary_is_not_waited_for(tmp_path):
    from oilfilm.postprocess.files import SUMMARY_FILE, read_summary

    os.mkfifo(tmp_path / SUMMARY_FILE)
    with pytest.raises(DamagedFileError, match="no regular file"):
        read_summary(tmp_path)


def test_what_no_reader_expects_is_told_as_damaged_where_no_digests_are(tmp_path):
    """With digests that fit, an error is one of the program, and stays one."""
    with pytest.raises(CaseError, match="damaged or not of oilfilm"), reading(tmp_path):
        raise AttributeError("'str' object has no attribute 'items'")
    write_digests(tmp_path, [])
    with pytest.raises(AttributeError), reading(tmp_path):
        raise AttributeError("'str' object has no attribute 'items'")
