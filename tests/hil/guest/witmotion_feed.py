#!/usr/bin/env python3
"""witmotion_feed DEVICE: a WitMotion module that says the same 200 times a second, over the gadget's end of a USB serial line."""
import os
import sys
import time
import tty

CYCLE = bytes.fromhex("5551000000000008C4097B" "5552A4000000AEFF0000F8" "55535515E4F8004000002E")


def feed(device: str) -> None:
    line = os.open(device, os.O_RDWR | os.O_NOCTTY)
    try:
        tty.setraw(line)
        while True:
            os.write(line, CYCLE)
            time.sleep(0.005)
    finally:
        os.close(line)


while True:
    try:
        feed(sys.argv[1])
    except OSError:  # the cable was pulled: the kernel hung up
        time.sleep(0.1)
