"""Exudyn in the race: the planar wedge, as an object with two coordinates whose accelerations and Jacobian are the compiled ones.

exudyn_planar.py LIBRARY CASE TOLERANCE LIMIT FILE ROWS

What is the same as for the others: the equations, to the last bit, called from Exudyn through a user function, as a contact and friction
law of one's own is; and the Jacobian. What is not: Exudyn's implicit integrators take fixed steps (halved where Newton's method
fails), so that a tolerance is translated into a step (STEPS); and the energy lost is summed by the trapezoidal rule over the steps. Method: generalized alpha,
spectral radius 0.8, Newton's method with a new Jacobian in each step.
"""

import json
import sys
import time
import warnings

import exudyn as exu
import exudyn.itemInterface as items
import numpy as np
from scipy_race import Equations

# Step by tolerance, s; each divides the 0.01 s between two rows.
STEPS = {"1e-3": 1e-3, "1e-4": 5e-4, "1e-5": 2e-4, "1e-6": 1e-4, "1e-7": 5e-5, "1e-8": 2e-5, "1e-9": 1e-5}
INTERVAL = 0.01


class Run:
    """One integration."""

    def __init__(self, library, case, step, limit, rows):
        self.equations = Equations(library, case)
        self.z = np.zeros(5)
        self.step, self.limit, self.rows = step, limit, rows
        self.loss, self.power, self.steps = 0.0, 0.0, 0
        # Time and state at the start of the last step.
        self.last = None
        self.states = [self.equations.start.copy()]
        self.begun = time.process_time()

    def rates(self, t, q, u):
        self.z[0:2], self.z[2:4] = q, u
        return self.equations.rates(t, self.z)

    def force(self, mbs, t, item, q, u):
        return self.rates(t, q, u)[2:4]

    def jacobian(self, mbs, t, item, q, u, factor_q, factor_u):
        self.z[0:2], self.z[2:4] = q, u
        whole = self.equations.jacobian(t, self.z)
        return factor_q * -whole[2:4, 0:2] + factor_u * -whole[2:4, 2:4]

    def before_step(self, mbs, t):
        """The energy lost up to the start of this step, and the rows since the last one, straight between the steps."""
        data = mbs.systemData
        now = data.GetTime()
        q, u = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
        power = self.rates(now, q, u)[4]
        if self.last is not None:
            before, state = self.last
            self.loss += 0.5 * (now - before) * (self.power + power)
            new = np.concatenate([q, u, [self.loss]])
            while len(self.states) < self.rows and (at := INTERVAL * len(self.states)) <= now + 1e-9:
                self.states.append(state + (new - state) * (at - before) / (now - before))
            self.steps += 1
        self.power = power
        self.last = now, np.concatenate([q, u, [self.loss]])
        return time.process_time() - self.begun < self.limit

    def solve(self):
        system = exu.SystemContainer()
        mbs = system.AddSystem()
        node = mbs.AddNode(
            items.NodeGenericODE2(
                referenceCoordinates=[0.0, 0.0],
                initialCoordinates=list(self.equations.start[0:2]),
                initialCoordinates_t=list(self.equations.start[2:4]),
                numberOfODE2Coordinates=2,
            )
        )
        mbs.AddObject(
            items.ObjectGenericODE2(
                nodeNumbers=[node],
                massMatrix=np.eye(2),
                forceUserFunction=self.force,
                jacobianUserFunction=self.jacobian,
            )
        )
        mbs.Assemble()
        mbs.SetPreStepUserFunction(self.before_step)
        end = INTERVAL * (self.rows - 1)
        settings = exu.SimulationSettings()
        integration = settings.timeIntegration
        integration.endTime = end
        integration.numberOfSteps = round(end / self.step)
        integration.verboseMode = 0
        integration.adaptiveStep = True
        integration.minimumStepSize = 1e-9
        integration.generalizedAlpha.spectralRadius = 0.8
        integration.newton.useModifiedNewton = False
        integration.newton.numericalDifferentiation.doSystemWideDifferentiation = False
        settings.solutionSettings.writeSolutionToFile = False
        settings.displayStatistics = False
        settings.displayComputationTime = False
        cpu, wall = time.process_time(), time.perf_counter()
        self.begun = cpu
        failure = ""
        try:
            finished = mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.GeneralizedAlpha)
        except Exception as error:  # Exudyn raises several kinds
            finished, failure = False, str(error).strip().splitlines()[-1]
        data = mbs.systemData
        spent = time.process_time() - cpu
        if finished and spent < self.limit:
            self.before_step(mbs, end)
        elif not failure:
            word = "out of time" if spent >= self.limit else "stopped"
            failure = f"{word} at t = {data.GetTime():.3f} s"
        return {
            "cpu": spent,
            "wall": time.perf_counter() - wall,
            "repeats": 1,
            "steps": self.steps,
            "rejected": 0,
            "derivatives": self.equations.derivatives,
            "jacobians": self.equations.jacobians,
            "factorizations": 0,
            "rows": len(self.states),
            "failure": failure.replace('"', "'"),
        }


def main(library, case, tolerance, limit, file, rows):
    warnings.filterwarnings("ignore")
    run = Run(library, case, STEPS[tolerance], float(limit), int(rows))
    outcome = run.solve()
    np.asarray(run.states).tofile(file)
    print(json.dumps(outcome))


if __name__ == "__main__":
    main(*sys.argv[1:])
