"""Reads the one real matrix of a MATLAB 5 file: elements of a type and a length, packed ones within
(MAT-File Format, MathWorks, chapter 1)."""
import struct
import zlib

from conversion import Wrong

PACKED, MATRIX = 15, 14
NUMBERS = {1: "b", 2: "B", 3: "h", 4: "H", 5: "i", 6: "I", 7: "f", 9: "d"}


def elements(data):
    """Type and content of each; small ones share eight bytes with their head."""
    at = 0
    while at + 8 <= len(data):
        kind, length = struct.unpack_from("<II", data, at)
        if kind >> 16:
            yield kind & 0xFFFF, data[at + 4 : at + 4 + (kind >> 16)]
            at += 8
        else:
            yield kind, data[at + 8 : at + 8 + length]
            at += 8 + length + (0 if kind == PACKED else -length % 8)


def columns(path):
    """Columns of the first matrix in the file."""
    try:
        for kind, content in elements(path.read_bytes()[128:]):
            for inner, matrix in elements(zlib.decompress(content)) if kind == PACKED else [(kind, content)]:
                if inner == MATRIX:
                    _, (_, size), _, (number, values) = list(elements(matrix))[:4]
                    rows, count = struct.unpack("<2i", size)
                    all_of_them = struct.unpack(f"<{rows * count}{NUMBERS[number]}", values)
                    return [all_of_them[rows * i : rows * (i + 1)] for i in range(count)]
    except (struct.error, zlib.error, KeyError, ValueError) as error:
        raise Wrong(f"{path} is no MATLAB 5 file that can be read: {error}")
    raise Wrong(f"{path} holds no matrix")
