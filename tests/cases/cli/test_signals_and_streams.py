"""Signals are obeyed also inside compiled code; closed and full streams; progress without a terminal."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest

from oilfilm.cases.cli import output, terminal
from oilfilm.cases.cli.terminal import exit_code
from oilfilm.cases.format.contact import FilmSource
from oilfilm.cases.runs.interrupt import interruptible

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals and streams of POSIX")
OILFILM = [sys.executable, "-m", "oilfilm.cases.cli"]
LONG = "hashlib.pbkdf2_hmac('sha256', b'a', b'b', 200_000_000)"  # minutes in C, without Python's lock
WITHIN = 10.0  # of a machine with other work to do; 2 s on an idle one [s]


def signalled(code, number=signal.SIGTERM):
    """Exit code, messages and time to the end [s] of Python code that says `up` and is signalled."""
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout.readline() == b"up\n"
        time.sleep(0.2)
        start = time.monotonic()
        process.send_signal(number)
        _, errors = process.communicate(timeout=60)
        return process.returncode, errors.decode(), time.monotonic() - start


def test_a_program_that_ends_while_it_writes_leaves_no_part_of_a_file(tmp_path):
    code = "from pathlib import Path; from oilfilm.bearing.files import atomic_path\n"
    code += "from oilfilm.cases.runs.interrupt import end_now\n"
    code += "with atomic_path(Path('whole.png')) as part:\n    part.write_bytes(b'half'); end_now(3)"
    ended = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=False, timeout=60)
    assert ended.returncode == 3
    assert not list(tmp_path.iterdir())


def test_a_signal_of_this_very_moment_is_known():
    """The thread that sees it may not have run when the command has ended already."""
    code = "import os, signal; from oilfilm.cases.runs.interrupt import end_after_signal; came = end_after_signal(3)\n"
    code += "signal.signal(signal.SIGINT, lambda *_: None); print('up', flush=True); assert not came()\n"
    code += "os.kill(os.getpid(), signal.SIGINT); os._exit(0 if came() else 1)"
    for _ in range(5):
        assert subprocess.run([sys.executable, "-c", code], check=False, timeout=60).returncode == 0


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_program_in_compiled_code_ends_all_the_same(number):
    code = "import hashlib; from oilfilm.cases.runs.interrupt import end_after_signal; end_after_signal(3)\n"
    code += "import signal, oilfilm.cases.runs.interrupt as i; signal.signal(signal.SIGTERM, i.interrupt)\n"
    code += f"print('up', flush=True); {LONG}"
    assert signalled(code, number)[:2] == (3, "oilfilm: interrupted\n")


FINALIZED = """
import os, signal, time
from oilfilm.cases.runs.interrupt import end_after_signal, interrupt
end_after_signal(3)
signal.signal(signal.SIGINT, interrupt)
class File:
    def __del__(self):
        {ends}
print("up", flush=True)
try:
    {work}
    while True:
        time.sleep(0.01)
except KeyboardInterrupt:
    {after}
    print("obeyed", flush=True)
"""


@pytest.mark.parametrize("times", [1, 3])
def test_an_interrupt_in_a_finalizer_is_obeyed_in_silence(times):
    """Python drops it with a traceback, `Exception ignored in`; another in the next is heard too."""
    ends = f"times.append(0); len(times) > {times} or os.kill(os.getpid(), signal.SIGINT)"
    code = FINALIZED.format(ends=ends, work=f"times = []; [File() for _ in range({times})].clear()", after="pass")
    start = time.monotonic()
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=50)
    assert (answer.returncode, answer.stdout, answer.stderr) == (0, "up\nobeyed\n", "")
    assert time.monotonic() - start < WITHIN


def test_an_error_that_an_interrupt_led_to_is_an_interrupt(capsys):
    """h5py's locks end with `SystemError: ... returned a result with an exception set`."""

    def caused():
        raise SystemError("a result with an exception set") from KeyboardInterrupt()

    def of_its_own():
        raise SystemError("a result with an exception set") from ValueError()

    assert exit_code(caused) == 3
    assert capsys.readouterr().err == "oilfilm: interrupted\n"
    assert exit_code(of_its_own) == 4
    assert "internal error: SystemError" in capsys.readouterr().err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_error_after_a_signal_is_an_interrupt(capsys, number):
    """As of a compiled library that loses the interrupt and fails later, without a cause."""

    def forgetful():
        with suppress(KeyboardInterrupt):
            os.kill(os.getpid(), number)
            time.sleep(5.0)
        raise SystemError("half done")

    assert exit_code(forgetful) == 3
    assert capsys.readouterr().err == "oilfilm: interrupted\n"


def test_finalizers_are_silent_after_an_interrupt_alone():
    """What it leaves half built may fail in its finalizer; without an interrupt that is a fault of ours."""
    after = FINALIZED.format(ends="self.handle", work="os.kill(os.getpid(), 2)", after="File()")
    answer = subprocess.run([sys.executable, "-c", after], capture_output=True, text=True, check=False, timeout=50)
    assert (answer.stdout, answer.stderr) == ("up\nobeyed\n", "")
    alone = FINALIZED.format(ends="self.handle", work="raise KeyboardInterrupt", after="File()")
    answer = subprocess.run([sys.executable, "-c", alone], capture_output=True, text=True, check=False, timeout=50)
    assert answer.stdout == "up\nobeyed\n"
    assert "AttributeError" in answer.stderr


def test_threads_are_silent_after_an_interrupt_alone():
    """As that of a pool whose processes were ended: its futures are cancelled already."""
    failing = "import threading; one = threading.Thread(target=lambda: 1 / 0); one.start(); one.join()"
    after = FINALIZED.format(ends="pass", work="os.kill(os.getpid(), 2)", after=failing)
    answer = subprocess.run([sys.executable, "-c", after], capture_output=True, text=True, check=False, timeout=50)
    assert (answer.stdout, answer.stderr) == ("up\nobeyed\n", "")
    alone = FINALIZED.format(ends="pass", work="raise KeyboardInterrupt", after=failing)
    answer = subprocess.run([sys.executable, "-c", alone], capture_output=True, text=True, check=False, timeout=50)
    assert answer.stdout == "up\nobeyed\n"
    assert "ZeroDivisionError" in answer.stderr


def test_work_in_a_thread_is_given_up_at_once():
    code = f"""
import hashlib, signal
from oilfilm.cases.cli.terminal import exit_code
from oilfilm.cases.runs.interrupt import end_now, interruptible
def work():
    print("up", flush=True)
    return {LONG}
end_now(exit_code(lambda: interruptible(work)))
"""
    number, errors, delay = signalled(code)
    assert (number, errors) == (3, "oilfilm: interrupted\n")
    assert delay < WITHIN


def test_what_work_in_a_thread_gives_and_raises_comes_back():
    assert interruptible(lambda: 7) == 7
    with pytest.raises(KeyError, match="lost"):
        interruptible(lambda: {}["lost"])


def test_a_signal_before_the_commands_are_loaded():
    code = "import os, signal, sys\nimport oilfilm.cases.cli.start as start\nprint('up', flush=True)\n"
    code += "sys.modules['oilfilm.cases.cli.main'] = None\n"  # would fail to load
    code += "old = signal.signal\n"
    code += "def late(*words):\n    old(*words)\n    if words[0] == signal.SIGTERM: os.kill(os.getpid(), 15)\n"
    code += "signal.signal = late\nstart.main()"
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (answer.returncode, answer.stderr) == (3, "oilfilm: interrupted\n")


@pytest.mark.slow
def test_a_signal_to_all_processes_of_a_command_is_told_once(tmp_path):
    """As a service manager sends it: neither the server of processes nor a worker prints a traceback."""
    path = tmp_path / "sweep.toml"
    loads = [1e3 + number for number in range(400)]
    path.write_text(f'case = "209_radial_8900N"\n[sweep]\n"operation.radial_load_N" = {loads}\n')
    words = [*OILFILM, "batch", str(path), "-o", str(tmp_path / "out"), "--workers", "2", "--quiet"]
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    ) as process:
        started = time.monotonic()
        while not list(tmp_path.glob("**/points.sqlite*")) and time.monotonic() - started < 60.0:
            time.sleep(0.05)
        os.killpg(process.pid, signal.SIGTERM)
        printed, _ = process.communicate(timeout=60)
    assert process.returncode == 3
    assert printed.splitlines()[-1] == "oilfilm: interrupted"
    assert all("points are kept" in line for line in printed.splitlines()[:-1])


def test_logs_of_failures_are_few(tmp_path, monkeypatch):
    """The oldest go when another is written; files of others stay."""
    monkeypatch.setattr(terminal.tempfile, "tempdir", str(tmp_path))
    (tmp_path / "oilfilm-of_others.log").touch()
    logs = [terminal._log(ValueError(str(number))) for number in range(terminal.KEPT_LOGS + 3)]
    for age, log in enumerate(reversed(logs)):
        os.utime(log, (1e9 - age, 1e9 - age)) if os.path.exists(log) else None
    last = terminal._log(ValueError("last"))
    kept = {path.name for path in tmp_path.glob("*.log")}
    assert len(kept) == terminal.KEPT_LOGS + 1
    assert {"oilfilm-of_others.log", os.path.basename(last), os.path.basename(logs[-1])} <= kept
    assert "ValueError: last" in Path(last).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "redirection", "expected"),
    [
        ("list bearings", ">/dev/full", 4),
        ("schema", ">/dev/full", 4),
        ("schema", ">&-", 0),
        ("validate missing", "2>&-", 2),
        ("validate missing", "2>/dev/full", 2),
        ("validate 209_radial_8900N", ">&- 2>&- <&-", 0),
    ],
)
def test_closed_and_full_streams(words, redirection, expected, tmp_path):
    if "full" in redirection and not os.path.exists("/dev/full"):
        pytest.skip("no /dev/full")
    command = f"{' '.join(OILFILM)} {words} {redirection}"
    answer = subprocess.run(["sh", "-c", command], capture_output=True, text=True, check=False)
    assert answer.returncode == expected
    assert len(answer.stderr.splitlines()) == (expected == 4)
    assert "Traceback" not in answer.stderr


@pytest.mark.slow
def test_work_goes_on_when_nobody_reads_its_messages(tmp_path):
    """Standard error is a pipe whose reader has gone."""
    command = f"(sleep 0.5; {' '.join(OILFILM)} run 209_radial_8900N -o out >run.txt; echo $? >code) 2>&1 | true"
    subprocess.run(["sh", "-c", command], cwd=tmp_path, check=True)
    deadline = time.monotonic() + 120.0
    while not (tmp_path / "code").exists() and time.monotonic() < deadline:
        time.sleep(0.1)
    assert (tmp_path / "code").read_text() == "0\n"
    assert (tmp_path / "out" / "summary.json").exists()


def test_progress_is_told_in_lines_where_there_is_no_terminal(monkeypatch, capsys):
    monkeypatch.setattr(terminal, "FIRST_LINE", 0.05)
    with terminal.progress_bar(quiet=False) as show:
        show(2, 18, "films")
        time.sleep(0.3)
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "oilfilm: after 0 s: films, 2 of 18"
    assert 1 <= len(lines) <= 3  # after 0.05, 0.15, 0.35 s
    with terminal.progress_bar(quiet=True) as show:
        show(2, 18, "films")
        time.sleep(0.1)
    assert capsys.readouterr().err == ""


def test_a_compilation_is_told_once(capsys):
    import logging

    with terminal.progress_bar(quiet=False):
        for _ in range(3):
            logging.getLogger("oilfilm.ehl.compiled").info("compiling kernels")
    assert capsys.readouterr().err == "oilfilm: compiling kernels\n"


def test_compiling_a_kernel_is_logged_and_calling_it_again_is_not(caplog):
    from numba import njit

    kernel = njit(lambda x: 0.5 * x)
    with caplog.at_level("INFO", logger="oilfilm.ehl.compiled"):
        assert (kernel(3.0), kernel(5.0)) == (1.5, 2.5)
    assert [record.getMessage()[:17] for record in caplog.records] == ["compiling kernels"]


def test_the_cost_of_long_work_is_told_before_it_begins(capsys):
    from oilfilm.cases import load_case

    quick = load_case("6208_full_ceramic")  # solves the heaviest contact of each race
    assert output.run_films(quick) == 2
    assert output.run_films(replace(quick, film_source=FilmSource.ATLAS)) == 0
    case = replace(quick, film_source=FilmSource.SOLVED)
    output.report_cost(output.run_cost(case, 2), quiet=True)
    output.report_cost(output.run_cost(quick, 1), quiet=False)
    output.report_cost(output.run_cost(load_case("209_radial_8900N"), 2), quiet=False)  # without films
    assert capsys.readouterr().err == ""
    output.report_cost(output.run_cost(case, 1), quiet=False)
    text = "oilfilm: about 10 films on 257 nodes, 1 at a time: about 7 s\n"
    assert capsys.readouterr().err == text
    output.report_cost(output.table_cost(513, 3, 2), quiet=False)
    assert capsys.readouterr().err.endswith("360 films on 513 nodes or more, 2 at a time: about 7 min\n")
    output.report_cost(output.slip_cost(load_case("hirano_7000C"), 1), quiet=False)
    simulated = output.dynamics_cost(load_case("7008_combined"))
    assert simulated == ("0.1 s of 18 balls simulated", pytest.approx(0.1 * 18 * 1.6))
    planar = load_case("6304_planar")
    assert output.dynamics_cost(planar)[1] == pytest.approx(2.8)
    assert output.batch_cost(planar, 12, "dynamics")[1] == pytest.approx(12 * 2.8)
    assert output.batch_cost(case, 5, "run")[1] == pytest.approx(5 * output.run_cost(case, 1)[1])
    single = load_case("ball_on_disc")
    assert output.batch_cost(single, 3, "run")[1] == pytest.approx(3 * output.film_seconds(single.solver))
    assert output.batch_cost(case, 100, "torque")[0] == "100 points, at most 1 s each on one core"
    films = output.batch_cost(case, 10, "run")[0]
    assert films.startswith(f"10 points with at most {10 * output.run_films(case)} films, at most ")
    assert "slip at 51 speeds and 51 loads" in capsys.readouterr().err
