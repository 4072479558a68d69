"""The spring that holds a follower on its cam: with which free length the two would just touch, position by position.

A spring between the ground and the follower whose free length L0 is longer by u pulls less by k u. With w = p2 - p1 its
way, p2' how its end on the follower moves with the follower's variable (a prime), n.P' the lever of the contact force N:

    N = 0    where    L0 + N (n.P') / (k L'),    L' = w.p2'/L
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node
from livesheet.formula.vectors import dot, minus, negative, turned
from mechsheet.dynamics.acting import ActingForces
from mechsheet.kinematics.assur import Drive, Pin
from mechsheet.kinematics.cam import Contact
from mechsheet.model import Spring
from mechsheet.units import LENGTH
from mechsheet.words.equations import phrase


def holding_spring(acting: ActingForces, contact: Contact) -> Spring | None:
    """The only spring between the ground and the link on which a cam presses; None where there is none, or several."""
    ends = {acting.poses.mechanism.ground.name, contact.link}
    found = [spring for spring in acting.dynamics.springs if {name for name, _ in spring.ends} == ends]
    return found[0] if len(found) == 1 else None


def write_preload(acting: ActingForces, contact: Contact, drive: Drive, force: Node, lever: Node) -> None:
    """Write the column down, where one spring holds the follower; `force`: N, whose lever is n.P'."""
    spring = holding_spring(acting, contact)
    if spring is None or contact.moved is None:
        return
    start, end = (acting.poses.xy[point] for _, point in spring.ends)
    way = minus(end, start)
    if spring.ends[0][0] == contact.link:
        way, end = negative(way), start
    moved = contact.moved
    if isinstance(drive.joint, Pin):
        moved = turned(minus(end, acting.poses.xy[drive.joint.point]))
    opens = al.div(dot(way, moved), acting.length(spring))
    longer = al.div(al.mul(force, lever), al.mul(spring.stiffness, opens))
    label = phrase("spring_hold", name=spring.name)
    acting.columns.written(spring.hold, al.add(spring.free_length, longer), LENGTH, label, "hold")
