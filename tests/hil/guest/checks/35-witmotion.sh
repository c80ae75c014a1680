# An inertial sensor on USB at 200 samples a second while the processors are busy: the cable is pulled in the middle of the stream and
# put back, and samples come again by themselves. The service gets another configuration for it, and its own one back.

check_35_witmotion_comes_back_after_unplugging_under_load() {
  stop_serial_feed
  witmotion_configuration && systemctl restart locusd || return 1
  start_load; start_witmotion_feed
  pull_and_put_back 2; local result=$?
  stop_load; stop "$witmotion_feed"
  write_configuration; systemctl restart locusd; start_serial_feed
  return $result
}

pull_and_put_back() { # pull_and_put_back TIMES
  for ((time = 1; time <= $1; ++time)); do
    more_samples || return 1
    set_usb_plug 0; within 20 input_is wit state waiting || return 1
    set_usb_plug 1; within 20 input_is wit state open || return 1
    more_samples && [ "$(input_field wit reconnects)" -ge "$time" ] || return 1
  done
}
more_samples() { local before; before=$(input_field wit measurements); within 20 has_samples $((before + 100)); }
has_samples() { [ "$(input_field wit measurements)" -gt "$1" ]; }

# The kernel takes the device away as if it was pulled; g_serial itself cannot be unloaded while somebody writes to it.
set_usb_plug() {
  [ -n "${usb_plug:-}" ] || usb_plug=$(readlink -f /sys/class/tty/ttyACM0/device/..)/authorized
  echo "$1" >"$usb_plug"
}

witmotion_configuration() {
  write_configuration
  sed -i 's#name: trek\(.*\)decoder: trek1000#name: wit\1decoder: witmotion, tag: 0#' /etc/locusd/locusd.yaml
  grep -q 'decoder: witmotion' /etc/locusd/locusd.yaml || says "a trek1000 input to replace"
}

start_load() { load=(); for _ in 1 2; do (while :; do :; done) & load+=($!); done; }
stop_load() { for job in "${load[@]}"; do stop "$job"; done; }

# protocols.md E-4f: 1 g upwards, 10 deg/s and an angle, 200 times a second; opened anew when the cable was pulled.
start_witmotion_feed() { python3 witmotion_feed.py /dev/ttyGS0 & witmotion_feed=$!; }
