"""A hundred pushes: five sizes, ten directions, two walks each, on all cores; a table and a map.

    python examples/pushes_study.py [HOW MANY]

Two minutes on two cores; HOW MANY does so many of them. Stopped and started again, it goes on where
it was. The folder `pushes_study` holds the rows (Parquet, JSON lines), a page `report.html`, and
the map `survived.png`.
"""

import sys

import preview_walk as pw

study = pw.Study(
    {
        "robot": "talos",
        "impulse": [40.0, 60.0, 80.0, 100.0, 120.0],
        "direction": [36.0 * k for k in range(10)],
        "push_at": [3.0, 3.4],
        "duration": 6.0,
    },
    name="pushes",
    time_limit=300.0,
    keep="failed",
)

if __name__ == "__main__":
    limit = int(sys.argv[1]) if sys.argv[1:] else None
    results = study.run("pushes_study", resume=True, limit=limit)
    print(results.survival("impulse").round(2))
    pw.write_report(results)
    pw.heat_map(results, "direction", "impulse").savefig("pushes_study/survived.png", dpi=110)
