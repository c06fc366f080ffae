"""What calling from Python costs, and whether many runs keep all processors busy.

``python overhead.py WEDGELAB``, where ``WEDGELAB`` is the program of the command line, built in the same profile. Times are
processor times of whole processes, so that other work on the machine counts little; compare them within one call. The same run is made
``REPEATS`` times by each: the command line with its start and its files left out of the account by taking the difference of a long and a short run.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time

import wedgelab as wl

CASE = "vdrun_toe_0_psi_0"
REPEATS = 5
LENGTHS = (10.0, 40.0)


def of_command(program: str, duration: float, folder: str) -> float:
    """Processor time of ``wedgelab run``, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    interval = f"simulation.output_interval={duration / 1000} s"
    settings = ["--set", f"simulation.duration={duration} s", "--set", interval]
    call = [program, "run", CASE, *settings, "--quiet", "--force", "--out", folder]
    subprocess.run(call, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def of_call(duration: float) -> float:
    """Processor time of ``Case.run`` and of reading all columns, s."""
    changes = {"simulation.duration": duration, "simulation.output_interval": duration / 1000}
    start = time.process_time()
    case = wl.Case(CASE).replace(changes)
    case.run().to_dict()
    return time.process_time() - start


def of_step(count: int) -> float:
    """Processor time of a step of 1 ms of the yawed wedge, s."""
    from math import cos, sin

    case = wl.Case("cdrun_toe_out_0.2_psi_0.012")
    wedge = wl.Wedge(case, bolster={"yaw": 0.012})
    start = time.process_time()
    for k in range(1, count + 1):
        t = 1e-3 * k
        position = [0.0, 0.0, 0.0254 * sin(2.0 * t), 0.0, 0.0, 0.012]
        rate = [0.0, 0.0, 0.0508 * cos(2.0 * t), 0.0, 0.0, 0.0]
        wedge.step(wl.Motion(position, rate), 1e-3)
    return (time.process_time() - start) / count


def busy(workers: int, count: int) -> tuple[float, float, float]:
    """How busy ``workers`` processors are in ``count`` short runs, and the wall time, s.

    Two shares: processor time over wall time, which is right on an idle machine only; and the time in which the workers computed or waited for a
    processor that others had, which says what we leave idle (Linux only; NaN elsewhere).
    """
    base = wl.Case("cdrun_toe_out_0.2_psi_0.012").replace({"simulation.duration": "1 s"})
    cases = [base.replace({"friction.column": 0.2 + 0.3 * k / count}) for k in range(count)]
    own = os.listdir("/proc/self/task") if os.path.isdir("/proc/self/task") else []
    seen: dict[str, tuple[float, float]] = {}

    def look(_done: int, _count: int) -> None:
        now = time.perf_counter()
        for task in set(os.listdir("/proc/self/task")) - set(own):
            try:
                with open(f"/proc/self/task/{task}/schedstat", encoding="ascii") as file:
                    ran, waited, _ = map(int, file.read().split())
            except OSError:
                continue
            seen[task] = ((ran + waited) * 1e-9, now)

    start, wall = time.process_time(), time.perf_counter()
    wl.run_many(cases, workers=workers, columns=["time", "vertical_wedge_force"], progress=look if own else False)
    ended = time.perf_counter() - wall
    share = (time.process_time() - start) / ended / workers
    ready = [spent / (until - wall) for spent, until in seen.values() if until - wall > 0.5 * ended]
    return share, sum(ready) / workers if ready else float("nan"), ended


def main() -> None:
    """Measures and prints."""
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    program = sys.argv[1]
    times: dict[str, list[list[float]]] = {"command": [[], []], "python": [[], []]}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(REPEATS):
            # Turn by turn, so that what else the machine does falls on both.
            for place, duration in enumerate(LENGTHS):
                times["command"][place].append(of_command(program, duration, folder))
                times["python"][place].append(of_call(duration))
    print(f"{CASE}, 1000 rows; least processor time of {REPEATS}:")
    for name, (short, long) in times.items():
        rate = (min(long) - min(short)) / (LENGTHS[1] - LENGTHS[0])
        print(f"  {name:8} 10 s: {min(short):.3f} s, 40 s: {min(long):.3f} s; per simulated second {rate * 1e3:.2f} ms")
    print(f"  10 s called from Python over the command line: {min(times['python'][0]) / min(times['command'][0]):.3f}")
    print(f"A step of 1 ms from Python, yawed: {of_step(5000) * 1e6:.1f} us")
    workers = len(os.sched_getaffinity(0))
    share, ready, wall = busy(workers, 1000)
    print(
        f"1000 runs of 1 s on {workers} processors: {wall:.1f} s, each busy {100.0 * share:.0f} %, "
        f"busy or kept waiting by others {100.0 * ready:.0f} %"
    )


if __name__ == "__main__":
    main()
