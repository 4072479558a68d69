"""A picture of a workbook as it opens in LibreOffice, after some clicks on its scroll bar.

Needs LibreOffice, Xvfb and xdotool (apt-get install libreoffice-calc xvfb xdotool).
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from pathlib import Path

from PIL import Image, ImageGrab

DISPLAY = ":87"
SIZE = (1366, 768)
"""The screen of a small notebook: what a class sees without scrolling."""
START = 30
"""Seconds until LibreOffice shows the sheet, on a slow machine."""
ARROW = (1152, 195)
"""Where the right arrow of the scroll bar is, in pixels."""


def screenshot(workbook: Path, clicks: int) -> Image.Image:
    """Open a workbook in a window of its own, click the scroll bar's arrow `clicks` times, take the picture."""
    environment = os.environ | {"DISPLAY": DISPLAY}
    screen = subprocess.Popen(["Xvfb", DISPLAY, "-screen", "0", f"{SIZE[0]}x{SIZE[1]}x24"], stderr=subprocess.DEVNULL)
    try:
        time.sleep(2)
        with tempfile.TemporaryDirectory() as folder:
            profile = f"-env:UserInstallation={(Path(folder) / 'profile').as_uri()}"
            command = ["soffice", profile, "--norestore", "--nologo", "--nofirststartwizard", str(workbook)]
            office = subprocess.Popen(command, env=environment, stderr=subprocess.DEVNULL, start_new_session=True)
            try:
                return _taken(environment, clicks)
            finally:
                os.killpg(office.pid, 15)
                office.wait()
    finally:
        screen.terminate()
        screen.wait()


def _taken(environment: dict[str, str], clicks: int) -> Image.Image:
    def run(*command: str) -> None:
        subprocess.run(command, env=environment, check=True)

    time.sleep(START)
    run("xdotool", "key", "Escape")
    for _ in range(clicks):
        run("xdotool", "mousemove", str(ARROW[0]), str(ARROW[1]), "click", "1")
        time.sleep(1)
    run("xdotool", "mousemove", "700", "700")
    time.sleep(3)
    return ImageGrab.grab(xdisplay=DISPLAY)
