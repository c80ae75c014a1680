# Cables are pulled and buses go down; the daemon stays and comes back to them by itself.

check_29_usb_has_a_name_that_stays() {
  [ /dev/locus/stm32-RIG01 -ef "$(usb_serial)" ] && [ "$(stat -Lc %G /dev/locus/stm32-RIG01)" = dialout ]
}

check_30_usb_unplug_is_noticed() {
  stop_serial_feed
  unplug_usb_serial
  within 15 input_is trek state waiting && [ "$(systemctl is-active locusd)" = active ]
}

check_31_usb_replug_brings_poses_again() {
  plug_usb_serial || return 1
  within 20 input_is trek state open || return 1
  start_serial_feed
  has_poses still
}

check_32_can_down_and_up_brings_frames_again() {
  ip link set vcan0 down; sleep 2; stop_can_feed
  ip link set vcan0 up; sleep 1; start_can_feed
  local before; before=$(input_field can frames)
  within 20 more_can_frames_than "$before"
}
more_can_frames_than() { [ "$(input_field can frames)" -gt "$1" ]; }

check_33_can_interface_removed_and_made_again() {
  stop_can_feed; ip link del vcan0
  within 15 input_is can state waiting || return 1
  ip link add dev vcan0 type vcan; ip link set vcan0 mtu 72 up
  within 15 input_is can state open || return 1
  start_can_feed
  within 20 more_can_frames_than 0 && has_poses cart
}
