"""`mechsheet draw`: a page on the user's own machine on which a mechanism is drawn, moved and turned into a workbook.

`server` serves it to this machine alone, `answers` says what the page may ask (one JSON each way), `looking` reads a
description and says where everything is, `fitting` finds the dimensions of what was dragged, `editing/` writes what was
drawn into the description's text, `files` makes workbooks and pictures. `page/` is the page itself: plain modules and SVG.

The text is the mechanism. The page holds it, the server remembers nothing of it: every answer follows from its question.
"""
