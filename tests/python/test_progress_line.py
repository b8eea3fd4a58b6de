"""Progress without tqdm, and what is said of long runs."""

import sys

import geodisk
from geodisk._running import Bar, LongRun
from meshes import FACES, VERTICES


def test_progress_is_a_line_where_tqdm_is_not_installed(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    bar = Bar()
    bar(0.5, 123456)
    bar(1, 7)
    bar.close()
    lines = capsys.readouterr().err.split("\r")
    assert lines[1] == "geodisk: 50 %, 123456 samples"
    assert lines[2].rstrip() == "geodisk: 100 %, 7 samples" and len(lines[2]) == len(lines[1])
    assert lines[3].strip() == "" and lines[-1] == ""
    geodisk.sample(VERTICES, FACES, min_distance=0.5, progress=True)


def test_long_runs_are_told_of_once():
    run = LongRun()
    assert run.note(1, 0.01) is None  # Too early to know.
    assert run.note(5, 0.5) is None  # Ten seconds.
    assert run.note(6, 0.1) == "sampling takes about 60 s on this device"
    assert run.note(40, 0.5) is None
    unknown = LongRun()
    assert unknown.note(19, 0) is None
    assert unknown.note(21, 0) == "sampling takes more than 21 s on this device"
