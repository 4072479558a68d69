"""A study on a Dask cluster: the bytes of one process, whoever computes them and whoever dies meanwhile."""

import os
import signal
import socket

import pytest

from mechsheet.diagnostics import MechsheetError
from mechsheet.studies import workers
from mechsheet.studies.run import studied
from studying import contents, small

distributed = pytest.importorskip("distributed")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


@pytest.fixture
def two_workers():
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=":0", host="127.0.0.1", silence_logs=50
    ) as running:
        yield running


@pytest.mark.ci
def test_a_worker_that_is_killed_in_the_middle_takes_nothing_with_it(two_workers, tmp_path):
    (tmp_path / "one").mkdir()
    (tmp_path / "two").mkdir()
    studied(small(), tmp_path / "one" / "study", workers=1)
    with distributed.Client(two_workers) as client:
        workers = client.run(os.getpid)
    assert len(workers) == 2
    killed = []

    def say(progress):
        if progress.done and not killed:
            killed.append(next(iter(workers.values())))
            os.kill(killed[0], getattr(signal, "SIGKILL", signal.SIGTERM))

    found = studied(small(), tmp_path / "two" / "study", on=two_workers.scheduler_address, tell=say)
    assert killed
    assert found.result.designs == 30_000
    assert contents(tmp_path / "two" / "study") == contents(tmp_path / "one" / "study")


def test_a_cluster_without_workers_is_told(monkeypatch, tmp_path):
    monkeypatch.setattr(workers, "SECONDS", 0.5)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=":0", host="127.0.0.1", silence_logs=50) as running,
        pytest.raises(MechsheetError, match="has no workers"),
    ):
        studied(small(), tmp_path / "study", on=running.scheduler_address)


@pytest.mark.slow
def test_an_address_that_nobody_answers_is_told(monkeypatch, tmp_path):
    monkeypatch.setattr(workers, "SECONDS", 1)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with pytest.raises(MechsheetError, match="nobody answers"):
        studied(small(), tmp_path / "study", on=f"tcp://127.0.0.1:{port}")
    assert not list((tmp_path / "study" / "parts").iterdir())


@pytest.mark.parametrize(
    ("address", "words"),
    [("", "missing port"), ("127.0.0.1", "missing port"), ("nonsense://x", "unknown address scheme"),
     ("tcp://x:port", "invalid literal"), ("tls://127.0.0.1:8786", "needs certificates")],
)  # fmt: skip
def test_what_is_no_address_is_told_at_once(monkeypatch, tmp_path, address, words):
    """A client of such an address would wait for its own end, and say so in a traceback."""
    monkeypatch.setattr(distributed, "Client", None)
    with pytest.raises(MechsheetError, match=words):
        studied(small(), tmp_path / "study", on=address)
    assert not list((tmp_path / "study" / "parts").iterdir())
