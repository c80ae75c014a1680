# What systemd does to a service: reload, restart, kill, watchdog.

check_40_reload_takes_a_good_file_and_keeps_the_old_one_for_a_bad() {
  local pid; pid=$(main_pid)
  systemctl reload locusd || says "a good file is taken" || return 1
  within 20 good_file_told || return 1
  cp /etc/locusd/locusd.yaml /tmp/good.yaml
  echo 'nonsense: [' >>/etc/locusd/locusd.yaml
  systemctl reload locusd
  within 20 bad_file_told; local told=$?
  cp /tmp/good.yaml /etc/locusd/locusd.yaml
  [ $told = 0 ] && [ "$(main_pid)" = "$pid" ] || says "the same process, with the old settings" || return 1
  has_poses cart
}
journal_has() { journalctl -u locusd --no-pager | grep -q "$1"; }
good_file_told() { journal_has 'read again and in force'; }
bad_file_told() { journal_has 'the configuration in force stays as it was'; }

check_41_stops_when_asked_and_starts_again() {
  systemctl restart locusd && has_poses cart && ! journal_has 'timed out. Killing'
}

check_42_is_started_again_after_kill() {
  local pid; pid=$(main_pid)
  kill -9 "$pid"
  within 20 another_pid_than "$pid" && has_poses cart
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
