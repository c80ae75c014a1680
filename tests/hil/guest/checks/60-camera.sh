# The camera source on a device of the kernel: vivid, which makes its pictures itself.

check_60_camera_gives_frames_of_the_kernel() {
  [ -c /dev/video0 ] || { says "/dev/video0 (the module vivid)"; return 1; }
  LOCUS_CAMERA=/dev/video0 ./unit_camera --gtest_filter='*V4l2Rig*' >/out/camera.log 2>&1 && ! grep -q SKIPPED /out/camera.log && return
  grep -E 'Failure|FAILED|SKIPPED|^ ' /out/camera.log; return 1
}
