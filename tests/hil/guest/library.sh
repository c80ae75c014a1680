# What the rig's checks share: the cable, the bus, the traffic, and waiting with an end.

within() { # within SECONDS COMMAND...: tries until it holds
  local until=$((SECONDS + $1)); shift
  until "$@"; do [ $SECONDS -lt $until ] || { echo "not within the time: $*"; return 1; }; sleep 0.3; done
}

# It says that it were what a TREK1000 has.
plug_usb_serial() { insmod /rig/g_serial.ko idVendor=0x0483 idProduct=0x5740 iSerialNumber=RIG01 && within 20 usb_serial_is_there; }
unplug_usb_serial() { rmmod g_serial; }
usb_serial_is_there() { [ -n "$(usb_serial)" ] && [ -c /dev/ttyGS0 ]; }
usb_serial() { ls /dev/serial/by-id/* 2>/dev/null | head -1; }

# A tag that stands still at (2, 3, 1) among the anchors of configuration.yaml, said in TREK1000's words at 10 Hz.
trek_line() { printf 'mc 0f %08x %08x %08x %08x %04x %02x %08x a0:0\r\n' 3640 8675 9447 5590 "$1" $(($1 % 256)) $(($1 * 100)); }
feed_serial() {
  stty -F /dev/ttyGS0 raw -echo
  for ((i = 0; i < 3000; ++i)); do trek_line $i; sleep 0.1; done >/dev/ttyGS0
}
start_serial_feed() { stop_serial_feed; feed_serial & serial_feed=$!; }
stop_serial_feed() { stop "${serial_feed:-}"; }
stop() { [ -z "$1" ] || { kill "$1"; wait "$1"; } 2>/dev/null; }

start_can_feed() { stop_can_feed; canplayer -l i -I /out/guest/can.log vcan0=can & can_feed=$!; }
stop_can_feed() { stop "${can_feed:-}"; }

write_configuration() {
  mkdir -p /etc/locusd
  sed "s#@SERIAL@#$(usb_serial)#" configuration.yaml >/etc/locusd/locusd.yaml
}

input_field() { # input_field NAME FIELD: of one input, as locus says it
  locus sources --json | python3 -c '
import json, sys
inputs = {i["name"]: i for i in json.load(sys.stdin)["inputs"]}
print(inputs.get(sys.argv[1], {}).get(sys.argv[2], ""))' "$1" "$2"
}
input_is() { [ "$(input_field "$1" "$2")" = "$3" ]; }
main_pid() { systemctl show -p MainPID --value locusd; }

# A minute, because the machine is emulated and may be shared; on a quiet one a second is enough.
has_poses() { locus wait --target "$1" --better-than 1.0 --timeout 60; }
pose_is_at() { # pose_is_at TARGET X Y Z: within 0.3 m
  locus watch --json --target "$1" --count 1 | python3 -c '
import json, math, sys
pose = json.loads(sys.stdin.readline())
error_m = math.dist(pose["position_site_m"], map(float, sys.argv[1:]))
print("error", round(error_m, 3), "m")
sys.exit(error_m > 0.3)' "${@:2}"
}
says() { echo "expected: $1"; return 1; }
