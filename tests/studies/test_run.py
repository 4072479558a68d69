"""A study's folder: the same bytes however it was computed, whole after any end, nobody else's."""

import json
import shutil
import signal
import subprocess
import sys
import time
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from livesheet.diagnostics import OutputError
from mechsheet.diagnostics import MechsheetError, MissingProgramError
from mechsheet.studies import folder as folders
from mechsheet.studies import packages, parts, workers
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs
from mechsheet.studies.run import studied
from mechsheet.studies.workers import OF_A_PROCESS, memory_there, workers_within
from studying import contents, small, study_of

pq = pytest.importorskip("pyarrow.parquet")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole") / "study"
    found = studied(small(), folder, workers=1)
    return found, contents(folder)


@pytest.mark.slow
def test_every_design_is_tried_and_counted_once(whole):
    found, files = whole
    assert found.order.parts > 5
    assert found.result.designs == 30_000
    assert 0 < found.result.kept < 30_000
    assert found.result.kept + sum(count for _, count in found.result.failed) == 30_000
    told = json.loads(files["result.json"])
    assert told["kept"] == sum(pq.read_table(path).num_rows for path in found.folder.parts(found.order))


def test_the_rows_are_the_designs_kept_with_their_own_dimensions(whole):
    found, _ = whole
    designs = Designs(small())
    for path in found.folder.parts(found.order)[:2]:
        table = pq.read_table(path)
        assert table.column_names == ["design", *designs.names, "remarks", "set_apart"]
        numbers = table.column("design").to_numpy()
        values = designs.sampling.values(numbers - 1)
        for at, symbol in enumerate(designs.varied):
            assert np.array_equal(table.column(symbol).to_numpy(), values[:, at])
        assert np.all(table.column("mu_min").to_numpy() > 35)
        assert table.schema.field("mu_min").metadata[b"unit"].decode() == "°"


def test_the_front_and_the_best_are_of_all_parts(whole):
    found, _ = whole
    every = [row for path in found.folder.parts(found.order) for row in pq.read_table(path).to_pylist()]
    for row in found.front.to_pylist():
        better = [o for o in every if o["swing"] >= row["swing"] and o["mu_min"] >= row["mu_min"] and o != row]
        assert not [o for o in better if o["swing"] > row["swing"] or o["mu_min"] > row["mu_min"]]
    assert found.best.num_rows == 10


def test_what_is_missing_is_computed_again_and_nothing_else(whole, tmp_path):
    found, files = whole
    folder = tmp_path / "study"
    shutil.copytree(found.folder.path, folder)
    (folder / "result.json").unlink()
    there = sorted((folder / "parts").iterdir())
    there[1].unlink()
    there[3].write_bytes(there[3].read_bytes()[:100])  # cut off by a full disk
    kept = there[0].stat().st_mtime_ns
    studied(small(), folder, workers=1, resume=True)
    assert contents(folder) == files
    assert there[0].stat().st_mtime_ns == kept


@pytest.mark.ci
def test_several_processes_write_the_same_bytes(whole, tmp_path):
    studied(small(), tmp_path / "study", workers=2)
    assert contents(tmp_path / "study") == whole[1]


@pytest.mark.ci
def test_a_study_that_is_killed_again_and_again_ends_with_the_same_bytes(whole, tmp_path):
    """Killed without a word, at three times that nobody chose; then it is resumed to its end."""
    description = tmp_path / "four-bar.toml"  # whose name stands in the commands
    description.write_text(small().text, encoding="utf-8")
    folder = tmp_path / "study"
    random = np.random.default_rng(11)
    command = [sys.executable, "-m", "mechsheet", "study", str(description), "-o", str(folder), "--workers", "1"]
    for _ in range(3):
        run = subprocess.Popen([*command, *(["--resume"] if folder.exists() else [])], stdout=subprocess.DEVNULL)
        begun = len(list(folder.glob("parts/*.parquet")))
        until = time.monotonic() + 60
        while run.poll() is None and time.monotonic() < until and len(list(folder.glob("parts/*.parquet"))) < begun + 1:
            time.sleep(0.01)
        time.sleep(float(random.random()) * 0.05)
        run.send_signal(signal.SIGKILL if hasattr(signal, "SIGKILL") else signal.SIGTERM)
        run.wait()
    subprocess.run([*command, "--resume"], check=True, stdout=subprocess.DEVNULL)
    for rest in (*folder.rglob(".*.tmp"),):  # what a kill leaves behind is nobody's file
        rest.unlink()
    assert contents(folder) == whole[1]


@pytest.mark.ci
@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="nothing kills a process without a word here")
def test_a_study_that_is_killed_leaves_no_process_behind(tmp_path):
    """Its processes would wait for parts for ever, and hold their memory."""
    description = tmp_path / "four-bar.toml"
    description.write_text(small(3_000_000).text, encoding="utf-8")
    folder = tmp_path / "study"
    command = [sys.executable, "-m", "mechsheet", "study", str(description), "-o", str(folder), "--workers", "2"]
    run = subprocess.Popen(command, stdout=subprocess.PIPE)
    until = time.monotonic() + 60
    while not list(folder.glob("parts/*.parquet")):
        assert run.poll() is None and time.monotonic() < until
        time.sleep(0.05)
    run.kill()
    run.communicate(timeout=60)  # ends when nobody holds its output any more


# --- folders ---------------------------------------------------------------------------------------------------------------


def test_a_study_that_was_begun_is_not_begun_again(whole, tmp_path):
    folder = tmp_path / "study"
    shutil.copytree(whole[0].folder.path, folder)
    with pytest.raises(OutputError, match="has been begun here"):
        studied(small(), folder, workers=1)


def test_the_folder_of_another_study_is_left_alone(whole, tmp_path):
    folder = tmp_path / "study"
    shutil.copytree(whole[0].folder.path, folder)
    with pytest.raises(OutputError, match=r"another study: it differs in designs.*description"):
        studied(small(20_000), folder, workers=1, resume=True)
    assert contents(folder) == whole[1]


@pytest.mark.slow
def test_a_study_without_a_part_makes_room_for_another(whole, tmp_path):
    """Nobody answered, or the disk was full from the beginning: another try needs no other folder."""
    folder = tmp_path / "study"
    (folder / "parts").mkdir(parents=True)
    (folder / ".study.json.1234.tmp").touch()
    studied(small(3_000), folder, workers=1)
    for path in (*folder.glob("parts/*.parquet"), folder / ".study.json.1234.tmp"):
        path.unlink()
    studied(small(), folder, workers=1)
    assert contents(folder) == whole[1]


def test_a_folder_of_something_else_is_left_alone(tmp_path):
    (tmp_path / "letter.txt").write_text("dear")
    with pytest.raises(OutputError, match="holds other files"):
        studied(small(), tmp_path, workers=1)
    with pytest.raises(OutputError, match="is a file"):
        studied(small(), tmp_path / "letter.txt", workers=1)
    with pytest.raises(OutputError, match="no study to resume"):
        studied(small(), tmp_path / "none", workers=1, resume=True)


def test_other_releases_are_told_before_anything_is_mixed(whole, tmp_path):
    folder = tmp_path / "study"
    shutil.copytree(whole[0].folder.path, folder)
    manifest = json.loads((folder / "study.json").read_text(encoding="utf-8"))
    manifest["versions"]["numpy"] = "1.0"
    (folder / "study.json").write_text(json.dumps(manifest), encoding="utf-8")
    with pytest.raises(OutputError, match=r"begun with numpy 1\.0 \(here "):
        studied(small(), folder, workers=1, resume=True)


def test_a_worker_with_other_releases_does_not_compute(whole):
    order = whole[0].order
    other = parts.Order(order.text, order.designs, order.size, (("mechsheet", "0"), *order.versions[1:]))
    with pytest.raises(parts.VersionsError):
        parts.compute(other, 0)


@pytest.mark.slow
def test_a_full_disk_ends_the_study_and_keeps_what_is_done(monkeypatch, tmp_path):
    written = []

    def full(path: Path, data: bytes) -> None:
        if len(written) == 3:
            raise OutputError("no space left on the disk")
        written.append(path)
        replace_file(path, data)

    replace_file = folders.replace_file
    monkeypatch.setattr(folders, "replace_file", full)
    with pytest.raises(OutputError, match="no space left"):
        studied(small(), tmp_path / "study", workers=1)
    monkeypatch.undo()
    assert len(list((tmp_path / "study" / "parts").iterdir())) == 2
    assert studied(small(), tmp_path / "study", workers=1, resume=True).result.designs == 30_000


def test_a_missing_package_is_told_with_how_to_get_it(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(MissingProgramError, match=r"(?s)pyarrow is not installed.*mechsheet\[study\]"):
        studied(small(), tmp_path / "study", workers=1)
    assert not (tmp_path / "study").exists()
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingProgramError, match=r"(?s)distributed is not installed.*mechsheet\[dask\]"):
        packages.distributed()


# --- sizes -----------------------------------------------------------------------------------------------------------------


def test_parts_are_neither_too_many_nor_too_large():
    for designs, least, most in [(1, 1, 1), (100_000, 10, 64), (10**7, 100, 200), (10**12, 50_000, 100_000)]:
        order = parts.order_of("", designs)
        assert least <= order.parts <= most
        spans = [order.span(0), order.span(order.parts - 1)]
        assert spans[0].start == 0
        assert spans[1].stop == designs
        assert len(spans[1]) > 0


def test_memory_decides_how_many_processes_there_are():
    assert workers_within(8, None) == 8
    assert workers_within(8, 4 * OF_A_PROCESS) == 3  # and the one that writes
    assert workers_within(1, OF_A_PROCESS) == 1
    with pytest.raises(MechsheetError, match="too little"):
        workers_within(2, 2**20)


def test_a_container_with_little_memory_gets_fewer_processes(monkeypatch, tmp_path):
    """What it may have counts, not the machine's cores; who asks for so many processes gets them."""
    monkeypatch.setattr(workers, "_cores", lambda: 64)
    limit, none = tmp_path / "memory.max", tmp_path / "none"
    monkeypatch.setattr(workers, "LIMITS", (str(limit), str(none)))
    limit.write_text(f"{12 * OF_A_PROCESS}\n")
    assert memory_there() == 12 * OF_A_PROCESS
    assert workers_within(None, None) == 8
    assert workers_within(64, None) == 64
    limit.write_text(f"{OF_A_PROCESS // 2}\n")
    assert workers_within(None, None) == 1
    limit.write_text("max\n")
    assert memory_there() > 2**28


@pytest.mark.ci
@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not say how much a process has had")
def test_a_process_has_as_much_memory_as_is_counted_with(tmp_path):
    """Whatever --limit-memory promises follows from this: a full part of which everything is kept, of many columns."""
    summaries = "".join(f'more_{number} = {{ of = "theta14", take = "max" }}\n' for number in range(40))
    text = study_of('[study]\nsample = "sobol"\ncount = 65536\nvary = { a2 = [20, 30] }', rows=13).text
    path = tmp_path / "many.toml"
    path.write_text(text.replace("[summary]\n", f"[summary]\n{summaries}"), encoding="utf-8")
    script = (
        "import re, sys; from pathlib import Path; from mechsheet.studies.parts import Order, compute, versions;"
        "compute(Order(Path(sys.argv[1]).read_text('utf-8'), 65536, 65536, tuple(versions().items())), 0);"
        "print(re.search('VmHWM:(.*) kB', Path('/proc/self/status').read_text()).group(1))"  # maxrss has its parent's, too
    )
    done = subprocess.run([sys.executable, "-c", script, str(path)], check=True, capture_output=True, text=True)
    assert 1024 * int(done.stdout) < OF_A_PROCESS


@pytest.mark.ci
@pytest.mark.slow
def test_a_chunk_takes_no_more_memory_for_a_long_table():
    """2,048 designs over 1,801 rows: a column of all of them would take 28 MiB."""
    designs = Designs(study_of("[study]\nvary = { a2 = [10, 30, 0.25], a3 = [55, 65, 0.25] }", rows=1_801))
    kept_of(designs, 0, 16)
    tracemalloc.start()
    try:
        kept_of(designs, 0, 2_048)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert most < 2_048 * 1_801 * 2


def test_a_design_without_a_number_is_null(tmp_path):
    mechanism = study_of('[study]\nvary = { a2 = [20, 200, 20] }\nminimize = ["swing"]')
    found = studied(mechanism, tmp_path / "study", workers=1)
    table = pq.read_table(found.folder.part(0))
    assert table.column("swing").null_count > 0
    assert table.num_rows == 10
    assert found.ranked.best[0] == 1
