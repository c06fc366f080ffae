"""The truck in Exudyn with all forces in one compiled user function.

Exudyn has the rigid bodies (their inertia, rotations, state) and integrates; the loads of all free bodies
are read from what `forces.truck_forces` computes at once, and a first-order object integrates bristles,
losses and work. Prescribed bodies are no bodies of Exudyn: their places are functions of time.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import exudyn as exu
import exudyn.itemInterface as eii
import numpy as np
from numba import njit

import forces
from forces import GRAVITY, INTEGRALS, OBSERVED, truck_forces
from model import (
    BOLSTER,
    FIRST_WEDGE,
    LEFT_FRAME,
    LIFT,
    RIGHT_FRAME,
    Array,
    Rig,
    bodies,
    bolster_height,
    side_frame_yaw,
)
from result import OUTPUT_INTERVAL, Result, check_clearances


@njit(cache=True)
def unpack(q, q_t, reference, free, position, rotation, velocity, spin):  # type: ignore[no-untyped-def]
    """Places, rotation matrices, velocities of the free bodies from Exudyn's coordinates: R = Rx Ry Rz."""
    at = 0
    for body in range(len(free)):
        if free[body] == 0.0:
            continue
        for i in range(3):
            position[body, i] = reference[body, i] + q[at + i]
            velocity[body, i] = q_t[at + i]
        cx, sx = np.cos(q[at + 3]), np.sin(q[at + 3])
        cy, sy = np.cos(q[at + 4]), np.sin(q[at + 4])
        cz, sz = np.cos(q[at + 5]), np.sin(q[at + 5])
        r = rotation[body]
        r[0, 0], r[0, 1], r[0, 2] = cy * cz, -cy * sz, sy
        r[1, 0], r[1, 1], r[1, 2] = cx * sz + sx * sy * cz, cx * cz - sx * sy * sz, -sx * cy
        r[2, 0], r[2, 1], r[2, 2] = sx * sz - cx * sy * cz, sx * cz + cx * sy * sz, cx * cy
        rate_x, rate_y, rate_z = q_t[at + 3], q_t[at + 4], q_t[at + 5]
        spin[body, 0] = rate_x + sy * rate_z
        spin[body, 1] = cx * rate_y - sx * cy * rate_z
        spin[body, 2] = sx * rate_y + cx * cy * rate_z
        at += 6


class CompiledTruck:
    """The compiled function with its tables and its memory, as Exudyn's user functions call it."""

    def __init__(self, rig: Rig) -> None:
        self.rig = rig
        self.tables = forces.tables(rig)
        count = len(self.tables.weight)
        self.position = self.tables.reference.copy()
        self.rotation = np.tile(np.eye(3), (count, 1, 1))
        self.velocity = np.zeros((count, 3))
        self.spin = np.zeros((count, 3))
        self.wrench = np.zeros((count, 6))
        self.rates = np.zeros(self.tables.states)
        self.observed = np.zeros(len(OBSERVED))
        self.coordinates = 6 * int(self.tables.free.sum())

    def evaluate(self, t: float, q: Array, q_t: Array, states: Array) -> None:
        """All forces, rates and observed values at a time and a state, into the memory of this object."""
        tables, rig = self.tables, self.rig
        z, speed = bolster_height(rig, t)
        self.position[BOLSTER, 2] = tables.reference[BOLSTER, 2] + z
        self.velocity[BOLSTER, 2] = speed
        if rig.warp:
            yaw, rate = side_frame_yaw(rig, t)
            c, s = np.cos(yaw), np.sin(yaw)
            for frame in (LEFT_FRAME, RIGHT_FRAME):
                self.rotation[frame, 0, 0] = self.rotation[frame, 1, 1] = c
                self.rotation[frame, 0, 1], self.rotation[frame, 1, 0] = -s, s
                self.spin[frame, 2] = rate
        unpack(
            q, q_t, tables.reference, tables.free,
            self.position, self.rotation, self.velocity, self.spin,
        )  # fmt: skip
        truck_forces(
            self.position, self.rotation, self.velocity, self.spin, states,
            tables.weight, tables.free, tables.corners, tables.contact,
            tables.springs, tables.adapters, tables.adapter,
            self.wrench, self.rates, self.observed,
        )  # fmt: skip


def build(rig: Rig) -> tuple[Any, Any, CompiledTruck, int]:
    """Exudyn's system container, its system, the compiled truck, and the number of the sensor."""
    container = exu.SystemContainer()
    mbs: Any = container.AddSystem()
    truck = CompiledTruck(rig)
    nodes, numbers = [], []
    for number, body in enumerate(bodies(rig)):
        if not body.free:
            continue
        start = [0.0] * 6
        if number >= FIRST_WEDGE and rig.warp:
            # A bolster that starts displaced takes its wedges along.
            start[2] = -LIFT
        node = mbs.AddNode(
            eii.NodeRigidBodyRxyz(referenceCoordinates=[*body.at, 0.0, 0.0, 0.0], initialCoordinates=start)
        )
        mbs.AddObject(
            eii.ObjectRigidBody(
                nodeNumber=node,
                mass=body.weight / GRAVITY,
                inertia=[*body.inertia, 0.0, 0.0, 0.0],
            )
        )
        nodes.append(node)
        numbers.append(number)
    data: Any = mbs.systemData

    # Exudyn asks the loads in their order at each evaluation: the first computes all forces, the others read
    # them. Lists of plain numbers pass its interface faster than arrays.
    wrenches: list[list[list[float]]] = []

    def first_force(system: Any, t: float, load: Any) -> list[float]:
        truck.evaluate(t, data.GetODE2Coordinates(), data.GetODE2Coordinates_t(), data.GetODE1Coordinates())
        wrenches[:] = truck.wrench.reshape(-1, 2, 3).tolist()
        return wrenches[first][0]

    def reader(number: int, part: int) -> Callable[[Any, float, Any], list[float]]:
        return lambda system, t, load: wrenches[number][part]

    def rate_function(system: Any, t: float, item: int, states: Array) -> Array:
        # The array given here cannot be written, which makes the call of a compiled function slow.
        truck.evaluate(t, data.GetODE2Coordinates(), data.GetODE2Coordinates_t(), data.GetODE1Coordinates())
        return truck.rates

    def observe(system: Any, t: float, sensors: Any, factors: Any, configuration: Any) -> Array:
        q, states = data.GetODE2Coordinates(), data.GetODE1Coordinates()
        truck.evaluate(t, q, data.GetODE2Coordinates_t(), states)
        return np.concatenate([truck.observed, states[-len(INTEGRALS) :], q])

    first = numbers[0]
    for number, node in zip(numbers, nodes, strict=True):
        marker = mbs.AddMarker(eii.MarkerNodeRigid(nodeNumber=node))
        force = first_force if number == first else reader(number, 0)
        mbs.AddLoad(eii.LoadForceVector(markerNumber=marker, loadVectorUserFunction=force))
        mbs.AddLoad(eii.LoadTorqueVector(markerNumber=marker, loadVectorUserFunction=reader(number, 1)))
    count = truck.tables.states
    state_node = mbs.AddNode(
        eii.NodeGenericODE1(
            referenceCoordinates=[0.0] * count,
            initialCoordinates=[0.0] * count,
            numberOfODE1Coordinates=count,
        )
    )
    mbs.AddObject(eii.ObjectGenericODE1(nodeNumbers=[state_node], rhsUserFunction=rate_function))
    sensor = mbs.AddSensor(
        eii.SensorUserFunction(
            sensorNumbers=[], factors=[], sensorUserFunction=observe, storeInternal=True, writeToFile=False
        )
    )
    mbs.Assemble()
    return container, mbs, truck, sensor


def run(rig: Rig, step: float, duration: float | None = None) -> Result:
    """Integrates a rig by the classical Runge-Kutta method of fourth order with a fixed step."""
    container, mbs, truck, sensor = build(rig)
    rest = np.zeros(truck.coordinates)
    truck.evaluate(0.0, rest, rest, np.zeros(truck.tables.states))
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime = rig.duration if duration is None else duration
    settings.timeIntegration.numberOfSteps = round(settings.timeIntegration.endTime / step)
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = OUTPUT_INTERVAL
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.explicit.computeMassMatrixInversePerBody = True
    settings.timeIntegration.explicit.computeEndOfStepAccelerations = False
    begin = time.process_time()
    mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.RK44)
    spent = time.process_time() - begin
    stored = mbs.GetSensorStoredData(sensor)
    names = ["time", *OBSERVED, *INTEGRALS]
    for body in bodies(rig):
        if body.free:
            names += [f"{body.name}_{axis}" for axis in ("x", "y", "z", "roll", "pitch", "yaw")]
    columns = {name: stored[:, i] for i, name in enumerate(names)}
    columns["bolster_z"] = np.array([bolster_height(rig, t)[0] for t in columns["time"]])
    columns["warp_angle"] = np.array([side_frame_yaw(rig, t)[0] for t in columns["time"]])
    check_clearances(rig, columns)
    return Result(columns, step, spent)
