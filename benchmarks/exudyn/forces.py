"""All forces of the truck in one compiled function.

The function knows no engine: it takes places, rotation matrices, velocities and bristles, and gives forces
and moments. Everything is in truck axes; numba compiles it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from model import (
    BOLSTER,
    FIRST_WEDGE,
    GRAVITY,
    LEFT_FRAME,
    Array,
    Rig,
    adapter_points,
    bodies,
    control_coils,
    faces,
    load_coils,
)

OBSERVED = (
    "left_nest_vertical_force",
    "right_nest_vertical_force",
    "warp_moment",
    "warp_moment_load_coils",
    "warp_moment_control_coils",
    "warp_moment_slopes",
    *(
        f"{end}_{side}_{what}"
        for end in ("leading", "trailing")
        for side in ("left", "right")
        for what in ("column_normal", "column_friction_z", "slope_normal")
    ),
)
"""What the function observes, in the order of its last argument."""

INTEGRALS = ("motion_work", "wedge_friction_loss", "contact_damping_loss", "element_loss")
"""Integrals that follow the bristles in the first-order states."""


@dataclass(frozen=True)
class Tables:
    """The truck as arrays: what the compiled function reads."""

    reference: Array
    weight: Array
    free: Array
    corners: Array
    """Rows of wedge, carrier, place in the wedge, point of the plane, normal, two tangents, column or not."""
    contact: Array
    springs: Array
    """Rows of upper body, seat body, place in each, preload, stiffnesses, damping, control coil or not."""
    adapters: Array
    """Rows of side frame, place in it (3)."""
    adapter: Array

    @property
    def bristles(self) -> int:
        """Number of bristle deflections: two at each corner and each adapter point."""
        return 2 * (len(self.corners) + len(self.adapters))

    @property
    def states(self) -> int:
        """Number of first-order states."""
        return self.bristles + len(INTEGRALS)


def tables(rig: Rig) -> Tables:
    """The arrays of a rig."""
    listed = bodies(rig)
    reference = np.array([body.at for body in listed])
    corners = []
    for face in faces(rig):
        lateral = np.array([0.0, 1.0, 0.0])
        along = np.cross(face.normal, lateral)
        for corner in face.corners:
            center = face.center - reference[face.carrier]
            row = [[face.wedge, face.carrier], corner, center, face.normal, lateral, along, [face.column]]
            corners.append(np.concatenate(row))
    springs = []
    for is_control, placed in [(0, coil) for coil in load_coils(rig)] + [
        (1, coil) for coil in control_coils(rig)
    ]:
        spring = placed.spring
        numbers = [spring.preload, spring.stiffness, spring.shear_stiffness, spring.damping, is_control]
        places = [placed.at - reference[placed.upper], placed.at - reference[placed.seat]]
        springs.append(np.concatenate([[placed.upper, placed.seat], *places, numbers]))
    points = [np.concatenate([[frame], at - reference[frame]]) for frame, at in adapter_points(rig)]
    contact, adapter = rig.contact, rig.adapter
    return Tables(
        reference=reference,
        weight=np.array([body.weight for body in listed]),
        free=np.array([float(body.free) for body in listed]),
        corners=np.array(corners),
        contact=np.array(
            [
                contact.stiffness,
                contact.damping,
                contact.friction,
                contact.bristle_stiffness,
                contact.bristle_damping,
            ]
        ),
        springs=np.array(springs),
        adapters=np.array(points).reshape(-1, 4),
        adapter=np.array(
            [
                adapter.preload,
                adapter.stiffness,
                adapter.damping,
                adapter.friction,
                adapter.bristle_stiffness,
                adapter.bristle_damping,
            ]
        ),
    )


@njit(cache=True)
def place(position, rotation, velocity, spin, body, local, point, speed):  # type: ignore[no-untyped-def]
    """Place and velocity of a point fixed in a body, into `point` and `speed`."""
    for i in range(3):
        arm = 0.0
        for j in range(3):
            arm += rotation[body, i, j] * local[j]
        point[i] = arm
    speed[0] = velocity[body, 0] + spin[body, 1] * point[2] - spin[body, 2] * point[1]
    speed[1] = velocity[body, 1] + spin[body, 2] * point[0] - spin[body, 0] * point[2]
    speed[2] = velocity[body, 2] + spin[body, 0] * point[1] - spin[body, 1] * point[0]
    for i in range(3):
        point[i] += position[body, i]


@njit(cache=True)
def push(position, wrench, body, point, force, sign):  # type: ignore[no-untyped-def]
    """Adds a force at a point to the force and moment of a body about its center of gravity."""
    x = point[0] - position[body, 0]
    y = point[1] - position[body, 1]
    z = point[2] - position[body, 2]
    for i in range(3):
        wrench[body, i] += sign * force[i]
    wrench[body, 3] += sign * (y * force[2] - z * force[1])
    wrench[body, 4] += sign * (z * force[0] - x * force[2])
    wrench[body, 5] += sign * (x * force[1] - y * force[0])


@njit(cache=True)
def bristle(e1, e2, v1, v2, limit, stiffness, damping):  # type: ignore[no-untyped-def]
    """Bristle in series with a slider: force against the motion, rates of deflection, power lost."""
    t1 = stiffness * e1 + damping * v1
    t2 = stiffness * e2 + damping * v2
    size = np.sqrt(t1 * t1 + t2 * t2)
    r1, r2 = v1, v2
    if size > limit:
        t1 *= limit / size
        t2 *= limit / size
        r1 = (t1 - stiffness * e1) / damping
        r2 = (t2 - stiffness * e2) / damping
    lost = t1 * v1 + t2 * v2 - stiffness * (e1 * r1 + e2 * r2)
    return t1, t2, r1, r2, lost


@njit(cache=True)
def truck_forces(  # type: ignore[no-untyped-def]
    position, rotation, velocity, spin, states, weight, free, corners, contact, springs, adapters, adapter,
    wrench, rates, observed,
):  # fmt: skip
    """Forces and moments on all bodies, rates of the first-order states, and what is observed."""
    wrench[:] = 0.0
    rates[:] = 0.0
    observed[:] = 0.0
    point, speed, other = np.empty(3), np.empty(3), np.empty(3)
    n, a, b, force = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    seat = np.empty(3)
    bristles = 2 * (len(corners) + len(adapters))
    friction_lost, damping_lost, element_lost = 0.0, 0.0, 0.0

    for c in range(len(corners)):
        row = corners[c]
        wedge, carrier = int(row[0]), int(row[1])
        place(position, rotation, velocity, spin, wedge, row[2:5], point, speed)
        for i in range(3):
            n[i], a[i], b[i], seat[i] = 0.0, 0.0, 0.0, position[carrier, i]
            for j in range(3):
                n[i] += rotation[carrier, i, j] * row[8 + j]
                a[i] += rotation[carrier, i, j] * row[11 + j]
                b[i] += rotation[carrier, i, j] * row[14 + j]
                seat[i] += rotation[carrier, i, j] * row[5 + j]
        x, y, z = (
            point[0] - position[carrier, 0],
            point[1] - position[carrier, 1],
            point[2] - position[carrier, 2],
        )
        speed[0] -= velocity[carrier, 0] + spin[carrier, 1] * z - spin[carrier, 2] * y
        speed[1] -= velocity[carrier, 1] + spin[carrier, 2] * x - spin[carrier, 0] * z
        speed[2] -= velocity[carrier, 2] + spin[carrier, 0] * y - spin[carrier, 1] * x
        gap, opening, va, vb = 0.0, 0.0, 0.0, 0.0
        for i in range(3):
            gap += n[i] * (point[i] - seat[i])
            opening += n[i] * speed[i]
            va += a[i] * speed[i]
            vb += b[i] * speed[i]
        normal = 0.0
        if gap < 0.0:
            normal = max(0.0, -contact[0] * gap - contact[1] * opening)
            damping_lost += -(normal + contact[0] * gap) * opening
        ta, tb, ra, rb, lost = bristle(
            states[2 * c], states[2 * c + 1], va, vb, contact[2] * normal, contact[3], contact[4]
        )
        rates[2 * c], rates[2 * c + 1] = ra, rb
        friction_lost += lost
        for i in range(3):
            force[i] = normal * n[i] - ta * a[i] - tb * b[i]
        push(position, wrench, wedge, point, force, 1.0)
        push(position, wrench, carrier, point, force, -1.0)
        at = 6 + 3 * (wedge - FIRST_WEDGE)
        if row[17] > 0.0:
            observed[at] += normal
            observed[at + 1] += ta * a[2] + tb * b[2]
        else:
            observed[at + 2] += normal
            observed[5] += -(point[0] * force[1] - point[1] * force[0])

    for k in range(len(springs)):
        row = springs[k]
        upper, below = int(row[0]), int(row[1])
        place(position, rotation, velocity, spin, upper, row[2:5], point, speed)
        place(position, rotation, velocity, spin, below, row[5:8], seat, other)
        x, y, z = point[0] - position[below, 0], point[1] - position[below, 1], point[2] - position[below, 2]
        other[0] = speed[0] - velocity[below, 0] - spin[below, 1] * z + spin[below, 2] * y
        other[1] = speed[1] - velocity[below, 1] - spin[below, 2] * x + spin[below, 0] * z
        other[2] = speed[2] - velocity[below, 2] - spin[below, 0] * y + spin[below, 1] * x
        for i in range(3):
            a[i], b[i] = 0.0, 0.0
            for j in range(3):
                a[i] += rotation[below, j, i] * (point[j] - seat[j])
                b[i] += rotation[below, j, i] * other[j]
        along = max(0.0, row[8] - row[9] * a[2])
        fade = min(1.0, along / (0.05 * row[8]))
        n[0] = fade * (-row[10] * a[0] - row[11] * b[0])
        n[1] = fade * (-row[10] * a[1] - row[11] * b[1])
        n[2] = along - fade * row[11] * b[2]
        element_lost += fade * row[11] * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2])
        for i in range(3):
            force[i] = 0.0
            for j in range(3):
                force[i] += rotation[below, i, j] * n[j]
        push(position, wrench, upper, point, force, 1.0)
        push(position, wrench, below, point, force, -1.0)
        moment = point[0] * force[1] - point[1] * force[0]
        if row[12] == 0.0:
            observed[3] += moment
        elif below == BOLSTER:
            observed[4] -= moment

    for side in range(2):
        observed[side] = -wrench[LEFT_FRAME + side, 2]
    observed[2] = (
        wrench[BOLSTER, 5]
        + position[BOLSTER, 0] * wrench[BOLSTER, 1]
        - position[BOLSTER, 1] * wrench[BOLSTER, 0]
    )

    for k in range(len(adapters)):
        row = adapters[k]
        frame = int(row[0])
        place(position, rotation, velocity, spin, frame, row[1:4], point, speed)
        # Wheelsets stand still: their axes are those of the truck, and the nominal place is the seat.
        raised = point[2] - 22.5
        normal = max(0.0, adapter[0] - adapter[1] * raised - adapter[2] * speed[2])
        c = len(corners) + k
        ta, tb, ra, rb, lost = bristle(
            states[2 * c], states[2 * c + 1], speed[0], speed[1], adapter[3] * normal, adapter[4], adapter[5]
        )
        rates[2 * c], rates[2 * c + 1] = ra, rb
        element_lost += lost - (normal - max(0.0, adapter[0] - adapter[1] * raised)) * speed[2]
        force[0], force[1], force[2] = -ta, -tb, normal
        push(position, wrench, frame, point, force, 1.0)

    work = 0.0
    for body in range(len(weight)):
        if free[body] > 0.0:
            wrench[body, 2] -= weight[body]
        else:
            for i in range(3):
                work -= wrench[body, i] * velocity[body, i] + wrench[body, 3 + i] * spin[body, i]
    rates[bristles] = work
    rates[bristles + 1] = friction_lost
    rates[bristles + 2] = damping_lost
    rates[bristles + 3] = element_lost


__all__ = ["GRAVITY", "INTEGRALS", "OBSERVED", "Tables", "tables", "truck_forces"]
