# The service starts under its hardened unit, as its own user, and says so to systemd.

check_10_starts_and_says_ready() {
  systemctl start locusd && [ "$(systemctl is-active locusd)" = active ] && systemctl status locusd --no-pager -n 0
}

check_11_runs_as_its_own_user_in_real_time() {
  [ "$(ps -o user= -p "$(main_pid)" | cut -c1-6)" = locusd ] || { echo "wrong user"; return 1; }
  grep -h . /proc/"$(main_pid)"/task/*/sched | grep -q '^policy *: *1$' || { echo "no SCHED_FIFO thread"; return 1; }
  [ "$(awk '/VmLck/ {print $2}' /proc/"$(main_pid)"/status)" -gt 0 ] || { echo "memory is not locked"; return 1; }
}

check_12_without_traffic_says_what_is_missing() {
  ! locus status && locus status | grep -qi "no measurement"
}
