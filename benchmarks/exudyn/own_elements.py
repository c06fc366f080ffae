"""The truck in Exudyn's own elements: no force is computed in Python.

| in the model | here |
|---|---|
| corner of a wedge on a face | a sphere on the wedge against a stiff plate, `ObjectContactSphereTriangle` |
| coil with shear stiffness | `ObjectConnectorRigidBodySpringDamper` in the axes of its seat |
| adapter point | the same: a bristle that sticks is a spring and a damper |
| prescribed body | a rigid body whose coordinates are held by `ObjectConnectorCoordinate` |

Friction of the plates is Exudyn's regularized one: proportional to speed below a limit, so that it creeps.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import exudyn.itemInterface as eii
import numpy as np

from forces import OBSERVED
from model import (
    BOLSTER,
    FIRST_WEDGE,
    GRAVITY,
    LIFT,
    Array,
    PlacedSpring,
    Rig,
    adapter_points,
    bodies,
    bolster_height,
    control_coils,
    faces,
    frame_of,
    load_coils,
    side_frame_yaw,
)
from result import OUTPUT_INTERVAL, Result

SPHERE_RADIUS = 0.25
"""Of the spheres at the corners, in inches: more than any corner sinks in."""

PLATE_SIZE = 200.0
"""Edge of the triangle that stands for a plate, in inches: no corner comes near its edges."""

CREEP_SPEED = 1.0e-4
"""Sliding speed below which friction is proportional to it, in in/s."""


@dataclass(frozen=True)
class PlateContact:
    """A corner on its plate: the object, its wedge's number, and its face's normal in the carrier."""

    item: int
    wedge: int
    carrier: int
    normal: Array
    corner: Array
    column: bool


def vectors(points: list[Array]) -> Any:
    """A list of vectors as Exudyn takes it."""
    make: Any = exu.Vector3DList
    return make([[float(x) for x in point] for point in points])


class OwnElements:
    """The system with its bodies and connectors."""

    def __init__(self, rig: Rig, creep_speed: float) -> None:
        self.rig = rig
        self.container = exu.SystemContainer()
        self.mbs: Any = self.container.AddSystem()
        self.listed = bodies(rig)
        self.reference = np.array([body.at for body in self.listed])
        self.nodes: list[int] = []
        self.objects: list[int] = []
        self._add_bodies()
        self._hold_prescribed()
        self.contacts = self._add_faces(creep_speed)
        self.load_coils = [(placed, self._add_spring(placed)) for placed in load_coils(rig)]
        self.control_coils = [(placed, self._add_spring(placed)) for placed in control_coils(rig)]
        self.adapters = self._add_adapters()
        self.sensor = self.mbs.AddSensor(
            eii.SensorUserFunction(
                sensorNumbers=[],
                factors=[],
                sensorUserFunction=self._observe,
                storeInternal=True,
                writeToFile=False,
            )
        )
        self.mbs.Assemble()

    def _add_bodies(self) -> None:
        z, speed = bolster_height(self.rig, 0.0)
        for number, body in enumerate(self.listed):
            start, velocity = [0.0] * 6, [0.0] * 6
            if number == BOLSTER:
                start[2], velocity[2] = z, speed
            elif number >= FIRST_WEDGE and self.rig.warp:
                start[2] = -LIFT
            node = self.mbs.AddNode(
                eii.NodeRigidBodyRxyz(
                    referenceCoordinates=[*body.at, 0.0, 0.0, 0.0],
                    initialCoordinates=start,
                    initialVelocities=velocity,
                )
            )
            item = self.mbs.AddObject(
                eii.ObjectRigidBody(
                    nodeNumber=node,
                    mass=body.weight / GRAVITY,
                    inertia=[*body.inertia, 0.0, 0.0, 0.0],
                )
            )
            center = self.mbs.AddMarker(eii.MarkerBodyMass(bodyNumber=item))
            self.mbs.AddLoad(eii.LoadMassProportional(markerNumber=center, loadVector=[0.0, 0.0, -GRAVITY]))
            self.nodes.append(node)
            self.objects.append(item)

    def _hold_prescribed(self) -> None:
        ground = self.mbs.AddNode(eii.NodePointGround())
        fixed = self.mbs.AddMarker(eii.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
        rig = self.rig
        for number, body in enumerate(self.listed):
            if body.free:
                continue
            for coordinate in range(6):
                moving = self.mbs.AddMarker(
                    eii.MarkerNodeCoordinate(nodeNumber=self.nodes[number], coordinate=coordinate)
                )
                motion: Any = 0
                if number == BOLSTER and coordinate == 2:
                    motion = lambda system, t, item, offset: bolster_height(rig, t)[0]  # noqa: E731
                elif number != BOLSTER and coordinate == 5:
                    motion = lambda system, t, item, offset: side_frame_yaw(rig, t)[0]  # noqa: E731
                self.mbs.AddObject(
                    eii.ObjectConnectorCoordinate(markerNumbers=[fixed, moving], offsetUserFunction=motion)
                )

    def _marker(self, body: int, at: Array) -> int:
        return int(
            self.mbs.AddMarker(eii.MarkerBodyRigid(bodyNumber=self.objects[body], localPosition=list(at)))
        )

    def _add_faces(self, creep_speed: float) -> list[PlateContact]:
        contact, listed = self.rig.contact, []
        for face in faces(self.rig):
            lateral = np.array([0.0, 1.0, 0.0])
            along = np.cross(face.normal, lateral)
            center = face.center - self.reference[face.carrier]
            # The normal of (first, second, third) points to the wedge.
            points = [
                center - PLATE_SIZE * (lateral + along) / 3.0,
                center + PLATE_SIZE * (2.0 * along - lateral) / 3.0,
                center + PLATE_SIZE * (2.0 * lateral - along) / 3.0,
            ]
            if np.cross(points[1] - points[0], points[2] - points[0]) @ face.normal < 0.0:
                points[1], points[2] = points[2], points[1]
            plate = self._marker(face.carrier, np.zeros(3))
            for corner in face.corners:
                sphere = self._marker(face.wedge, corner + SPHERE_RADIUS * face.normal)
                data = self.mbs.AddNode(
                    eii.NodeGenericData(numberOfDataCoordinates=4, initialCoordinates=[0.0, 0.0, 0.0, 0.0])
                )
                item = self.mbs.AddObject(
                    eii.ObjectContactSphereTriangle(
                        markerNumbers=[sphere, plate],
                        nodeNumber=data,
                        sphereRadius=SPHERE_RADIUS,
                        trianglePoints=vectors(points),
                        includeEdges=0,
                        dynamicFriction=contact.friction,
                        frictionProportionalZone=creep_speed,
                        contactStiffness=contact.stiffness,
                        contactDamping=contact.damping,
                    )
                )
                listed.append(PlateContact(item, face.wedge, face.carrier, face.normal, corner, face.column))
        return listed

    def _add_spring(self, placed: PlacedSpring) -> int:
        spring = placed.spring
        shear, along, damping = spring.shear_stiffness, spring.stiffness, spring.damping
        rates = (shear, shear, along)
        return self._spring_damper(
            placed.seat, placed.upper, placed.at, rates, (damping,) * 3, spring.preload
        )

    def _spring_damper(
        self,
        seat: int | None,
        upper: int,
        at: Array,
        stiffness: tuple[float, ...],
        damping: tuple[float, ...],
        preload: float,
    ) -> int:
        if seat is None:
            ground = self.mbs.AddObject(eii.ObjectGround())
            below = self.mbs.AddMarker(eii.MarkerBodyRigid(bodyNumber=ground, localPosition=list(at)))
        else:
            below = self._marker(seat, at - self.reference[seat])
        item = self.mbs.AddObject(
            eii.ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[below, self._marker(upper, at - self.reference[upper])],
                stiffness=np.diag([*stiffness, 0.0, 0.0, 0.0]),
                damping=np.diag([*damping, 0.0, 0.0, 0.0]),
                offset=[0.0, 0.0, preload / stiffness[2], 0.0, 0.0, 0.0],
            )
        )
        return int(item)

    def _add_adapters(self) -> list[int]:
        a = self.rig.adapter
        stiffness = (a.bristle_stiffness, a.bristle_stiffness, a.stiffness)
        damping = (a.bristle_damping, a.bristle_damping, a.damping)
        return [
            self._spring_damper(None, frame, at, stiffness, damping, a.preload)
            for frame, at in adapter_points(self.rig)
        ]

    def _pose(self, body: int) -> tuple[Array, Array]:
        output = exu.OutputVariableType
        place = self.mbs.GetNodeOutput(self.nodes[body], output.Position)
        rotation = self.mbs.GetNodeOutput(self.nodes[body], output.RotationMatrix).reshape(3, 3)
        return place, rotation

    def _observe(self, system: Any, t: float, sensors: Any, factors: Any, configuration: Any) -> Array:
        output = exu.OutputVariableType
        values = dict.fromkeys(OBSERVED, 0.0)
        poses = [self._pose(body) for body in range(len(self.listed))]
        names = [body.name for body in self.listed]
        for contact in self.contacts:
            force = self._contact_force(contact)
            normal = poses[contact.carrier][1] @ contact.normal
            pressed = float(force @ normal)
            name = names[contact.wedge]
            if contact.column:
                values[f"{name}_column_normal"] += pressed
                values[f"{name}_column_friction_z"] -= float((force - pressed * normal)[2])
                side = self._nest(frame_of(self.reference[contact.wedge][1]))
                values[side] += float(force[2])
            else:
                values[f"{name}_slope_normal"] += pressed
                place, rotation = poses[contact.wedge]
                point = place + rotation @ contact.corner
                values["warp_moment_slopes"] -= float(point[0] * force[1] - point[1] * force[0])
        for kind, coils in (("load", self.load_coils), ("control", self.control_coils)):
            for placed, item in coils:
                seat_place, seat_rotation = poses[placed.seat]
                pulled = seat_rotation @ self.mbs.GetObjectOutput(item, output.ForceLocal)
                if placed.seat != BOLSTER:
                    values[self._nest(placed.seat)] -= float(pulled[2])
                if BOLSTER in (placed.seat, placed.upper):
                    at = seat_place + seat_rotation @ (placed.at - self.reference[placed.seat])
                    sign = 1.0 if placed.seat == BOLSTER else -1.0
                    moment = float(at[0] * pulled[1] - at[1] * pulled[0])
                    values[f"warp_moment_{kind}_coils"] += sign * moment
        parts = ("load_coils", "control_coils", "slopes")
        values["warp_moment"] = sum(values[f"warp_moment_{part}"] for part in parts)
        stuck = max([self._adapter_use(item) for item in self.adapters], default=0.0)
        return np.array([*values.values(), stuck])

    def _contact_force(self, contact: PlateContact) -> Array:
        """Force on the wedge."""
        return np.asarray(self.mbs.GetObjectOutput(contact.item, exu.OutputVariableType.Force))

    def _nest(self, frame: int) -> str:
        return ("left" if frame == 1 else "right") + "_nest_vertical_force"

    def _adapter_use(self, item: int) -> float:
        """Tangential force of an adapter point over what friction holds; above one it would slip."""
        x, y, z = self.mbs.GetObjectOutput(item, exu.OutputVariableType.ForceLocal)
        return float(np.hypot(x, y) / max(-self.rig.adapter.friction * z, 1e-9))


def run(rig: Rig, step: float, creep_speed: float = CREEP_SPEED, duration: float | None = None) -> Result:
    """Integrates a rig by the implicit generalized-alpha method with a fixed step."""
    truck = OwnElements(rig, creep_speed)
    settings = exu.SimulationSettings()
    integration = settings.timeIntegration
    integration.endTime = rig.duration if duration is None else duration
    integration.numberOfSteps = round(integration.endTime / step)
    integration.verboseMode = 0
    integration.generalizedAlpha.spectralRadius = 0.6
    integration.adaptiveStep = True
    integration.minimumStepSize = 1e-9
    integration.newton.useModifiedNewton = True
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = OUTPUT_INTERVAL
    begin = time.process_time()
    truck.mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.GeneralizedAlpha)
    spent = time.process_time() - begin
    stored = truck.mbs.GetSensorStoredData(truck.sensor)
    names = ["time", *OBSERVED, "adapter_use"]
    columns = {name: stored[:, i] for i, name in enumerate(names)}
    columns["bolster_z"] = np.array([bolster_height(rig, t)[0] for t in columns["time"]])
    columns["warp_angle"] = np.array([side_frame_yaw(rig, t)[0] for t in columns["time"]])
    return Result(columns, step, spent)
