"""The loop of operator precedence that all dialects share: a dialect's table says how strongly operators bind."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from ..diagnostics import FormulaError
from ..said import say
from .dialects import MAX_NESTING, Dialect
from .lexer import Token, fail, tokenise
from .nodes import Binary, Node, Unary


class Parser(ABC):
    """Tokens and a place among them, with the token at hand in `next`; `expression` climbs the dialect's table."""

    spaces: ClassVar[bool] = False

    def __init__(self, text: str, dialect: Dialect, tokens: list[Token] | None = None) -> None:
        self.text = text
        self.dialect = dialect
        listed = tokenise(text, dialect.name) if tokens is None else tokens
        self.tokens = [t for t in listed if self.spaces or t.kind != "space"]
        self.place = 0
        self.next = self.tokens[0]
        self.depth = 0
        self.operators = {dialect.spelling.get(op, op): op for op in dialect.infix}

    def take(self) -> Token:
        """The token at hand, and on to the next; nothing is after the end."""
        token = self.next
        self.place += 1
        if token.kind != "end":
            self.next = self.tokens[self.place]
        return token

    def parse(self) -> Node:
        """The tree of the whole text."""
        self.skip_space()
        if self.next.kind == "end":
            raise fail(self.text, 1, say("expected a formula, found nothing"))
        node = self.expression(0)
        if self.next.kind != "end":
            raise self.unexpected(say("an operator or the end"))
        return node

    def unexpected(self, expected: str, hint: str = "") -> FormulaError:
        """The error that says what stands here and what should."""
        token = self.next
        found = say('"{text}"', text=token.text) if token.kind != "end" else say("the end")
        return fail(
            self.text, token.column, say("expected {expected}, found {found}", expected=expected, found=found), hint
        )

    def expression(self, minimum: int) -> Node:
        """An operand, and every operator after it that binds at least as strongly as `minimum`."""
        left = self.signed()
        signs = 0
        while (op := self.operator()) is not None:
            if op == "%":
                if self.dialect.postfix < minimum:
                    break
                self.take()
                left = Unary("%", left)
                signs += 1
                if self.depth + signs > MAX_NESTING:
                    raise fail(
                        self.text,
                        self.next.column,
                        say("nested deeper than {most} levels", most=MAX_NESTING),
                    )
                continue
            power = self.dialect.infix[op]
            if power < minimum:
                break
            self.pass_operator(op)
            if op in self.dialect.leans_right:
                self.deeper()
                right = self.expression(power)
                self.depth -= 1
            else:
                right = self.expression(power + 1)
            left = self.combine(op, left, right)
        return left

    def operator(self) -> str | None:
        """The infix operator (or `%`) that comes next, in the tree's spelling, or None."""
        token = self.next
        if self.dialect.postfix and token.kind == "op" and token.text == "%":
            return "%"
        return self.operators.get(token.text) if token.kind == "op" else None

    def pass_operator(self, op: str) -> None:
        """On past the infix operator `op`."""
        del op
        self.take()

    def combine(self, op: str, left: Node, right: Node) -> Node:
        """The node of an infix operator."""
        return Binary(op, left, right)

    def signed(self) -> Node:
        """An operand with its signs."""
        self.skip_space()
        token = self.next
        if token.kind == "op" and token.text in "+-":
            self.take()
            self.deeper()
            node = Unary("-" if token.text == "-" else "+", self.expression(self.dialect.prefix))
            self.depth -= 1
            return node
        return self.operand()

    @abstractmethod
    def operand(self) -> Node:
        """What an operator works on; each dialect has its own."""

    def parenthesised(self) -> Node:
        """What stands in parentheses."""
        self.take()
        self.deeper()
        inside = self.expression(0)
        self.close()
        return inside

    def arguments(self) -> tuple[Node, ...]:
        """The arguments of a call, with their parentheses."""
        self.skip_space()
        self.take()
        self.deeper()
        self.skip_space()
        args: list[Node] = []
        if self.next.kind != "close":
            args.append(self.argument())
            while self.next.kind == "separator":
                self.take()
                args.append(self.argument())
        self.close()
        return tuple(args)

    def argument(self) -> Node:
        """One of them."""
        return self.expression(0)

    def skip_space(self) -> None:
        """On to the next token that is no space."""
        while self.next.kind == "space":
            self.take()

    def deeper(self) -> None:
        """One level of nesting more, up to the limit."""
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise fail(self.text, self.next.column, say("nested deeper than {most} levels", most=MAX_NESTING))

    def close(self) -> None:
        """Pass a closing parenthesis: one level less."""
        self.skip_space()
        if self.next.kind != "close":
            raise self.unexpected(say('an operator or ")"'))
        self.take()
        self.depth -= 1


def number_value(text: str, token: Token) -> float:
    """The value of a number as written."""
    value = float(token.text)
    if value == float("inf"):
        raise fail(text, token.column, say("{text} is too large a number", text=token.text))
    return value
