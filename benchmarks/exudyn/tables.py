"""The results of the comparison as Markdown."""

from __future__ import annotations

from typing import Any

WHOLE_RUN = {
    "motion_work_lbf_in": "work of the prescribed motions, whole run [lbf in]",
    "wedge_friction_loss_lbf_in": "lost in friction at wedges, whole run [lbf in]",
}
"""What is told of a whole run, by its name in the results."""


def percent(found: float, reference: float) -> float:
    """Difference in percent of the reference."""
    return 100.0 * (found - reference) / abs(reference) if reference else float("nan")


def number(value: float) -> str:
    """A value with six digits, thousands apart."""
    return f"{value:,.1f}" if abs(value) < 1e5 else f"{value:,.0f}"


def small(value: float) -> str:
    """A difference in percent, with one digit where it is tiny."""
    if abs(value) < 0.0005:
        return f"{value:+.0e}" if abs(value) > 1e-7 else "0"
    return f"{value:+.3f}"


def table(key: str, entry: dict[str, Any]) -> list[str]:
    """The Markdown table of one comparison."""
    own = key == "own_elements"
    law = "`tanh`" if own else "`bristle`"
    steps = " and ".join(f"{step * 1e6:.0f} µs" for step in entry["steps_s"])
    heads = [
        f"Wedgelab, {law}",
        "Exudyn",
        "difference, %",
        "Exudyn by halving, %",
        "Wedgelab by tolerance, %",
    ]
    if own:
        heads.append("Exudyn from Wedgelab with bristles, %")
    lines = [
        f"**{entry['title']}** (steps {steps})",
        "",
        "| | " + " | ".join(heads) + " |",
        "|---" * (len(heads) + 1) + "|",
    ]
    for name, row in entry["measures"].items():
        cells = [number(row["wedgelab"]), number(row["exudyn"]), small(row["difference_percent"])]
        cells += [small(row["exudyn_by_halving_percent"]), small(row["wedgelab_by_tolerance_percent"])]
        if own:
            cells.append(small(row["from_bristles_percent"]))
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    for kind, shown in WHOLE_RUN.items():
        if kind in entry:
            ours, theirs = entry[kind]["wedgelab"], entry[kind]["exudyn"]
            lines.append(
                f"| {shown} | {number(ours)} | {number(theirs)} | {small(percent(theirs, ours))} | | |"
            )
    lines += ["", f"Differences over all output times: {told(entry['histories_percent_of_largest'])}.", ""]
    return lines


def told(apart: dict[str, dict[str, float]]) -> str:
    """Differences of time histories in words."""
    parts = [f"{name} {v['largest']:.2g} % ({v['root_mean_square']:.2g} %)" for name, v in apart.items()]
    return ", ".join(parts) + ", at most (root mean square), of the largest value"


def tables(results: dict[str, Any]) -> str:
    """All tables as Markdown."""
    lines = []
    for side, title in (
        ("user_function", "One compiled user function"),
        ("own_elements", "Exudyn's own elements"),
    ):
        lines += [f"### {title}", ""]
        for entry in results[side].values():
            lines += table(side, entry)
    lines += ["### Speed below which friction creeps", ""]
    lines += [
        "| | speed, in/s | largest difference of a measure, % | differences over all output times |",
        "|---|---|---|---|",
    ]
    for entry in results["creep"].values():
        for speed, row in entry["by_speed"].items():
            apart = told(row["histories_percent_of_largest"])
            lines.append(f"| {entry['title']} | {speed} | {row['measures_largest_percent']:.2f} | {apart} |")
    lines += [
        "",
        "### Exudyn's own elements without friction at the wedges",
        "",
        "| | largest difference of a measure, % | differences over all output times |",
        "|---|---|---|",
    ]
    for entry in results["frictionless"].values():
        largest = max(abs(value) for value in entry["measures_percent"].values())
        apart = told(entry["histories_percent_of_largest"])
        lines.append(f"| {entry['title']} | {largest:.4f} | {apart} |")
    lines += [
        "",
        "### Longer steps of the user function, first 4.5 s",
        "",
        "| | step | largest difference of a measure, % | processor time |",
        "|---|---|---|---|",
    ]
    for entry in results["long_steps"].values():
        for step, row in entry["by_step"].items():
            apart, cpu = row["measures_largest_percent"], row["cpu_s"]
            lines.append(f"| {entry['title']} | {float(step) * 1e6:.0f} µs | {apart:.3f} | {cpu:.1f} s |")
    lines += [
        "",
        "### Processor time",
        "",
        "| | Exudyn's step | Exudyn | Wedgelab, 1e-6 | ratio |",
        "|---|---|---|---|---|",
    ]
    for side, title in (("user_function", "user function"), ("own_elements", "own elements")):
        for entry in results[side].values():
            spent = entry["cpu_s"]
            lines.append(
                f"| {entry['title']}: {title} | {entry['steps_s'][0] * 1e6:.0f} µs "
                f"| {spent['exudyn'][0]:.1f} s "
                f"| {spent['wedgelab']:.3f} s | {entry['cpu_ratio']:.0f} |"
            )
    made = results["made_with"]
    lines += ["", f"Made with Exudyn {made['exudyn']}, numba {made['numba']}, NumPy {made['numpy']}.", ""]
    return "\n".join(lines)
