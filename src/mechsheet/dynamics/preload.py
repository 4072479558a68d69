"""The spring that holds a follower on its cam: with which free length the two would just touch, position by position.

A spring whose free length L0 is longer by u pulls less by k u. With w = p2 - p1 its way, p' how its ends move with the
follower's variable (a prime), n.P' the lever of the contact force N:

    N = 0    where    L0 + N (n.P') / (k L'),    L' = w.(p2' - p1')/L
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node
from livesheet.formula.vectors import dot, minus
from mechsheet.dynamics.acting import ActingForces
from mechsheet.kinematics.cams.profile import Contact
from mechsheet.kinematics.equations import Condition
from mechsheet.model import Spring
from mechsheet.units import LENGTH
from mechsheet.words.equations import phrase


def holding_spring(acting: ActingForces, contact: Contact) -> Spring | None:
    """The only spring between the ground and the link on which a cam presses, else the only one that the cam does not hold;
    None where there are several."""
    ground = acting.poses.mechanism.ground.name
    ends = [(spring, {name for name, _ in spring.ends}) for spring in acting.dynamics.springs]
    near = [spring for spring, links in ends if links == {ground, contact.link}]
    found = near or [spring for spring, links in ends if contact.cam not in links]
    return found[0] if len(found) == 1 else None


def write_preload(acting: ActingForces, contact: Contact, force: Node) -> None:
    """Write the column down, where one spring holds the follower; `force`: N."""
    spring = holding_spring(acting, contact)
    if spring is None:
        return
    places = [acting.poses.xy[point] for _, point in spring.ends]
    start, end = (contact.moved(link, at) for (link, _), at in zip(spring.ends, places, strict=True))
    opens = al.div(dot(minus(places[1], places[0]), minus(end, start)), acting.length(spring))
    if al.is_zero(opens):
        return
    longer = al.div(al.mul(force, contact.lever), al.mul(spring.stiffness, opens))
    label = phrase("spring_hold", name=spring.name)
    stretched = () if contact.direct else (Condition(Call("ABS", (opens,)), contact.least),)
    acting.columns.written(spring.hold, al.add(spring.free_length, longer), LENGTH, label, "hold", exists=stretched)
