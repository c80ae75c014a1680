# A camera of the kernel: vivid, which makes its pictures itself, or shows those that are written to its other end.

check_60_camera_gives_frames_of_the_kernel() {
  [ -c /dev/video0 ] || { says "/dev/video0 (the module vivid)"; return 1; }
  LOCUS_CAMERA=/dev/video0 ./unit_camera --gtest_filter='*V4l2Rig*' >/out/camera.log 2>&1 && ! grep -q SKIPPED /out/camera.log && return
  grep -E 'Failure|FAILED|SKIPPED|^ ' /out/camera.log; return 1
}

check_61_a_walker_is_named_by_camera_and_bus() {
  stop_can_feed; join_camera_ends || return 1
  python3 camera_feed.py vcan0 | v4l2-ctl -d /dev/video1 --stream-out-mmap --stream-from=- >/dev/null 2>&1 & local feed=$!
  cp gate.yaml /etc/locusd/; cp camera.yaml /etc/locusd/locusd.yaml; systemctl restart locusd
  within 180 walker_is_named; local code=$?
  locus view gate --out /out/gate.png; locus sources
  stop $feed; pkill -f camera_feed.py
  write_configuration; systemctl restart locusd
  return $code
}

# Both ends HDMI with one size and timing; what is written while somebody writes is what is read. Of its 60 frames a second
# nine in ten are left out, and nothing is written over them: an emulated machine has better things to do.
join_camera_ends() {
  v4l2-ctl -d /dev/video1 --set-output=1 --set-dv-bt-timings index=0 && v4l2-ctl -d /dev/video0 --set-input=3 &&
    v4l2-ctl -d /dev/video0 --set-dv-bt-timings index=0 && v4l2-ctl -d /dev/video0 -c loop_video=1,osd_text_mode=2,percentage_of_dropped_buffers=90 &&
    v4l2-ctl -d /dev/video1 --set-fmt-video-out=width=640,height=480,pixelformat=YUYV
}

walker_is_named() {
  locus watch --json --target seen --seconds 2 | python3 -c '
import json, sys
seen = [pose for pose in map(json.loads, sys.stdin) if pose.get("seen_as", {}).get("camera") == "gate"]
print("named in", len(seen), "poses", seen[-1:])
sys.exit(not seen)'
}
