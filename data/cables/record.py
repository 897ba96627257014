"""Reconstructs a load-elongation record from Table 2 of the paper: python3 record.py > caroca-4mm-record.csv

The elongations follow from Eq. (5), x_q - x_p = L (F_q - F_p)/(S E_{p-q}), with the moduli over 1-5, 5-10,
10-15, 10-20 and 20-30 % of the breaking force. The paper does not give L, which is 1 m here, nor the modulus
below 1 %, which is E_1-5 here; there is no elongation without force.
"""

import json
import pathlib

table = json.loads((pathlib.Path(__file__).parent / "caroca-4mm.json").read_text())
LENGTH = 1.0
STEPS = [(1, 5, 1), (5, 10, 5), (10, 15, 10), (10, 20, 10), (20, 30, 20)]


def force(percent):
    return percent * table["breaking_force"] / 100


def stretch(p, q, modulus_gpa):
    return 1e3 * LENGTH * (force(q) - force(p)) / (table["section"] * 1e9 * modulus_gpa)


def curve(column, start):
    moduli = {tuple(r): m for r, m in zip(table["ranges"], table[column])}
    x = {1: start}
    for p, q, origin in STEPS:
        x[q] = x[origin] + stretch(p, q, moduli[p, q])
    return x


loading = curve("loading_gpa", stretch(0, 1, table["loading_gpa"][0]))
unloading = curve("unloading_gpa", 0.0)
# Both branches meet at the turning point.
shift = loading[30] - unloading[30]

print("# NOT MEASURED: reconstructed by record.py from Table 2 of Baklouti, Caro, Courteille "
      "(CableCon 2017), see caroca-4mm.json.")
print("# The length of 1 m is a choice, and so is E_1-5 below 1 % of the breaking force; "
      "the paper gives neither.")
print("force_n,elongation_mm,phase")
for percent in sorted(loading):
    print(f"{force(percent):.10g},{loading[percent]:.12g},loading")
for percent in sorted(unloading, reverse=True)[1:]:
    print(f"{force(percent):.10g},{unloading[percent] + shift:.12g},unloading")
