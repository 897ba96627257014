"""Writes fits.json: samples, and the maximum-likelihood law of each family with its log-likelihood and
Kolmogorov-Smirnov distance. laws.json: quantile, distribution function, log-density, moments of each law.

Distributions are those of scipy.stats. SciPy's numerical fits stop early (weibull_min at 1e-4): where there
is no closed form, the likelihood equations are solved again here, by scipy.optimize.brentq to 1e-15.

    python3 fits.py        (SciPy 1.17.1, NumPy 2.4)
"""
import json
from pathlib import Path

import numpy as np
from scipy import optimize, stats

HERE = Path(__file__).parent
rng = np.random.default_rng(20241121)
samples = {
    "quasi_uniform": 1.34 + 0.25 * rng.uniform(-1, 1, 400) + 0.01 * rng.standard_normal(400),
    "normal": 1.333 + 0.018 * rng.standard_normal(300),
    "skewed": 2.0 * rng.weibull(1.4, 250),
    "heavy_tails": 5.0 + rng.standard_t(2, 200).clip(-4.5, 400),
    "few": np.array([0.9, 1.0, 1.2, 1.7, 2.1]),
}


def gumbel(x):
    def equation(scale):
        weights = np.exp(-(x - x.min()) / scale)
        return scale - x.mean() + (x * weights).sum() / weights.sum()

    spread = x.max() - x.min()
    scale = optimize.brentq(equation, 1e-3 * spread, 10 * spread, xtol=1e-15, rtol=1e-15)
    return -scale * np.log(np.exp(-(x - x.mean()) / scale).mean()) + x.mean(), scale


def logistic(x):
    def location(scale):
        slope = lambda m: np.tanh((x - m) / scale / 2).sum()
        return optimize.brentq(slope, x.min(), x.max(), xtol=1e-15, rtol=1e-15)

    def equation(scale):
        z = (x - location(scale)) / scale
        return (z * np.tanh(z / 2)).mean() - 1

    spread = x.max() - x.min()
    scale = optimize.brentq(equation, 1e-3 * spread, 10 * spread, xtol=1e-15, rtol=1e-14)
    return location(scale), scale


def laws(x):
    yield "uniform", {"min": x.min(), "max": x.max()}, stats.uniform(x.min(), x.max() - x.min())
    yield "normal", {"mean": x.mean(), "std": x.std()}, stats.norm(x.mean(), x.std())
    location, scale = logistic(x)
    yield "logistic", {"location": location, "scale": scale}, stats.logistic(location, scale)
    location, scale = stats.laplace.fit(x)
    yield "laplace", {"location": location, "scale": scale}, stats.laplace(location, scale)
    location, scale = gumbel(x)
    yield "gumbel", {"location": location, "scale": scale}, stats.gumbel_r(location, scale)
    mean, std = np.log(x).mean(), np.log(x).std()
    yield "log_normal", {"log_mean": mean, "log_std": std}, stats.lognorm(std, 0, np.exp(mean))
    location, scale = gumbel(-np.log(x))
    shape, size = 1 / scale, np.exp(-location)
    yield "weibull", {"shape": shape, "scale": size}, stats.weibull_min(shape, 0, size)


out = []
for name, x in samples.items():
    rows = []
    for family, parameters, law in laws(x):
        rows.append({
            "family": family,
            "law": {family: {k: float(v) for k, v in parameters.items()}},
            "log_likelihood": float(law.logpdf(x).sum()),
            "ks_distance": float(stats.kstest(x, law.cdf).statistic),
        })
    best = {f: getattr(stats, s).fit(x, **kw) for f, s, kw in
            [("logistic", "logistic", {}), ("gumbel", "gumbel_r", {}),
             ("weibull", "weibull_min", {"floc": 0})]}
    for row in rows:  # no worse than SciPy's own fit
        if row["family"] in best:
            name_ = {"logistic": stats.logistic, "gumbel": stats.gumbel_r,
                     "weibull": stats.weibull_min}[row["family"]]
            assert row["log_likelihood"] >= name_(*best[row["family"]]).logpdf(x).sum() - 1e-9
    out.append({"name": name, "values": [float(v) for v in x], "fits": rows})
text = json.dumps({"source": "fits.py, scipy 1.17.1", "samples": out}, separators=(",", ":"))
(HERE / "fits.json").write_text(text.replace('{"name"', '\n{"name"') + "\n")

LAWS = [
    ({"uniform": {"min": -18.0, "max": 18.0}}, stats.uniform(-18, 36)),
    ({"normal": {"mean": 102.2, "std": 3.0}}, stats.norm(102.2, 3)),
    ({"truncated_normal": {"mean": 1.0, "std": 2.0, "min": 0.0, "max": 4.0}},
     stats.truncnorm(-0.5, 1.5, 1, 2)),
    ({"truncated_normal": {"mean": 0.0, "std": 1.0, "min": 3.0, "max": 5.0}}, stats.truncnorm(3, 5, 0, 1)),
    ({"truncated_normal": {"mean": 0.0, "std": 1.0, "min": -9.0, "max": -6.0}},
     stats.truncnorm(-9, -6, 0, 1)),
    ({"triangular": {"min": -1.0, "mode": 0.5, "max": 2.0}}, stats.triang(0.5, -1, 3)),
    ({"triangular": {"min": 0.0, "mode": 0.0, "max": 2.0}}, stats.triang(0.0, 0, 2)),
    ({"triangular": {"min": 0.0, "mode": 2.0, "max": 2.0}}, stats.triang(1.0, 0, 2)),
    ({"beta": {"alpha": 2.0, "beta": 3.5, "min": -1.0, "max": 1.0}}, stats.beta(2, 3.5, -1, 2)),
    ({"beta": {"alpha": 0.5, "beta": 0.7, "min": 0.0, "max": 1.0}}, stats.beta(0.5, 0.7)),
    ({"log_normal": {"log_mean": 0.3, "log_std": 0.2}}, stats.lognorm(0.2, 0, np.exp(0.3))),
    ({"weibull": {"shape": 11.0, "scale": 1.4}}, stats.weibull_min(11, 0, 1.4)),
    ({"logistic": {"location": 1.3, "scale": 0.05}}, stats.logistic(1.3, 0.05)),
    ({"gumbel": {"location": 1.3, "scale": 0.05}}, stats.gumbel_r(1.3, 0.05)),
    ({"laplace": {"location": 1.3, "scale": 0.05}}, stats.laplace(1.3, 0.05)),
]
U = [1e-6, 0.01, 0.2, 0.5, 0.51, 0.9, 0.999]
rows = []
for law, reference in LAWS:
    x = [float(v) for v in reference.ppf(U)]
    rows.append({"law": law, "mean": float(reference.mean()), "std": float(reference.std()), "u": U,
                 "quantile": x, "cdf": [float(v) for v in reference.cdf(x)],
                 "ln_pdf": [float(v) for v in reference.logpdf(x)]})
text = json.dumps({"source": "fits.py, scipy 1.17.1", "laws": rows}, separators=(",", ":"))
(HERE / "laws.json").write_text(text.replace('{"law":{', '\n{"law":{') + "\n")
