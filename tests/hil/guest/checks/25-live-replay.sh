# What the daemon made of CAN frames, `locus replay` makes of the recording of those frames: two sockets see one kernel stamp.

check_25_live_poses_are_those_of_the_replay() {
  stop_can_feed
  systemctl restart locusd && within 20 input_is can state open || return 1
  grep -v 'name: trek' /etc/locusd/locusd.yaml >/run/can.yaml
  locus record --config /run/can.yaml -o /run/live.log --seconds 16 & local recorder=$!
  locus watch --json --target cart --seconds 12 >/run/live.jsonl & local watcher=$!
  sleep 3; start_can_feed
  wait "$watcher"; wait "$recorder"
  locus replay /run/live.log --config /run/can.yaml --target cart --poses /run/replay.jsonl
  python3 same_poses.py /run/live.jsonl /run/replay.jsonl
}
