"""The same study on a Dask cluster: here its scheduler and two workers are on this machine.

    python examples/cluster_study.py

On real clusters only the address differs; see docs/campaigns.md.
"""

import preview_walk as pw

study = pw.Study(
    {"robot": ["talos", "g1"], "velocity": [(0.2, 0.0, 0.0), (0.3, 0.0, 0.2)], "duration": 2.0},
    name="cluster",
)

if __name__ == "__main__":
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        results = study.run("cluster_study", resume=True, scheduler=cluster.scheduler_address)
    print(results)
