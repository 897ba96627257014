"""Prints the seconds of a study on each engine, and whether its files are the same.

python engines.py [observations] [engine ...], at the root of the repository

The study is the mechanical sampling of CAROCA alone, without replicates, surfaces and table. Engines are
sequential, rayon, processes, dask and ray.
"""

import concurrent.futures
import contextlib
import hashlib
import json
import os
import sys
import tempfile
import time
from pathlib import Path

import cdpr

ENGINES = ["sequential", "rayon", "processes", "dask", "ray"]


def study_file(folder):
    file = json.loads(Path("data/studies/caroca.json").read_text())
    file["samplings"] = {"mechanical": file["samplings"]["mechanical"]}
    file.update(robot=os.path.abspath("data/robots/caroca.json"), replicates=0, surfaces={})
    path = Path(folder) / "mechanical.json"
    path.write_text(json.dumps(file))
    return path


@contextlib.contextmanager
def engine(name):
    """The arguments of `run`, with whatever has to be started before the clock."""
    if name == "sequential":
        yield {"threads": 1}
    elif name == "rayon":
        yield {"threads": 2}
    elif name == "processes":
        with concurrent.futures.ProcessPoolExecutor(2) as executor:
            list(executor.map(abs, range(2)))
            yield {"executor": executor}
    elif name == "dask":
        import distributed

        with distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster, distributed.Client(cluster) as client:
            yield {"executor": client}
    elif name == "ray":
        import ray
        from ray.util.multiprocessing import Pool

        ray.init(num_cpus=2, include_dashboard=False, logging_level="ERROR")
        with Pool(2) as pool:
            pool.map(abs, range(2))
            yield {"executor": pool}
        ray.shutdown()


def processor():
    """Seconds of processors of this process and its children, the start of an engine included."""
    return sum(os.times()[:4])


def digest(folder):
    varying = ("timings.json", "report.html")
    whole = hashlib.sha256()
    paths = (path for path in Path(folder).rglob("*") if path.is_file() and path.name not in varying)
    for path in sorted(paths):
        whole.update(str(path.relative_to(folder)).encode() + path.read_bytes())
    return whole.hexdigest()[:12]


def main():
    observations = int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000
    with tempfile.TemporaryDirectory() as folder:
        study = study_file(folder)
        for name in sys.argv[2:] or ENGINES:
            out, before = Path(folder) / name, processor()
            with engine(name) as arguments:
                clock = time.perf_counter()
                cdpr.study.run(study, out, observations=observations, table="none", **arguments)
                seconds = time.perf_counter() - clock
            # Children count when they have ended.
            used = processor() - before
            print(f"{name:12} {seconds:6.2f} s, {used:6.2f} s of processors, files {digest(out)}", flush=True)


if __name__ == "__main__":
    main()
