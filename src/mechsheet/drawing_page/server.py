"""The server of the page: for this machine, for whoever has the address, for nobody's other page.

It listens on 127.0.0.1 alone, and every address begins with a token that nobody can guess. Another page in the same browser
could still send requests to this port, by its number or by a name of its own that leads to 127.0.0.1 (DNS rebinding): so a
request is answered only where `Host` is this server's own address and `Origin` and `Sec-Fetch-Site`, where a browser sends
them, say that it comes from this page. No answer depends on the one before.

Bottle finds the answer to an address; the standard library's server, a thread for each request, does the rest.
"""

from __future__ import annotations

import json
import secrets
import threading
import time
from collections.abc import Callable, Iterator
from importlib.resources import files
from socketserver import ThreadingMixIn
from typing import Any
from wsgiref.simple_server import WSGIRequestHandler, WSGIServer, make_server

import bottle

from mechsheet.diagnostics import MechsheetError
from mechsheet.drawing_page.answers import Studio
from mechsheet.drawing_page.questions import Impossible, Refusal
from mechsheet.words.catalogue import LANGUAGES, in_language, texts

ADDRESS, ANY_PORT = "127.0.0.1", 0
LARGEST_QUESTION = 4_000_000
"""Bytes of a question: a description is smaller than 1,000,000."""

BEAT = 1.0
"""Seconds between two signs of life to each open page."""

KINDS = {
    "html": "text/html; charset=utf-8",
    "css": "text/css; charset=utf-8",
    "js": "text/javascript; charset=utf-8",
    "svg": "image/svg+xml",
}
HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}


class _Threads(ThreadingMixIn, WSGIServer):
    """A thread for each request; none keeps the program from ending."""

    daemon_threads = True
    allow_reuse_address = False


class _Quiet(WSGIRequestHandler):
    """Says nothing of every request."""

    def log_message(self, *_: Any) -> None:
        """Nothing."""


class DrawingServer:
    """The page of one description, from `start` until `stop`, or until no page has been open for `patience` seconds.

    studio    what the page may ask
    patience  seconds without an open page after which it stops; reloading a page takes less
    """

    def __init__(self, studio: Studio, patience: float = 3.0) -> None:
        self.studio = studio
        self.token = secrets.token_urlsafe(24)
        self.patience = patience
        self._pages = 0
        self._left = 0.0
        self._lock = threading.Lock()
        self._stopped = threading.Event()
        self._server = make_server(ADDRESS, ANY_PORT, self._guarded(self._app()), _Threads, _Quiet)
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.1,), daemon=True)

    @property
    def origin(self) -> str:
        """`http://127.0.0.1:50123`."""
        return f"http://{ADDRESS}:{self._server.server_port}"

    @property
    def address(self) -> str:
        """Where the page is."""
        return f"{self.origin}/{self.token}/"

    def start(self) -> None:
        """Begin to answer."""
        self._thread.start()

    def wait(self) -> None:
        """Until every page that was opened has been closed, or `stop`."""
        while not self._stopped.wait(0.2):
            with self._lock:
                gone = self._pages == 0 and self._left and time.monotonic() - self._left > self.patience
            if gone:
                return

    def stop(self) -> None:
        """End; pages that are still open say so."""
        self._stopped.set()
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    # --- who is answered -----------------------------------------------------------------------------------------------

    def _guarded(self, app: Callable[..., Any]) -> Callable[..., Any]:
        """The application behind the checks of who asks; a stranger learns nothing."""

        def answer(environ: dict[str, Any], start: Callable[..., Any]) -> Any:
            if not self._trusted(environ):
                start("403 Forbidden", [("Content-Type", "text/plain; charset=utf-8"), *HEADERS.items()])
                return [b"This address is for the page of mechsheet draw only.\n"]
            return app(environ, start)

        return answer

    def _trusted(self, environ: dict[str, Any]) -> bool:
        own = self.origin.removeprefix("http://")
        path = str(environ.get("PATH_INFO", "")).encode("latin-1", "replace")
        token = path.split(b"/")[1] if path.startswith(b"/") else b""
        fetched, method = environ.get("HTTP_SEC_FETCH_SITE"), environ.get("REQUEST_METHOD")
        opened = fetched == "none" or (fetched is None)  # typed into the address line, or no browser
        return (
            environ.get("HTTP_HOST") == own
            and environ.get("HTTP_ORIGIN") in (None, self.origin)
            and (fetched == "same-origin" or (opened and (method == "GET" or fetched is None)))
            and secrets.compare_digest(token, self.token.encode())
        )

    # --- what is answered ----------------------------------------------------------------------------------------------

    def _app(self) -> bottle.Bottle:
        app = bottle.Bottle(catchall=True)
        root = f"/{self.token}"
        app.route(f"{root}/", "GET", self._page("index.html"))
        app.route(f"{root}/words.js", "GET", self._words)
        app.route(f"{root}/open", "GET", self._open)
        app.route(f"{root}/ask/<name:re:[a-z_]+>", "POST", self._ask)
        for entry in sorted(files("mechsheet.drawing_page").joinpath("page").iterdir(), key=lambda each: each.name):
            if entry.name.rpartition(".")[2] in KINDS:
                app.route(f"{root}/{entry.name}", "GET", self._page(entry.name))
        app.default_error_handler = lambda error: error.body if isinstance(error.body, str) else "not found\n"
        return app

    def _page(self, name: str) -> Callable[[], bytes]:
        """What answers with a file of the page."""

        def answer() -> bytes:
            self._headers(KINDS[name.rpartition(".")[2]])
            return files("mechsheet.drawing_page").joinpath("page", name).read_bytes()

        return answer

    def _headers(self, kind: str) -> None:
        bottle.response.content_type = kind
        for header, text in HEADERS.items():
            bottle.response.set_header(header, text)

    def _words(self) -> str:
        self._headers(KINDS["js"])
        found = {language: texts(language, "draw.") for language in LANGUAGES}
        return f"export const WORDS = {json.dumps(found, ensure_ascii=False)};\n"

    def _open(self) -> Iterator[bytes]:
        """A stream that lasts as long as the page is open: a sign of life each second, until the page has gone."""
        self._headers("text/event-stream; charset=utf-8")
        return self._beats()

    def _beats(self) -> Iterator[bytes]:
        with self._lock:
            self._pages += 1
        try:
            yield b": open\n\n"
            while not self._stopped.wait(BEAT):
                yield b": open\n\n"
        finally:
            with self._lock:
                self._pages -= 1
                self._left = time.monotonic()

    def _ask(self, name: str) -> Any:
        """A question as JSON, its answer as JSON, or the bytes of a file that was asked for."""
        question = self._question()
        try:
            answer = self.studio.answer(name, question)
        except MechsheetError as error:  # a user's mistake is an answer like any other
            answer = {"errors": [str(in_language(fault, str(question.get("spoken")))) for fault in error.faults]}
        except Impossible as error:
            answer = {"errors": [error.text(str(question.get("spoken")))]}
        except Refusal as refusal:
            bottle.response.status = refusal.status
            answer = {"errors": [str(refusal)]}
        if isinstance(answer, bytes):
            self._headers("application/octet-stream")
            return answer
        self._headers("application/json; charset=utf-8")
        return json.dumps(answer, ensure_ascii=False, allow_nan=False, separators=(",", ":"))

    def _question(self) -> dict[str, Any]:
        """What was asked. Raises HTTPError for anything but a JSON table of a bearable size."""
        request = bottle.request
        if request.content_type.partition(";")[0].strip().lower() != "application/json":
            raise bottle.HTTPError(415, "a question is JSON\n")
        said = str(request.environ.get("CONTENT_LENGTH") or "")
        if not (said.isascii() and said.isdigit()):
            raise bottle.HTTPError(400, "no length\n")
        if len(said) > len(str(LARGEST_QUESTION)) or int(said) > LARGEST_QUESTION:
            raise bottle.HTTPError(413, "the question is too long\n")
        try:
            found = json.loads(request.environ["wsgi.input"].read(int(said)))
        except (ValueError, RecursionError):
            raise bottle.HTTPError(400, "no JSON\n") from None
        if not isinstance(found, dict):
            raise bottle.HTTPError(400, "a question is a table\n")
        return found
