"""Files of NUCARS: read them, look for doubtful values, change one, run the half-truck that they describe.

    python examples/reading_nucars.py
"""

import wedgelab as wl

name = "nucars_69_constant_toe_out"
system = wl.nucars.read("bolst_wedge_sf_69_const.sys")  # built in; a path reads a file of yours
print(system.title)
print(system.tables["bodies"].to_pandas().to_string(index=False))
for finding in system.findings:
    print(f"line {finding.line}: {finding.severity}: {finding.message}")

result = wl.HalfTruckCase(name, duration=5.0).run()
for number, wedge in result.summary.wedges.items():
    print(f"wedge {number}: friction {wedge.up} while the body rises, {wedge.down} while it falls")
for column in list(result.columns)[:5]:
    print(f"{column}: {result[column].min():.4g} to {result[column].max():.4g}")
