"""A large part passes through in pieces: what is not edited arrives as it was, and nothing of it twice."""

from livesheet.formats.new_values import Edit, RawXml

PART = b"<a><b>1</b><c>22</c><d/></a>"


def test_a_part_in_pieces_is_the_part_with_its_edits():
    raw, out = RawXml(), b""
    raw.feed(PART[:20])
    out += raw.passed(3)
    raw.replace(Edit(6, 7, b"10"))
    out += raw.passed(11)
    assert raw.cut(11, 14) == b"<c>"
    raw.feed(PART[20:])
    raw.replace(Edit(14, 16, b""))
    assert raw.end_of_tag(20) == 24
    out += raw.passed(18)
    raw.replace(Edit(20, 24, b"<d>3</d>"))
    out += raw.passed()
    assert out == b"<a><b>10</b><c></c><d>3</d></a>"
    assert raw.passed() == b""
