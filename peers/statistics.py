"""SALib and OpenTURNS on the functions of the table `measures`, next to its rows: peers/run statistics.

    statistics.py FOLDER STUDIES [PART_OF_THE_NAMES_OF_MEASURES]

`FOLDER/exact.json` is what `crates/cdpr-sensitivity/examples/statistics` has written: laws of the inputs, values
that count as true, and one point with its output, which the functions below must have as well;
`FOLDER/measures.json` has its rows. A row has program, function, measure, runs, studies, error (largest root mean
square error of an input), held (share of the intervals of 95 % that hold the true value [%], mean and least over the
inputs) and ms (CPU time of a study with its runs, on one thread); `why` where there is no number. Prints a table for
each measure, with a row for each function and a column for each program.
"""

import json
import sys
import time
import warnings
from functools import partial

import numpy as np
import openturns as ot
from SALib.analyze import delta, morris as morris_analysis, pawn, rbd_fast, sobol as sobol_analysis
from SALib.sample import latin, morris as morris_sample, sobol as sobol_sample

NEAR = 1e-4
BLOCKS, ROWS, WALKS = 256, 256, 64

#: Rows of all programs.
FOUND = []


# The functions, of rows of inputs.


def ishigami(x):
    return np.sin(x[:, 0]) + 7 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def sobol_g(x):
    a = np.array([0, 1, 4.5, 9, 99, 99, 99, 99])
    return np.prod((np.abs(4 * x - 2) + a) / (1 + a), axis=1)


def borehole(x):
    ratio = np.log(x[:, 1] / x[:, 0])
    leak = 2 * x[:, 6] * x[:, 2] / (ratio * x[:, 0] ** 2 * x[:, 7])
    return 2 * np.pi * x[:, 2] * (x[:, 3] - x[:, 5]) / (ratio * (1 + leak + x[:, 2] / x[:, 4]))


def otl_circuit(x):
    base, gain = 12 * x[:, 1] / (x[:, 0] + x[:, 1]), x[:, 5] * (x[:, 4] + 9)
    parts = (base + 0.74) * gain + 11.35 * x[:, 2]
    return parts / (gain + x[:, 2]) + 0.74 * x[:, 2] * gain / ((gain + x[:, 2]) * x[:, 3])


def wing_weight(x):
    sweep = np.cos(np.radians(x[:, 3]))
    area = 0.036 * x[:, 0] ** 0.758 * x[:, 1] ** 0.0035 * (x[:, 2] / sweep**2) ** 0.6
    shape = x[:, 4] ** 0.006 * x[:, 5] ** 0.04 * (100 * x[:, 6] / sweep) ** -0.3
    return area * shape * (x[:, 7] * x[:, 8]) ** 0.49 + x[:, 0] * x[:, 9]


def morris(x):
    w = 2 * (x - 0.5)
    for i in (2, 4, 6):
        w[:, i] = 2 * (1.1 * x[:, i] / (x[:, i] + 0.1) - 0.5)
    y = np.zeros(len(x))
    for i in range(20):
        y += w[:, i] * (20 if i < 10 else (-1) ** (i + 1))
        for j in range(i + 1, 20):
            y += w[:, i] * w[:, j] * (-15 if j < 6 else (-1) ** (i + j))
            for l in range(j + 1, 5):
                y += w[:, i] * w[:, j] * w[:, l] * (-10 + 5 * w[:, l + 1 : max(l + 1, 4)].sum(axis=1))
    return y


FUNCTIONS = {
    "Ishigami": ishigami,
    "Sobol' g": sobol_g,
    "Borehole": borehole,
    "OTL circuit": otl_circuit,
    "Wing weight": wing_weight,
    "Morris": morris,
    "Bratley": lambda x: (np.cumprod(x, axis=1) * np.resize([-1, 1], x.shape[1])).sum(axis=1),
    "x1 x2": lambda x: x[:, 0] * x[:, 1],
    "step": lambda x: (x[:, 0] + 0.2 * x[:, 1] > 0.7).astype(float),
    "additive, 100": lambda x: (x / np.arange(1, x.shape[1] + 1)).sum(axis=1),
}


def failing(x):
    """Ishigami's function, one row in twenty without an output."""
    y = ishigami(x)
    y[np.modf(np.abs(1e4 * x.sum(axis=1)))[0] < 0.05] = np.nan
    return y


# The laws.


def problem(inputs):
    """SALib's dictionary."""
    bounds, dists = [], []
    for law in (one["law"] for one in inputs):
        (kind, of), = law.items()
        if kind == "uniform":
            bounds.append([of["min"], of["max"]])
            dists.append("unif")
        elif kind == "normal":
            bounds.append([of["mean"], of["std"]])
            dists.append("norm")
        else:
            bounds.append([of["log_mean"], of["log_std"]])
            dists.append("lognorm")
    names = [one["name"] for one in inputs]
    found = {"num_vars": len(names), "names": names, "bounds": bounds}
    return found if set(dists) == {"unif"} else {**found, "dists": dists}


def distribution(inputs):
    """OpenTURNS' joint law of independent inputs."""
    marginals = []
    for law in (one["law"] for one in inputs):
        (kind, of), = law.items()
        if kind == "uniform":
            marginals.append(ot.Uniform(of["min"], of["max"]))
        elif kind == "normal":
            marginals.append(ot.Normal(of["mean"], of["std"]))
        else:
            marginals.append(ot.LogNormal(of["log_mean"], of["log_std"]))
    return ot.JointDistribution(marginals)


# The studies: from a seed a list of (values, half widths or ends) by measure.


def salib_sobol(of, f):
    def study(seed):
        x = sobol_sample.sample(of, BLOCKS, calc_second_order=False, seed=seed)
        found = sobol_analysis.analyze(of, f(x), calc_second_order=False, seed=seed)
        return [around(found["S1"], found["S1_conf"]), around(found["ST"], found["ST_conf"])]

    return study


def salib_morris(of, f):
    def study(seed):
        x = morris_sample.sample(of, WALKS, num_levels=4, seed=seed)
        found = morris_analysis.analyze(of, x, f(x), num_levels=4, seed=seed)
        return [around(found["mu_star"], found["mu_star_conf"])]

    return study


def salib_given(of, f, analyse, name="S1"):
    def study(seed):
        x = latin.sample(of, ROWS, seed=seed)
        found = analyse(of, x, f(x), seed=seed)
        if f"{name}_conf" in found:
            return [around(found[name], found[f"{name}_conf"])]
        return [(np.array(found[name], float), None, None)]

    return study


def turns_sobol(law, f, algorithm):
    def study(seed):
        ot.RandomGenerator.SetSeed(seed)
        x = ot.SobolIndicesExperiment(law, BLOCKS).generate()
        found = algorithm(x, sample(f(np.array(x))), BLOCKS)
        first, total = found.getFirstOrderIndicesInterval(), found.getTotalOrderIndicesInterval()
        return [
            within(found.getAggregatedFirstOrderIndices(), first),
            within(found.getAggregatedTotalOrderIndices(), total),
        ]

    return study


def turns_ranks(law, f):
    def study(seed):
        ot.RandomGenerator.SetSeed(seed)
        x = law.getSample(ROWS)
        found = ot.RankSobolSensitivityAlgorithm(x, sample(f(np.array(x))))
        return [within(found.getFirstOrderIndices(), found.getFirstOrderIndicesInterval())]

    return study


def turns_hsic(law, f):
    """R2 of the statistic with Gaussian kernels of the deviations of the sample, as ours."""

    def study(seed):
        ot.RandomGenerator.SetSeed(seed)
        x = law.getSample(ROWS)
        y = sample(f(np.array(x)))
        columns = [x.getMarginal(i) for i in range(law.getDimension())] + [y]
        kernels = [ot.SquaredExponential([of.computeStandardDeviation()[0]], [1.0]) for of in columns]
        found = ot.HSICEstimatorGlobalSensitivity(kernels, x, y, ot.HSICVStat())
        return [(np.array(found.getR2HSICIndices()), None, None)]

    return study


def turns_expansion(law, f):
    """Least angles with a corrected leave-one-out error, in polynomials of degree 4 and norm 0.75."""
    k = law.getDimension()
    index = ot.HyperbolicAnisotropicEnumerateFunction(k, 0.75)
    basis = ot.OrthogonalProductPolynomialFactory([law.getMarginal(i) for i in range(k)], index)
    terms = ot.FixedStrategy(basis, index.getMaximumDegreeCardinal(4))
    fits = ot.LeastSquaresMetaModelSelectionFactory(ot.LARS(), ot.CorrectedLeaveOneOut())

    def study(seed):
        ot.RandomGenerator.SetSeed(seed)
        x = ot.LHSExperiment(law, ROWS).generate()
        y = sample(f(np.array(x)))
        fit = ot.FunctionalChaosAlgorithm(x, y, law, terms, ot.LeastSquaresStrategy(fits))
        fit.run()
        found = ot.FunctionalChaosSobolIndices(fit.getResult())
        of = [found.getSobolIndex, found.getSobolTotalIndex]
        return [(np.array([one(i) for i in range(k)]), None, None) for one in of]

    return study


def around(value, half):
    value, half = np.array(value, float), np.array(half, float)
    return value, value - half, value + half


def within(value, interval):
    return np.array(value), np.array(interval.getLowerBound()), np.array(interval.getUpperBound())


def sample(values):
    return ot.Sample(values.reshape(-1, 1))


# The rows.


def row(program, function, names, truths, runs, studies, study):
    """Errors and coverage of a study over all seeds."""
    about = [
        {"program": program, "function": function, "measure": name, "runs": runs, "studies": studies}
        for name in names
    ]
    squares, held = [0.0] * len(names), [0.0] * len(names)
    try:
        study(10**6)  # the first call loads what it needs
        clock = time.process_time()
        for seed in range(1, studies + 1):
            for i, (value, low, high) in enumerate(study(seed)):
                if not np.isfinite(value).all():
                    raise FloatingPointError("an index is not a number")
                exact = np.array(truths[i])
                near = NEAR * np.maximum(np.abs(exact), 1)
                squares[i] = squares[i] + (value - exact) ** 2 / studies
                held[i] = (
                    None
                    if low is None
                    else held[i] + 100 * ((low - near <= exact) & (exact <= high + near)) / studies
                )
        milliseconds = 1e3 * (time.process_time() - clock) / studies
    except Exception as error:
        reason = str(error).strip().splitlines()[0]
        print(f"{program}, {function}, {names}: {reason}", file=sys.stderr)
        return [{**of, "why": "NaN" if isinstance(error, FloatingPointError) else "error"} for of in about]
    return [
        {
            **of,
            "error": float(np.sqrt(np.max(square))),
            "held": None if shares is None else [float(np.mean(shares)), float(np.min(shares))],
            "ms": milliseconds,
        }
        for of, square, shares in zip(about, squares, held)
    ]


def rows(name, f, exact, studies, part):
    inputs = exact["inputs"]
    k, of, law = len(inputs), problem(inputs), distribution(inputs)
    first, total = exact["first"], exact["total"]
    sobol = ["Sobol' S, 256", "Sobol' T, 256"]
    # One study of many inputs, of a bootstrap of ranks or of an expansion takes up to seconds.
    few, fewest = max(studies // 4, 2), max(studies // 10, 2)
    if k > 20:
        studies, few, fewest = fewest, max(studies // 20, 2), 2

    def add(program, names, truths, runs, count, study):
        if not any(part in of for of in names):
            return
        FOUND.extend(row(program, name, names, truths, runs, count, study))

    add("SALib", sobol, [first, total], BLOCKS * (k + 2), studies, salib_sobol(of, f))
    for label, algorithm in [
        ("Saltelli", ot.SaltelliSensitivityAlgorithm),
        ("Jansen", ot.JansenSensitivityAlgorithm),
    ]:
        study = turns_sobol(law, f, algorithm)
        add(f"OpenTURNS, {label}", sobol, [first, total], BLOCKS * (k + 2), studies, study)
    add("OpenTURNS", ["S by ranks"], [first], ROWS, few, turns_ranks(law, f))
    add("SALib, RBD-FAST", ["S by ranks"], [first], ROWS, few, salib_given(of, f, rbd_fast.analyze))
    study = salib_given(of, f, partial(delta.analyze, method="sobol"))
    add("SALib, delta", ["S by ranks"], [first], ROWS, few, study)
    add("SALib", ["Morris mu*"], [exact["morris"]], WALKS * (k + 1), studies, salib_morris(of, f))
    if k <= 20:
        names = ["expansion S", "expansion T"]
        add("OpenTURNS", names, [first, total], ROWS, fewest, turns_expansion(law, f))
    tables = exact["tables"]
    study = salib_given(of, f, partial(delta.analyze, method="delta"), "delta_raw")
    add("SALib", ["delta, 256"], [tables["delta"]], ROWS, fewest, study)
    add("SALib", ["PAWN"], [tables["pawn"]], ROWS, few, salib_given(of, f, pawn.analyze, "median"))
    add("OpenTURNS", ["HSIC R2"], [tables["r_squared"]], ROWS, few, turns_hsic(law, f))


def cell(row):
    """Error, mean and least share of the intervals that hold, CPU time and number of studies."""
    if row is None or "why" in row:
        return row["why"] if row else "-"
    held = " / ".join(f"{share:.0f}" for share in row["held"]) if row["held"] else "-"
    return f"{row['error']:.4f}; {held}; {row['ms']:.2f}; {row['studies']}"


def tables(rows):
    """Prints a table for each measure that the others have as well."""
    others = {row["measure"] for row in rows if row["program"] != "cdpr"}
    for measure in dict.fromkeys(row["measure"] for row in rows if row["measure"] in others):
        of = {(row["function"], row["program"]): row for row in rows if row["measure"] == measure}
        functions, programs = (list(dict.fromkeys(key[k] for key in of)) for k in (0, 1))
        print(f"\n### {measure}\n\n| function | {' | '.join(programs)} |\n|---|{'---|' * len(programs)}")
        for function in functions:
            print(f"| {function} | {' | '.join(cell(of.get((function, program))) for program in programs)} |")


def main():
    warnings.simplefilter("ignore")
    ot.Log.Show(ot.Log.NONE)
    folder, studies, part = sys.argv[1], int(sys.argv[2]), (sys.argv + [""])[3]
    with open(f"{folder}/measures.json") as file:
        FOUND.extend(json.load(file))
    with open(f"{folder}/exact.json") as file:
        exact = json.load(file)
    for name, of in exact.items():
        f = failing if "fail" in name else FUNCTIONS[name]
        if "fail" not in name:
            ours, theirs = of["output"], float(f(np.array([of["point"]]))[0])
            if abs(ours - theirs) > 1e-12 * max(abs(ours), 1):
                sys.exit(f"{name} is {ours} at {of['point']}, but {theirs} here")
        print(f"{name}", file=sys.stderr)
        rows(name, f, of, studies, part)
    zero = {"inputs": exact["Ishigami"]["inputs"], **{key: [0.0] * 3 for key in ("first", "total", "morris")}}
    zero["tables"] = {key: [0.0] * 3 for key in ("delta", "pawn", "r_squared")}
    rows("constant", lambda x: np.ones(len(x)), zero, 2, part)
    tables(FOUND)


main()
