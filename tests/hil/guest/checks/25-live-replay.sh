# What the service makes of CAN frames live, `locus replay` makes of the frames that it kept (--record).

check_25_live_poses_are_those_of_the_replay() {
  stop_can_feed
  record_live && locus watch --json --target cart --seconds 12 >/run/live.jsonl & local watcher=$!
  sleep 6; start_can_feed
  wait "$watcher"
  stop_can_feed; systemctl stop locusd
  cp /run/locusd/live.log /run/live.log
  locus replay /run/live.log --config /etc/locusd/locusd.yaml --target cart --poses /run/replay.jsonl
  record_no_more && start_can_feed && has_poses cart && python3 same_poses.py /run/live.jsonl /run/replay.jsonl
}

drop_in=/run/systemd/system/locusd.service.d
record_live() {
  mkdir -p $drop_in
  printf '[Service]\nExecStart=\nExecStart=/usr/bin/locusd --record /run/locusd/live.log\n' >$drop_in/record.conf
  systemctl daemon-reload && systemctl restart locusd && within 20 input_is can state open
}
record_no_more() {
  rm -r $drop_in /run/locusd/live.log
  systemctl daemon-reload && systemctl restart locusd && within 20 input_is can state open
}
