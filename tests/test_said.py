"""Messages that keep what they are made of."""

import pickle
from gettext import NullTranslations

import pytest

from livesheet.said import reason, say, say_count, translated
from mechsheet.model import Label


class Patterns(NullTranslations):
    """A catalogue with plural forms as Polish has them: one, few, many."""

    def __init__(self, patterns):
        super().__init__()
        self.patterns = patterns

    def gettext(self, message):
        return self.patterns.get(message, message)

    def ngettext(self, msgid1, msgid2, n):
        return self.patterns[msgid1, msgid2][0 if n == 1 else 1 if n < 5 else 2]


def in_turkish(text, patterns):
    return translated(text, Patterns(patterns), "tr")


def test_a_message_is_a_text_like_any_other():
    text = say("no link is called {name}", name='"crnk"')
    assert text == 'no link is called "crnk"'
    assert f"{text}!" == 'no link is called "crnk"!'


def test_without_parts_the_pattern_stands_as_it_is():
    assert say('write { formula = "…" }') == 'write { formula = "…" }'


def test_parts_are_translated_inside_out_and_names_stay():
    text = say("in {text}: {message}", text='"a+"', message=say("expected {what}", what=say("the end")))
    patterns = {
        "in {text}: {message}": "{text} içinde: {message}",
        "expected {what}": "{what} beklenir",
        "the end": "son",
    }
    assert in_turkish(text, patterns) == '"a+" içinde: son beklenir'


def test_words_of_both_languages_are_taken_from_each():
    text = say("between {group}", group=Label("links 3, 4", (("tr", "3, 4 uzuvları"),)))
    assert text == "between links 3, 4"
    assert in_turkish(text, {"between {group}": "{group} arasında"}) == "3, 4 uzuvları arasında"


def test_a_message_passes_between_processes():
    text = pickle.loads(pickle.dumps(say("a {what}", what=say("link"))))
    assert in_turkish(text, {"a {what}": "bir {what}", "link": "uzuv"}) == "bir uzuv"


def test_an_exception_says_what_it_was_given():
    assert (
        in_turkish(reason(ValueError(say("division by zero"))), {"division by zero": "sıfıra bölme"}) == "sıfıra bölme"
    )
    assert reason(OverflowError(34, "too large")) == str(OverflowError(34, "too large"))


@pytest.mark.parametrize(
    ("count", "english", "polish"),
    [(1, "1 row", "1 wiersz"), (3, "3 rows", "3 wiersze"), (25, "25 rows", "25 wierszy")],
)
def test_a_count_takes_the_form_that_the_language_has_for_it(count, english, polish):
    text = pickle.loads(pickle.dumps(say("{rows}", rows=say_count("{count} row", "{count} rows", count))))
    forms = ("{count} wiersz", "{count} wiersze", "{count} wierszy")
    assert text == english
    assert in_turkish(text, {("{count} row", "{count} rows"): forms}) == polish
