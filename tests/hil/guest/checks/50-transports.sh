# The transports' own tests, which elsewhere skip for want of a bus and a USB cable. They take both for themselves.

check_50_transports_hold_on_real_buses() {
  systemctl stop locusd; stop_serial_feed; stop_can_feed
  unplug_usb_serial; plug_usb_serial || return 1 # a new cable holds no old bytes
  ./unit_drivers --gtest_filter='UsbSerial.*:Vcan.*' --gtest_brief=0 >/out/transports.log 2>&1 && ! grep -q SKIPPED /out/transports.log && return
  grep -E 'Failure|FAILED|SKIPPED|^ ' /out/transports.log; return 1
}
