# A P440 in a RangeNet, J1939 on a real bus: nine frames a full range, three a small one.

check_24_rangenet_over_j1939_becomes_poses() {
  python3 rangenet_frames.py >/run/rangenet.log
  canplayer -l i -I /run/rangenet.log vcan0=can & local feed=$!
  has_poses walker && pose_is_at walker 2 5 1; local verdict=$?
  stop $feed
  [ $verdict = 0 ] && [ "$(input_field p440 measurements)" -ge 20 ] && [ "$(input_field p440 kernel_dropped)" = 0 ]
}
