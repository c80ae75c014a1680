"""same_poses.py LIVE.jsonl REPLAY.jsonl: whether the poses that went out are those of the replay.

A frame stamped just before a tick may reach the engine after it; then that tick's pose is the one before it moved on. So not
every pose must be the same to the last digit, but most, and none further away than such a frame can move it.
"""
import json
import math
import sys

LEAST_SAME = 100
MOST_M = 0.3


def poses(path):
    found = {}
    for line in open(path):
        pose = json.loads(line)
        for live_only in ("published", "dropped"):
            pose.pop(live_only, None)
        found[round(pose["time"] * 1e6)] = pose
    return found


live, replay = poses(sys.argv[1]), poses(sys.argv[2])
common = sorted(live.keys() & replay.keys())
same = sum(live[tick] == replay[tick] for tick in common)
furthest_m = max((math.dist(live[t]["position_site_m"], replay[t]["position_site_m"]) for t in common), default=math.inf)
print(f"{len(live)} live poses, {len(common)} of them in the replay, {same} to the last digit, furthest {furthest_m:.4f} m")
sys.exit(not (len(common) > 100 and same >= LEAST_SAME and furthest_m < MOST_M))
