"""What the quantities of a mechanism are called beside its positions: rates, forces, mass centres."""

from __future__ import annotations

from collections.abc import Sequence

from mechsheet.model import (
    CONTACT,
    POINT_RATES,
    SHAKING,
    Cam,
    Driver,
    FurtherDriver,
    Joint,
    Link,
    Mechanism,
    Rack,
    Relation,
    center_symbol,
    pair_symbol,
    rate_symbols,
)


def joint_forces(
    links: Sequence[Link],
    joints: Sequence[Joint],
    driver: Driver | None,
    further: Sequence[FurtherDriver],
    relations: Sequence[Relation],
    cam: Cam | None,
) -> dict[str, str]:
    """Name -> what it is: F34, F34.x and F34.y of every pin, F14.n and F14.c of every slide, the driver's effort, what a cam
    presses."""
    numbers = {link.name: link.number for link in links}
    holders: dict[str, list[int]] = {}
    for link in links:
        for point in link.points:
            holders.setdefault(point, []).append(link.number)
    found: dict[str, str] = {}
    for owner, *others in holders.values():
        for other in others:
            name = pair_symbol("F", owner, other)
            found |= dict.fromkeys((name, f"{name}.x", f"{name}.y"), "joint force")
    for joint in joints:
        name = pair_symbol("F", numbers[joint.on], numbers[joint.link])
        found |= {f"{name}.n": "normal force"} | ({f"{name}.c": "couple"} if joint.kind == "prismatic" else {})
        if driver is not None and driver.joint == joint.name:
            found |= {f"{name}.t": "driving force", f"{name}.work": "driving force"}
    if driver is not None and driver.link:
        name = pair_symbol("T", numbers[driver.relative_to or links[0].name], numbers[driver.link])
        found |= {name: "driving torque", f"{name}.work": "driving torque"}
    for besides in further:
        if besides.segments is not None and cam is not None:
            found[CONTACT] = "contact force"
        elif besides.link:
            found[pair_symbol("T", numbers[besides.relative_to], numbers[besides.link])] = "driving torque"
        else:
            slide = next(joint for joint in joints if joint.name == besides.joint)
            found[f"{pair_symbol('F', numbers[slide.on], numbers[slide.link])}.t"] = "driving force"
    slides = {joint.symbol: (joint.on, joint.link) for joint in joints}
    for relation in relations:
        if isinstance(relation, Rack):
            bar = next(side for side in slides[relation.joint] if side != relation.arm)
            name = pair_symbol("G", numbers[relation.link], numbers[bar])
        else:
            name = pair_symbol("G", numbers[relation.on], numbers[relation.link])
        found |= {name: "tooth force", f"{name}.t": "tooth force", f"{name}.m": "torque of a belt"}
    return found


def names_of(mechanism: Mechanism) -> tuple[str, ...]:
    """Every name that an output may read beside angles, displacements and moving points, whether a column shows it or not.

    Velocities and accelerations, and the power, are there where the driver has a speed; forces where there are masses or
    loads.
    """
    turning = dict.fromkeys(link.angle_symbol for link in mechanism.links[1:])
    turning |= dict.fromkeys(driver.symbol for driver in mechanism.all_drivers if driver.link)
    sliding = dict.fromkeys(joint.symbol for joint in mechanism.joints)
    fixed = mechanism.ground.points
    found = dict.fromkeys(f"{point}.{axis}" for point in fixed for axis in "xy")
    for symbol in (*turning, *sliding):
        found |= dict.fromkeys((f"{symbol}.d", f"{symbol}.dd"))
    moves, dynamics = mechanism.driver.speed is not None, mechanism.dynamics
    if moves:
        found |= {name: None for each in (*turning, *sliding) for name in rate_symbols(each, each in turning)}
        moving = (point for link in mechanism.links[1:] for point in link.points if point not in fixed)
        found |= {f"{point}.{part}": None for point in moving for part in POINT_RATES}
    if dynamics is not None:
        found |= dict.fromkeys(
            joint_forces(
                mechanism.whole_links, mechanism.joints, mechanism.driver, mechanism.drivers, mechanism.relations,
                mechanism.cam,
            )
        )  # fmt: skip
    if dynamics is not None and moves:
        numbers = {link.name: link.number for link in mechanism.links}
        centers = (center_symbol(numbers[mass.link]) for mass in dynamics.masses if not isinstance(mass.center, str))
        found |= dict.fromkeys(("power", *SHAKING))
        found |= {f"{center}.{part}": None for center in centers for part in ("x", "y", *POINT_RATES)}
    return tuple(found)
