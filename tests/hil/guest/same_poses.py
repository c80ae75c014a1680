"""same_poses.py LIVE.jsonl REPLAY.jsonl: whether the poses that went out are those of the replay.

A frame stamped just before a tick may reach the engine after it. If that parts the first epoch, the filter starts from another
fix and the two agree to millimetres, never again to the last digit (on a quiet machine they mostly do: tests/fault/live_replay_test
asks for it, over a pseudo-terminal). So: half of the poses within two centimetres, none further than a late epoch can move it.
"""
import json
import math
import statistics
import sys

MEDIAN_M = 0.02
MOST_M = 0.3


def poses(path):
    found = {}
    for line in open(path):
        pose = json.loads(line)
        for live_only in ("published", "dropped"):
            pose.pop(live_only, None)
        found[pose["target"], round(pose["time"] * 1e6)] = pose
    return found


live, replay = poses(sys.argv[1]), poses(sys.argv[2])
common = sorted(live.keys() & replay.keys())
same = sum(live[tick] == replay[tick] for tick in common)
apart_m = [math.dist(live[t]["position_site_m"], replay[t]["position_site_m"]) for t in common] or [math.inf]
print(f"{len(live)} live poses, {len(common)} of them in the replay, {same} to the last digit; "
      f"apart {statistics.median(apart_m):.4f} m (median), {max(apart_m):.4f} m (furthest)")
sys.exit(not (len(common) > 100 and statistics.median(apart_m) < MEDIAN_M and max(apart_m) < MOST_M))
