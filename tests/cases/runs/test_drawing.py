"""Pictures made by processes: the files of one process, byte by byte; left out after an interrupt."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import time
from dataclasses import replace

import pytest

from oilfilm.cases import load_case, run_case
from oilfilm.cases.runs.drawing import drawing_processes
from oilfilm.postprocess import write_results

LEFT_OUT = "VTK and plots"
NUMBERS = {"summary.json", "contacts.csv", "results.nc"}


@pytest.fixture(scope="module")
def results():
    return run_case(load_case("209_radial_8900N"))  # no films: quick


@pytest.fixture(scope="module")
def drawing():
    with drawing_processes(ahead=True) as processes:
        yield processes


def killed(*_part):
    """In a process that draws."""
    os.abort()


def contents(folder):
    """The files of a folder by their relative paths."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("ahead", [0, 1, 2], ids=["all at once", "pictures of films ahead", "in two rounds"])
def test_processes_write_the_files_of_one_process(results, drawing, tmp_path, ahead):
    for name in ("one", "several"):
        (tmp_path / name).mkdir()
    if ahead == 2:  # outdated by the films of the next round
        drawing.films(replace(results, case=results.case | {"title": "the first round"}))
    if ahead:
        drawing.films(replace(results, torque=None, strength=None))
    assert drawing.write(results, tmp_path / "several") == write_results(results, tmp_path / "one") == ()
    one, several = contents(tmp_path / "one"), contents(tmp_path / "several")
    assert "plots/load_zone.png" in one
    assert "fields.pvd" in one
    assert one == several


def test_results_that_no_process_can_take_lose_their_pictures_only(results, drawing, tmp_path, monkeypatch):
    def refused(_results):
        raise pickle.PicklingError("no way")

    monkeypatch.setattr("oilfilm.cases.runs.drawing.pickle.dumps", refused)
    assert drawing.write(results, tmp_path) == (f"{LEFT_OUT} not written: PicklingError: no way",)
    assert set(contents(tmp_path)) == NUMBERS


def test_after_an_interrupt_numbers_alone_are_written(results, tmp_path):
    with drawing_processes(ahead=False) as processes:
        processes.stop()
        problems = processes.write(results, tmp_path)
    assert problems == (f"{LEFT_OUT} not written: interrupted",)
    assert set(contents(tmp_path)) == NUMBERS
    assert problems[0] in (tmp_path / "summary.json").read_text(encoding="utf-8")


def test_after_an_interrupt_pictures_begun_ahead_are_given_up(results, tmp_path):
    with drawing_processes(ahead=False) as processes:
        processes.films(results)
        processes.stop()
        problems = processes.write(results, tmp_path)
    assert f"{LEFT_OUT} not written: interrupted" in problems
    assert NUMBERS <= set(contents(tmp_path)) <= NUMBERS | {"plots/load_zone.png"}  # it may have been drawn


def test_a_drawing_process_that_is_killed_loses_its_pictures_only(results, tmp_path, monkeypatch):
    monkeypatch.setattr("oilfilm.cases.runs.drawing._make", killed)
    with drawing_processes(ahead=False) as processes:
        problems = processes.write(results, tmp_path)
    assert problems == (f"{LEFT_OUT}: some not written, a process that drew them was ended",)
    assert set(contents(tmp_path)) == NUMBERS


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_an_interrupt_ends_all_processes_without_a_word():
    """Also while the libraries are loaded: it goes to all processes of the terminal."""
    code = """
import sys, time
from oilfilm.cases.cli.terminal import exit_code
from oilfilm.cases.runs.drawing import drawing_processes
def wait():
    with drawing_processes(ahead=True):
        print("up", flush=True)
        time.sleep(60)
sys.exit(exit_code(wait))
"""
    command = [sys.executable, "-c", code]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "start_new_session": True}
    with subprocess.Popen(command, **pipes) as process:
        assert process.stdout.readline() == b"up\n"
        time.sleep(0.1)
        os.killpg(process.pid, signal.SIGINT)
        _, errors = process.communicate(timeout=60)  # until all processes have closed their streams
    assert process.returncode == 3
    assert errors == b"oilfilm: interrupted\n"
