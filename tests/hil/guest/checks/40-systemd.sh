# What systemd does to a service: reload, restart, kill, watchdog.

check_40_reload_takes_a_good_file_and_keeps_the_old_one_for_a_bad() {
  local pid; pid=$(main_pid)
  systemctl reload locusd && [ "$(main_pid)" = "$pid" ] || return 1
  cp /etc/locusd/locusd.yaml /tmp/good.yaml
  echo 'nonsense: [' >>/etc/locusd/locusd.yaml
  systemctl reload locusd; sleep 1
  cp /tmp/good.yaml /etc/locusd/locusd.yaml
  [ "$(main_pid)" = "$pid" ] && locus wait --target cart --better-than 1.0 --timeout 20
}

check_41_stops_within_a_second_of_its_own_and_starts_again() {
  systemctl restart locusd && locus wait --target cart --better-than 1.0 --timeout 30
}

check_42_is_started_again_after_kill() {
  local pid; pid=$(main_pid)
  kill -9 "$pid"
  within 20 another_pid_than "$pid" && locus wait --target cart --better-than 1.0 --timeout 30
}
another_pid_than() { local now; now=$(main_pid); [ "$now" != 0 ] && [ "$now" != "$1" ] && [ "$(systemctl is-active locusd)" = active ]; }

check_43_watchdog_fires_when_the_fusion_thread_stands_still() {
  mkdir -p /run/systemd/system/locusd.service.d
  printf '[Service]\nEnvironment=LOCUSD_DEBUG_STALL_SIGNAL=1\n' >/run/systemd/system/locusd.service.d/stall.conf
  systemctl daemon-reload; systemctl restart locusd || return 1
  local pid; pid=$(main_pid)
  kill -USR2 "$pid"
  within 40 another_pid_than "$pid" && journalctl -u locusd --no-pager | grep -qi 'watchdog'
}
