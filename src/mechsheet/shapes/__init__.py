"""What a mechanism looks like, in one list of shapes: whoever draws it loops over the list.

`listing` writes the list: links, ground, slides, cylinders, wheels, and from `loads` springs, forces, torques, weights.
Places are formulas over the quantities of the equations and over the size of the window, so the list holds for all
positions and for any program. `positions` has it in numbers; `names` finds where there is room for the names.
"""
