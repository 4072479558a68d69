"""Who is answered: this page in this browser, and nobody else."""

import http.client
import json
import threading
import time

import pytest

from mechsheet.drawing_page.answers import Studio
from mechsheet.drawing_page.server import DrawingServer


@pytest.fixture
def server(tmp_path):
    found = DrawingServer(Studio(None, tmp_path))
    found.start()
    yield found
    found.stop()


def reply(server, path=None, method="GET", body=None, **headers):
    """(status, text, headers) of a request; `Host` as an honest browser sends it, unless it is given."""
    own = server.origin.removeprefix("http://")
    connection = http.client.HTTPConnection("127.0.0.1", int(own.rpartition(":")[2]), timeout=20)
    names = {name.replace("_", "-"): value for name, value in headers.items() if value is not None}
    path = f"/{server.token}/" if path is None else path.format(token=server.token)
    connection.putrequest(method, path, skip_host=True)
    for name, value in ({"Host": own} | names).items():
        connection.putheader(name, value)
    if body is not None:
        connection.putheader("Content-Length", str(len(body)))
    connection.endheaders(body)
    answer = connection.getresponse()
    found = answer.status, answer.read().decode("utf-8", "replace"), dict(answer.getheaders())
    connection.close()
    return found


def asked(server, name, question, **headers):
    return reply(
        server,
        f"/{{token}}/ask/{name}",
        "POST",
        json.dumps(question).encode(),
        **{"Content_Type": "application/json"} | headers,
    )


def test_the_page_is_served_on_this_machine_only(server):
    assert server.address.startswith("http://127.0.0.1:")
    assert server._server.server_address[0] == "127.0.0.1"
    status, text, headers = reply(server)
    assert status == 200
    assert "<title>mechsheet draw</title>" in text
    assert "default-src 'none'" in headers["Content-Security-Policy"]
    assert headers["Cross-Origin-Resource-Policy"] == "same-origin"


@pytest.mark.parametrize("path", ["/", "/index.html", "/wrong/", "/wrong/ask/begin", "//", "/é/"])
def test_nothing_is_told_without_the_token(server, path):
    status, text, _ = reply(server, path.encode("utf-8").decode("latin-1") if path.isascii() else "/%C3%A9/")
    assert status == 403
    assert server.token not in text


def test_a_name_of_anothers_that_leads_here_gets_nothing(server):
    """DNS rebinding: the token may have been read somewhere, the name in `Host` is not ours."""
    port = server.origin.rpartition(":")[2]
    for host in (
        f"evil.example:{port}",
        "evil.example",
        f"localhost.evil.example:{port}",
        f"localhost:{port}",
        "127.0.0.1",
        "",
    ):
        assert reply(server, Host=host)[0] in (400, 403), host
        assert asked(server, "begin", {}, Host=host)[0] in (400, 403), host


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://127.0.0.1:1", "https://127.0.0.1", "file://"]
)
def test_a_page_of_another_origin_gets_nothing(server, origin):
    assert asked(server, "begin", {}, Origin=origin)[0] == 403


@pytest.mark.slow
def test_this_page_is_answered(server):
    status, text, _ = asked(server, "begin", {}, Origin=server.origin, Sec_Fetch_Site="same-origin")
    assert status == 200
    assert "four-bar" in json.loads(text)["templates"]


@pytest.mark.parametrize("site", ["cross-site", "same-site", "none"])
def test_a_question_from_elsewhere_in_the_browser_is_refused(server, site):
    assert asked(server, "begin", {}, Sec_Fetch_Site=site)[0] == 403


def test_a_link_from_another_page_does_not_open_it(server):
    assert reply(server, Sec_Fetch_Site="cross-site")[0] == 403
    assert reply(server, Sec_Fetch_Site="none")[0] == 200


@pytest.mark.parametrize(
    ("kind", "body", "status"),
    [
        ("text/plain", b"{}", 415),
        ("application/x-www-form-urlencoded", b"a=1", 415),
        ("application/json", b"{", 400),
        ("application/json", b"[1]", 400),
        ("application/json", b"[" * 100_000, 400),
        ("application/json", b"\xff\xfe", 400),
    ],
)
def test_only_json_tables_are_questions(server, kind, body, status):
    assert reply(server, "/{token}/ask/begin", "POST", body, Content_Type=kind)[0] == status


@pytest.mark.parametrize(
    ("length", "status"),
    [
        ("5000000", 413),
        ("9" * 5_000, 413),
        ("abc", 400),
        ("-1", 400),
        ("1_0", 400),
        ("+2", 400),
        ("1e3", 400),
        ("\u0663", 400),
        ("", 400),
        (None, 400),
    ],
)
def test_a_question_of_no_bearable_length_is_not_read(server, length, status):
    """Too long, or of a length that is no number: that is the asker's mistake, not the server's."""
    own = server.origin.removeprefix("http://")
    connection = http.client.HTTPConnection("127.0.0.1", int(own.rpartition(":")[2]), timeout=20)
    connection.putrequest("POST", f"/{server.token}/ask/begin", skip_host=True)
    for name, value in (("Host", own), ("Content-Type", "application/json"), ("Content-Length", length)):
        if value is not None:
            connection.putheader(name, value.encode())
    connection.endheaders()
    assert connection.getresponse().status == status


@pytest.mark.parametrize(
    "path", ["/{token}/../../etc/passwd", "/{token}/..%2f..%2fserver.py", "/{token}/server.py", "/{token}/ask/begin"]
)
def test_no_other_file_is_served(server, path):
    status, text, _ = reply(server, path)
    assert status in (404, 405)
    assert "import" not in text


@pytest.mark.parametrize(
    ("name", "question"),
    [
        ("look", {}),
        ("look", {"text": 5}),
        ("look", {"text": "", "at": "x"}),
        ("look", {"text": "", "at": 1e300}),
        ("look", {"text": "", "places": []}),
        ("edit", {"text": ""}),
        ("edit", {"text": "", "order": {"do": "nothing"}}),
        ("edit", {"text": "", "order": {"do": "move", "point": "A", "to": [1]}}),
        ("nothing", {}),
        ("template", {"name": "../four-bar"}),
    ],
)
def test_questions_that_make_no_sense_are_refused_in_words(server, name, question):
    status, text, _ = asked(server, name, question)
    assert status in (400, 404)
    assert json.loads(text)["errors"][0]


@pytest.mark.ci
def test_it_stops_when_the_last_page_has_been_closed(tmp_path):
    server = DrawingServer(Studio(None, tmp_path), patience=0.4)
    server.start()
    waiting = threading.Thread(target=server.wait)
    waiting.start()
    streams = []
    for _ in range(2):
        connection = http.client.HTTPConnection("127.0.0.1", int(server.origin.rpartition(":")[2]), timeout=20)
        connection.request("GET", f"/{server.token}/open")
        connection.getresponse().read(4)
        streams.append(connection)
    streams[0].close()
    time.sleep(1.5)
    assert waiting.is_alive()
    streams[1].close()
    waiting.join(20)
    assert not waiting.is_alive()
    server.stop()


@pytest.mark.slow
def test_it_waits_for_the_first_page(tmp_path):
    server = DrawingServer(Studio(None, tmp_path), patience=0.1)
    server.start()
    waiting = threading.Thread(target=server.wait)
    waiting.start()
    time.sleep(0.8)
    assert waiting.is_alive()
    server.stop()
    waiting.join(20)
    assert not waiting.is_alive()
