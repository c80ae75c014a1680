# Bytes on real lines become poses at the socket.

check_20_can_frames_become_poses() {
  start_can_feed
  has_poses cart && locus watch --json --target cart --count 3
}

check_21_usb_serial_becomes_poses() {
  start_serial_feed
  has_poses still || return 1
  locus watch --json --target still --count 1 | python3 -c '
import json, math, sys
pose = json.loads(sys.stdin.readline())
error_m = math.dist(pose["position_site_m"], (2, 3, 1))
print("error", round(error_m, 3), "m")
sys.exit(error_m > 0.3)'
}

check_22_every_can_frame_is_counted() {
  [ "$(input_field can kernel_dropped)" = 0 ] && [ "$(input_field can ring_dropped)" = 0 ] && [ "$(input_field can frames)" -gt 100 ]
}
