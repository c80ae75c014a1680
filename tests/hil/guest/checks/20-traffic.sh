# Bytes on real lines become poses at the socket.

check_20_can_frames_become_poses() {
  start_can_feed
  has_poses cart && locus watch --json --target cart --count 3
}

check_21_usb_serial_becomes_poses() {
  start_serial_feed
  has_poses still && pose_is_at still 2 3 1
}

check_22_every_can_frame_is_counted() {
  [ "$(input_field can kernel_dropped)" = 0 ] && [ "$(input_field can ring_dropped)" = 0 ] && [ "$(input_field can frames)" -gt 100 ]
}
