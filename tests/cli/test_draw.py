"""`mechsheet draw`: the address, the end, and what is refused before a page is opened."""

import http.client
import os
import signal
import subprocess
import sys
import time

import pytest

import mechsheet
from command_line import run

HEARING = """
import signal
from mechsheet.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell starts what runs in the background deaf to it
main()
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals are another matter there")
def test_it_serves_until_ctrl_c(tmp_path):
    (tmp_path / "mine.toml").write_text(mechsheet.template("four-bar").text, encoding="utf-8")
    command = [sys.executable, "-c", HEARING, "draw", "mine.toml", "--no-browser"]
    environment = os.environ | {"PYTHONUNBUFFERED": "1"}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    running = subprocess.Popen(command, cwd=tmp_path, text=True, env=environment, **pipes)
    try:
        address = running.stdout.readline().strip()
        host, _, path = address.removeprefix("http://").partition("/")
        connection = http.client.HTTPConnection(host, timeout=30)
        connection.request("GET", f"/{path}")
        assert connection.getresponse().status == 200
        running.send_signal(signal.SIGINT)
        _, errors = running.communicate(timeout=30)
    finally:
        running.kill()
    assert host.startswith("127.0.0.1:")
    assert running.returncode == 0
    assert "Traceback" not in errors


@pytest.mark.parametrize(
    ("name", "said"),
    [("mine.xlsx", "a .toml file"), ("nowhere/mine.toml", "folder is not there"), ("folder.toml", "directory")],
)
def test_what_is_no_description_is_refused(tmp_path, monkeypatch, name, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.toml").mkdir()
    result = run("draw", name, "--no-browser")
    assert result.exit_code == 2
    assert said in result.stderr


def test_the_browser_is_opened_with_the_whole_address(tmp_path, monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", lambda address: opened.append(address) or True)
    monkeypatch.setattr("mechsheet.drawing_page.server.DrawingServer.wait", lambda _: time.sleep(0))
    monkeypatch.chdir(tmp_path)
    result = run("draw")
    assert result.exit_code == 0
    assert opened == [result.stdout.strip()]
