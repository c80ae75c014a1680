# What the service makes of CAN frames live, `locus replay` makes of the frames that it kept (--record).

check_25_live_poses_are_those_of_the_replay() { live_is_replay /etc/locusd/locusd.yaml can start_can_feed; }

# A recorded flight of a real tag, as tools/convert made frames of it: tests/hil/run lays it here where it has the data.
check_26_a_recorded_flight_flies_live_as_in_the_replay() {
  [ -s /out/guest/flight.can.log ] || { echo "no recordings on this machine: LOCUS_DATA"; return 77; }
  live_is_replay /out/guest/flight.yaml uwb start_flight
}
start_flight() { canplayer -I /out/guest/flight.can.log vcan0=uwb & can_feed=$!; }

live_is_replay() { # live_is_replay CONFIGURATION INPUT FEED: some twelve seconds
  stop_can_feed
  record_live "$1" "$2" || return
  locus watch --json --seconds 18 >/run/live.jsonl & local watcher=$!
  sleep 3; "$3"
  wait "$watcher"
  stop_can_feed; systemctl stop locusd
  cp /run/locusd/live.log /run/live.log
  locus replay /run/live.log --config "$1" --poses /run/replay.jsonl
  record_no_more && start_can_feed && has_poses cart && python3 same_poses.py /run/live.jsonl /run/replay.jsonl
}

drop_in=/run/systemd/system/locusd.service.d
record_live() { # record_live CONFIGURATION INPUT
  mkdir -p $drop_in
  printf '[Service]\nExecStart=\nExecStart=/usr/bin/locusd --config %s --record /run/locusd/live.log\n' "$1" >$drop_in/record.conf
  systemctl daemon-reload && systemctl restart locusd && within 20 input_is "$2" state open
}
record_no_more() {
  rm -r $drop_in /run/locusd/live.log
  systemctl daemon-reload && systemctl restart locusd && within 20 input_is can state open
}
