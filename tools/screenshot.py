"""A picture of a workbook as it opens in LibreOffice, after some clicks on its scroll bar.

Needs LibreOffice, Xvfb, xdotool and ImageMagick (apt-get install libreoffice-calc xvfb xdotool imagemagick).
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from pathlib import Path

DISPLAY = ":87"
SIZE = (1600, 1000)
START = 30
"""Seconds until LibreOffice shows the sheet, on a slow machine."""
ARROW = (1174, 180)
"""Where the right arrow of the scroll bar is, in pixels."""
COLORS = 96


def screenshot(workbook: Path, target: Path, clicks: int) -> None:
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
                _take(environment, target, clicks)
            finally:
                os.killpg(office.pid, 15)
                office.wait()
    finally:
        screen.terminate()
        screen.wait()


def _take(environment: dict[str, str], target: Path, clicks: int) -> None:
    def run(*command: str) -> None:
        subprocess.run(command, env=environment, check=True)

    time.sleep(START)
    run("xdotool", "key", "Escape")
    for _ in range(clicks):
        run("xdotool", "mousemove", str(ARROW[0]), str(ARROW[1]), "click", "1")
        time.sleep(1)
    run("xdotool", "mousemove", "700", "900")
    time.sleep(3)
    few = ["-depth", "8", "+dither", "-colors", str(COLORS), "-strip", "-define", "png:exclude-chunks=date,time"]
    run("import", "-window", "root", *few, str(target))
