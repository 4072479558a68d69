"""A fault says where its key stands, or would stand."""

from mechsheet.description.text.source import parse


def test_fault_at_a_key_that_is_not_written() -> None:
    source = parse("format = 1\n[driver]\nstart = 0\n", "x.toml")
    fault = source.fault(("driver", "link"), "is missing")
    assert (fault.line, fault.key, fault.source) == (2, "driver.link", "[driver]")


def test_disturbing_characters_are_escaped() -> None:
    source = parse('format = 1\n"a\\u001b[2Jb" = 1\n', "x.toml")
    fault = source.fault(("a\x1b[2Jb",), "unknown key")
    assert fault.key == '"a\\x1b[2Jb"'
