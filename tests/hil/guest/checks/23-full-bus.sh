# A full bus: 8,000 frames a second for 30 s, 80 every 10 ms. Every frame arrives, or its loss is counted. An emulated machine
# may not be able to send so fast: it says how fast it was.

sent_frames() { cat /sys/class/net/vcan0/statistics/tx_packets; }
lost_and_received() { echo $(($(input_field can packets) + $(input_field can kernel_dropped))); }
# Others (a radio that is asked) send a frame now and then: both counts are taken while nobody does.
bus_is_quiet() {
  sent_before=$(sent_frames)
  sleep 0.5
  received_before=$(lost_and_received)
  [ "$(sent_frames)" -eq "$sent_before" ]
}
all_accounted_for() { [ $(($(lost_and_received) - received_before)) -eq $(($(sent_frames) - sent_before)) ]; }

check_23_full_bus_every_frame_is_counted() {
  stop_can_feed
  local sent_before received_before began
  within 20 bus_is_quiet || return 1
  began=$(date +%s%N)
  cangen vcan0 -g 10 -c 80 -n 240000 -I 340 -L 8 -D C80001FF8813F003 || return 1 # a range of 5 m to anchor 1
  local took_ms=$((($(date +%s%N) - began) / 1000000)) code=0
  # The kernel tells of its drops with the next frame.
  cansend vcan0 340#C80001FF8813F003; sleep 1; cansend vcan0 340#C80001FF8813F003
  within 20 all_accounted_for || code=1
  echo "sent $(($(sent_frames) - sent_before)) in $took_ms ms ($((240000000 / took_ms)) a second), received or counted as lost $(($(lost_and_received) - received_before))," \
    "dropped by the kernel $(input_field can kernel_dropped), by the ring $(input_field can ring_dropped)"
  start_can_feed
  [ $code -eq 0 ] && has_poses still
}
