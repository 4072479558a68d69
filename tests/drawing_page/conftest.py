"""A page of `mechsheet draw` in a real browser: one browser for all tests, a server and a context of its own for each."""

import shutil
import time
from contextlib import contextmanager
from dataclasses import dataclass, field

import pytest

from folders import TEMPLATES
from mechsheet.drawing_page.answers import Studio
from mechsheet.drawing_page.server import DrawingServer

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"]
WAITS = 30_000
"""Milliseconds: the machine may be busy with other tests."""


@pytest.fixture(scope="session")
def browser():
    playwright = pytest.importorskip("playwright.sync_api")
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))
    with playwright.sync_playwright() as started:
        found = started.chromium.launch(executable_path=path, args=FLAGS)
        yield found
        found.close()


@dataclass
class Opened:
    """A page, its server, and what it complained about."""

    page: object
    server: DrawingServer
    complaints: list = field(default_factory=list)
    asked: set = field(default_factory=set)
    """Questions that have no answer yet."""

    def look(self):
        """Settle: no question is on its way."""
        self.page.wait_for_selector("body[data-ready=yes]", timeout=WAITS)

    def text(self):
        return self.page.input_value("#text")

    def place(self, point):
        """Where a point is on the screen."""
        box = self.page.locator(f'[data-point="{point}"] .dot').bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self, point, by):
        """Drag a point by so many pixels, as a hand does, and wait until all has followed."""
        self.pull(point, by)
        self.quiet()

    def pull(self, point, by, steps=6):
        """Drag a point, and go on at once."""
        x, y = self.place(point)
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        for n in range(1, steps + 1):
            mouse.move(x + by[0] * n / steps, y + by[1] * n / steps)
        mouse.up()

    def on_sheet(self, place):
        """A place of the plane on the screen."""
        found = self.page.evaluate("async p => (await import('./view.js')).toScreen(...p)", list(place))
        box = self.page.locator("#canvas").bounding_box()
        return box["x"] + found[0], box["y"] + found[1]

    def click(self, place):
        self.page.mouse.click(*self.on_sheet(place))
        self.page.wait_for_timeout(60)

    def until(self, script, argument=None):
        """Wait until a script says so; asked from outside, for the page's own policy runs no text as a script."""
        last = time.monotonic() + WAITS / 1000
        while not self.page.evaluate(script, argument):
            assert time.monotonic() < last, f"never became true: {script}"
            self.page.wait_for_timeout(25)

    def begun(self, request):
        """A question is on its way."""
        if "/ask/" in request.url:
            self.asked.add(request)

    def ended(self, request):
        """A question has its answer."""
        self.asked.discard(request)

    def quiet(self):
        """Wait until the page has every answer, and asks nothing more."""
        for _ in range(3):
            self.page.wait_for_timeout(100)
            while self.asked:
                self.page.wait_for_timeout(25)

    @contextmanager
    def held(self, question):
        """Questions of this name wait for their answers until the block ends."""
        waiting, over = [], []

        def hold(route):
            if over:
                route.continue_()
            else:
                waiting.append(route)

        self.page.route(f"**/ask/{question}", hold)
        yield
        assert waiting, f"nobody has asked: {question}"
        over.append(True)
        for route in waiting:
            route.continue_()

    def said(self, words):
        """Wait until the page shows some words."""
        self.page.get_by_text(words).first.wait_for(timeout=WAITS)


@pytest.fixture
def opening(browser):
    """Opens a description (None: an empty sheet) on a page; everything ends with the test."""
    opened, contexts = [], []

    def open_page(path=None, folder=None, server=None, **options):
        if server is None:
            server = DrawingServer(Studio(path, folder or (path.parent if path else None), "en"))
            server.start()
        context = browser.new_context(viewport={"width": 1300, "height": 860}, locale="en-GB", **options)
        context.set_default_timeout(WAITS)
        contexts.append(context)
        page = context.new_page()
        found = Opened(page, server)
        page.on("console", lambda message: found.complaints.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: found.complaints.append(str(error)))
        page.on("request", found.begun)
        page.on("requestfinished", found.ended)
        page.on("requestfailed", found.ended)
        page.goto(server.address)
        found.look()
        opened.append(found)
        return found

    yield open_page
    for found in opened:
        assert found.complaints == []
    for context in contexts:
        context.close()
    for server in {id(found.server): found.server for found in opened}.values():
        server.stop()


@pytest.fixture
def four_bar(tmp_path):
    path = tmp_path / "mine.toml"
    shutil.copy(TEMPLATES / "four-bar.toml", path)
    return path
