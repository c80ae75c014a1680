# A P440 in a RangeNet, as a candump log on interface "can": J1939 broadcasts of full and small ranges from a place that stays, (2, 5, 1), to
# the anchors of configuration.yaml. Written from the page of the protocol, not with the decoder's own code.
import math
import struct

anchors = {0: (0, 0, 0.5), 1: (10, 0, 2.5), 2: (10, 8, 0.5), 3: (0, 8, 2.5)}
place = (2, 5, 1)
los = 8
cycle_s, frame_s, cycles = 0.1, 0.002, 100


def full_range(message, responder, mm):
    return struct.pack(">HHIBBHIIIHHHhHBBHHHHiI", 0x0201, message, responder, 0, 0, 20, mm, mm, mm, 30, 150, 30, 0, 0, 1, 0, los, los, 200, 4000,
                       0, message)


def small_range(message, responder, mm):
    return struct.pack(">HHIHBBBB", 0x0205, message, responder, round(mm / 10), 3, 1, 0, 0)


def broadcast(message):
    parts = [message[i:i + 7] for i in range(0, len(message), 7)]
    yield "10ECFF80#" + struct.pack("<BHBBBH", 0x20, len(message), len(parts), 0xFF, 0x01, 0x00EF).hex().upper()
    for number, part in enumerate(parts, 1):
        yield "10EBFF80#" + (bytes([number]) + part).ljust(8, b"\xff").hex().upper()


for cycle in range(cycles):
    time_s = 1e9 + cycle * cycle_s
    for responder, anchor in anchors.items():
        mm = round(math.dist(anchor, place) * 1000)
        for frame in broadcast((full_range if cycle % 2 else small_range)(cycle, responder, mm)):
            print(f"({time_s:.6f}) can {frame}")
            time_s += frame_s
