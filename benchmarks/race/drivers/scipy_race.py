"""SciPy in the race: LSODA, BDF and Radau; the right-hand side and the Jacobian matrix are the compiled ones.

scipy_race.py LIBRARY METHOD CASE TOLERANCE LIMIT FILE [ROWS]

METHOD is lsoda, bdf or radau. LIMIT is CPU time, s. Writes the states of all rows reached to FILE (double, row by row) and one line
of JSON to the standard output. LSODA is called through `odeint`, whose loop is compiled; BDF and Radau step in Python. Options beyond
the defaults: the smallest relative tolerance that is taken (0 for LSODA, 1e-13 for the others) and an absolute one of
tolerance times scale for each state, as every solver here; no limit of steps between rows.
"""

import ctypes
import json
import sys
import time
import warnings

import numpy as np
import scipy.integrate

RELATIVE = 1e-13


class Equations:
    """The compiled equations of one problem."""

    def __init__(self, library, name):
        lib = ctypes.CDLL(library)
        pointer, number = ctypes.c_void_p, ctypes.c_double
        lib.race_open.restype = pointer
        lib.race_open.argtypes = [ctypes.c_char_p]
        for function in (lib.race_dimension, lib.race_rows):
            function.argtypes = [pointer]
        lib.race_time.restype = number
        lib.race_time.argtypes = [pointer, ctypes.c_int]
        lib.race_start.argtypes = [pointer, pointer, pointer]
        for function in (lib.race_rates, lib.race_jacobian):
            function.argtypes = [pointer, number, pointer, pointer]
        self.lib, self.handle = lib, lib.race_open(name.encode())
        if not self.handle:
            raise SystemExit(f"there is no problem {name}")
        self.n = n = lib.race_dimension(self.handle)
        self.times = np.array([lib.race_time(self.handle, row) for row in range(lib.race_rows(self.handle))])
        self.start, self.scales = np.empty(n), np.empty(n)
        lib.race_start(self.handle, self.start.ctypes.data, self.scales.ctypes.data)
        # Fixed memory, so that a call costs little: the state is copied in, the answer copied out.
        self.x, self.dx, self.matrix = np.empty(n), np.empty(n), np.empty((n, n))
        self.places = [array.ctypes.data for array in (self.x, self.dx, self.matrix)]
        self.derivatives = self.jacobians = 0

    def rates(self, time, x):
        self.x[:] = x
        self.lib.race_rates(self.handle, time, self.places[0], self.places[1])
        self.derivatives += 1
        return self.dx.copy()

    def jacobian(self, time, x):
        self.x[:] = x
        if self.lib.race_jacobian(self.handle, time, self.places[0], self.places[2]):
            raise ArithmeticError("the Jacobian matrix cannot be read out")
        self.jacobians += 1
        return self.matrix.T.copy()


class OutOfTime(Exception):
    """The limit of CPU time is passed."""


def lsoda(equations, times, absolute, limit):
    """Row by row in blocks, so that a run can be stopped: each block continues where the last one ended."""
    begun = time.process_time()
    rows, steps, failure = [equations.start.copy()], 0, ""
    rates = equations.rates

    def watched(t, x):
        if equations.derivatives % 4096 == 0 and time.process_time() - begun > limit:
            raise OutOfTime(t)
        return rates(t, x)

    try:
        # One call: a restart at each block would cost LSODA its history.
        states, report = scipy.integrate.odeint(
            watched, equations.start, times, tfirst=True, Dfun=equations.jacobian, rtol=0.0, atol=absolute,
            mxstep=2**31 - 1, mxhnil=0, full_output=True,
        )
        steps = int(report["nst"][-1])
        if report["message"] != "Integration successful.":
            done = int(np.sum(report["tcur"] > 0))
            failure = f"{report['message']} at t = {times[min(done, len(times) - 1)]:.3f} s"
            states = states[: done + 1]
        rows = list(states)
    except OutOfTime as error:
        failure = f"out of time at t = {error.args[0]:.3f} s"
    return rows, {"steps": steps, "rejected": 0, "factorizations": 0, "failure": failure}


def stepping(solver, equations, times, absolute, limit):
    """One of SciPy's own solvers, step by step."""
    begun = time.process_time()
    one = solver(
        equations.rates, 0.0, equations.start, times[-1], rtol=RELATIVE, atol=absolute, jac=equations.jacobian
    )
    rows, steps, failure = [equations.start.copy()], 0, ""
    while one.status == "running":
        message = one.step()
        if one.status == "failed":
            failure = f"{message} at t = {one.t:.4f} s"
            break
        steps += 1
        if len(rows) < len(times) and times[len(rows)] <= one.t:
            dense = one.dense_output()
            while len(rows) < len(times) and times[len(rows)] <= one.t:
                rows.append(dense(times[len(rows)]))
        if steps % 64 == 0 and time.process_time() - begun > limit:
            failure = f"out of time at t = {one.t:.3f} s"
            break
    return rows, {"steps": steps, "rejected": 0, "factorizations": one.nlu, "failure": failure}


def main(library, method, case, tolerance, limit, file, rows=None):
    warnings.filterwarnings("ignore")
    tolerance, limit = float(tolerance), float(limit)
    best, spent, repeats = None, 0.0, 0
    while True:
        equations = Equations(library, case)
        times = equations.times if rows is None else equations.times[: int(rows)]
        absolute = tolerance * equations.scales
        cpu, wall = time.process_time(), time.perf_counter()
        if method == "lsoda":
            states, outcome = lsoda(equations, times, absolute, limit)
        else:
            solver = {"bdf": scipy.integrate.BDF, "radau": scipy.integrate.Radau}[method]
            states, outcome = stepping(solver, equations, times, absolute, limit)
        outcome["cpu"], outcome["wall"] = time.process_time() - cpu, time.perf_counter() - wall
        outcome["derivatives"], outcome["jacobians"] = equations.derivatives, equations.jacobians
        outcome["rows"] = len(states)
        spent, repeats = spent + outcome["cpu"], repeats + 1
        if best is None or outcome["cpu"] < best[0]["cpu"]:
            best = outcome, states
        if outcome["failure"] or spent > 0.5 or repeats == 5:
            break
    outcome, states = best
    outcome["repeats"] = repeats
    np.asarray(states).tofile(file)
    print(json.dumps(outcome))


if __name__ == "__main__":
    main(*sys.argv[1:])
