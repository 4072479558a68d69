"""A picture of a workbook as it opens in LibreOffice, after some cells have been typed into.

Needs LibreOffice, Xvfb and xdotool (apt-get install libreoffice-calc xvfb xdotool).
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

from PIL import Image, ImageGrab

DISPLAY = ":87"
SIZE = (1366, 768)
"""The screen of a small notebook: what a class sees without scrolling."""
PATIENCE = 60
"""Seconds until LibreOffice must have opened its window, on a slow machine."""
SETTLED = 6
"""Seconds from its window to all of its charts."""
NAME_BOX = "ctrl+shift+t"
"""The keys that lead to the box in which a cell is chosen by its name."""
BARE = {"SAL_USE_VCLPLUGIN": "gen"}
"""LibreOffice draws its window by itself: on a bare screen it finds no desktop whose means it could use."""
SETTINGS = (
    '<oor:items xmlns:oor="http://openoffice.org/2001/registry" xmlns:xs="http://www.w3.org/2001/XMLSchema">'
    '<item oor:path="/org.openoffice.Office.Linguistic/SpellChecking">'
    '<prop oor:name="IsSpellAuto" oor:op="fuse"><value>false</value></prop></item></oor:items>'
)
"""Symbols are not underlined as if they were misspelt."""


def screenshot(workbook: Path, typed: Mapping[str, str]) -> Image.Image:
    """Open a workbook in a window of its own, type into cells that have these names, take the picture."""
    environment = os.environ | BARE | {"DISPLAY": DISPLAY}
    screen = subprocess.Popen(["Xvfb", DISPLAY, "-screen", "0", f"{SIZE[0]}x{SIZE[1]}x24"], stderr=subprocess.DEVNULL)
    try:
        time.sleep(2)
        with tempfile.TemporaryDirectory() as folder:
            user = Path(folder) / "profile" / "user"
            user.mkdir(parents=True)
            (user / "registrymodifications.xcu").write_text(SETTINGS)
            profile = f"-env:UserInstallation={user.parent.as_uri()}"
            command = ["soffice", profile, "--norestore", "--nologo", "--nofirststartwizard", str(workbook)]
            office = subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL, start_new_session=True)
            try:
                return _taken(environment, workbook.name, typed)
            finally:
                os.killpg(office.pid, 15)
                office.wait()
    finally:
        screen.terminate()
        screen.wait()


def _taken(environment: dict[str, str], title: str, typed: Mapping[str, str]) -> Image.Image:
    def run(*command: str) -> int:
        return subprocess.run(["xdotool", *command], check=False, env=environment, stdout=subprocess.DEVNULL).returncode

    until = time.monotonic() + PATIENCE
    while run("search", "--name", title):
        if time.monotonic() > until:
            raise TimeoutError(f"LibreOffice has not opened {title}")
        time.sleep(1)
    time.sleep(SETTLED)
    run("key", "Escape")
    for name, value in typed.items():
        run("key", NAME_BOX)
        time.sleep(1)
        run("key", "ctrl+a")
        for text in (name, value):
            run("type", text)
            run("key", "Return")
            time.sleep(1)
    run("key", "ctrl+Home")  # where no hint of a cell covers others
    run("mousemove", "700", "700")
    time.sleep(3)
    return ImageGrab.grab(xdisplay=DISPLAY)
