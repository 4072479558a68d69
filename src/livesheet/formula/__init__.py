"""The one expression tree, its parsers and its printers."""
