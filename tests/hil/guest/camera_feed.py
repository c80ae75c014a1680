#!/usr/bin/env python3
"""camera_feed INTERFACE: somebody walks to and fro before a camera, with a tag that answers on a CAN bus.

His picture goes to standard output, frame by frame (640 x 480, YUYV), as fast as it is read; his ranges go to INTERFACE in the
words of docs/can-dw1000.md at 10 Hz. The camera is that of camera.yaml: 3 m above (5, -3), looking along y and 25 degrees down.
"""
import math
import random
import socket
import struct
import sys
import threading
import time

WIDTH, HEIGHT, FOCAL_PX, DOWN_RAD = 640, 480, 500, math.radians(25)
CAMERA_M = (5, -3, 3)
ANCHORS_M = [(0, 0, 0.5), (10, 0, 2.5), (10, 8, 0.5), (0, 8, 2.5)]
TAG, TAG_HEIGHT_M, BODY_M, PERIOD_S = 11, 1.0, 1.7, 40
WALL, CLOTHES = 170, 60


def walker_m() -> tuple[float, float]:
    return 5 + 2.5 * math.sin(2 * math.pi * time.monotonic() / PERIOD_S), 5.0


def pixel(x_m: float, y_m: float, z_m: float) -> tuple[int, int]:
    right, ahead, up = x_m - CAMERA_M[0], y_m - CAMERA_M[1], z_m - CAMERA_M[2]
    depth = ahead * math.cos(DOWN_RAD) - up * math.sin(DOWN_RAD)
    below = -ahead * math.sin(DOWN_RAD) - up * math.cos(DOWN_RAD)
    return round(WIDTH / 2 + FOCAL_PX * right / depth), round(HEIGHT / 2 + FOCAL_PX * below / depth)


def grain(grey: int, pixels: int) -> bytes:
    """YUYV without colour, with a sensor's noise."""
    noise = random.Random(grey)
    return b"".join(bytes((grey + noise.randint(-2, 2), 128)) for _ in range(pixels))


def pictures():
    wall, clothes = grain(WALL, WIDTH * HEIGHT), grain(CLOTHES, WIDTH)
    while True:
        x_m, y_m = walker_m()
        foot, head = pixel(x_m, y_m, 0), pixel(x_m, y_m, BODY_M)
        half_px = round(0.18 * (foot[1] - head[1]))
        picture = bytearray(wall)
        for row in range(head[1], foot[1] + 1):
            begin = 2 * (row * WIDTH + foot[0] - half_px)
            picture[begin : begin + 4 * half_px] = clothes[: 4 * half_px]
        yield picture


def answer_on(bus: socket.socket) -> None:
    sequence = 0
    while True:
        for number, anchor in enumerate(ANCHORS_M):
            range_mm = round(1000 * math.dist((*walker_m(), TAG_HEIGHT_M), anchor))
            word = TAG | number << 16 | 0xFF << 24 | range_mm << 32 | 4 << 52 | (sequence & 15) << 60
            bus.send(struct.pack("=IB3xQ", 0x340, 8, word))
            sequence += 1
        time.sleep(0.1)


def main() -> None:
    bus = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    bus.bind((sys.argv[1],))
    threading.Thread(target=answer_on, args=(bus,), daemon=True).start()
    for picture in pictures():
        sys.stdout.buffer.write(picture)


main()
