# A full bus: 8,000 frames a second for 30 s, 80 every 10 ms. Every frame arrives, or its loss is counted. An emulated machine
# may not be able to send so fast: it says how fast it was.

full_bus_frames=240000

# Frames that the decoder understood are those sent here: the bus has others now and then (a radio that is asked).
counted() { echo $(($(input_field can frames) + $(input_field can kernel_dropped))); }
feed_is_read() { local before=$(counted); [ "$(counted)" -eq "$before" ]; }
all_accounted_for() { [ $(($(counted) - counted_before)) -ge $((full_bus_frames + 2)) ]; }

check_23_full_bus_every_frame_is_counted() {
  stop_can_feed
  local counted_before dropped_before began
  within 20 feed_is_read || return 1
  counted_before=$(counted) dropped_before=$(input_field can kernel_dropped) began=$(date +%s%N)
  cangen vcan0 -g 10 -c 80 -n $full_bus_frames -I 340 -L 8 -D C80001FF8813F003 || return 1 # a range of 5 m to anchor 1
  local took_ms=$((($(date +%s%N) - began) / 1000000))
  # The kernel tells of its drops with the next frame.
  cansend vcan0 340#C80001FF8813F003; sleep 1; cansend vcan0 340#C80001FF8813F003
  local code=0; within 20 all_accounted_for || code=1
  local found=$(($(counted) - counted_before)) dropped=$(($(input_field can kernel_dropped) - dropped_before))
  echo "sent $((full_bus_frames + 2)) in $took_ms ms ($((full_bus_frames * 1000 / took_ms)) a second), received or counted as lost $found," \
    "lost in the kernel $dropped, in the ring $(input_field can ring_dropped)"
  start_can_feed
  # Where the kernel drops, what it drops may be others' frames as well.
  [ $code -eq 0 ] && { [ $dropped -gt 0 ] || [ $found -eq $((full_bus_frames + 2)) ]; } && has_poses still
}
