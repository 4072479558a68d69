"""A drawing made by the orders that the page gives, without a browser."""

from mechsheet.drawing_page.answers import EMPTY, Studio


class Drawing:
    """What a page holds: the text, the position shown, the last answer."""

    def __init__(self, text=None, language="en"):
        self.studio = Studio(None)
        self.text = EMPTY.format(name="drawn") if text is None else text
        self.at, self.language, self.look = None, language, None
        self.take(self.ask("look"))

    def ask(self, name, **more):
        places = self.places() if self.look else {}
        question = {"text": self.text, "at": self.at, "places": places, "spoken": self.language}
        return self.studio.answer(name, question | more)

    def take(self, look):
        self.look = look
        if look["solved"]:
            self.at = look["frames"]["driver"][look["at"]]

    def do(self, do, **order):
        answer = self.ask("edit", order={"do": do, **order})
        self.text = answer["text"]
        self.take(answer["look"])
        return self

    def places(self):
        found, frame = {}, self.look.get("at", 0)
        for name, columns in self.look.get("frames", {}).get("points", {}).items():
            found[name] = [column[frame if len(column) > 1 else 0] for column in columns]
        return found


def spot(x, y):
    return {"at": [x, y]}


def pin(name):
    return {"point": name}


def four_bar():
    """A0, A, B, B0, and C on the coupler; without a driver."""
    drawing = Drawing().do("ground", end=spot(0, 0)).do("ground", end=spot(70, 0))
    drawing.do("link", ends=[pin("A0"), spot(20, 30)]).do("link", ends=[pin("A"), spot(75, 60)])
    return drawing.do("link", ends=[pin("B"), pin("B0")]).do("plate", link="link3", end=spot(60, 90))
