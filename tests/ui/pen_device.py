#!/usr/bin/env python3
"""A pen or a mouse for the X server's `inputtest` driver (man inputtestdrv):
    pen_device.py SOCKET WIDTH HEIGHT < commands
One command a line: 'move X Y PRESSURE' (screen pixels, 0 to 1; of a mouse, none), 'press', 'release',
'sleep SECONDS'.
Each is done when the server has seen it."""
import socket
import struct
import sys
import time

VERSION, SYNC, MOTION, BUTTON = 0, 1, 2, 4  # events of the protocol
LARGEST = 65535.0  # of the axes x and y
HARDEST = 1000.0  # of the pressure, axis 4


def axes(values):
    """@param values {axis: value}; the C structure, doubles at a multiple of eight"""
    numbers = [0.0] * 128
    mask = bytearray(8)
    for axis, value in values.items():
        mask[axis // 8] |= 1 << axis % 8
        numbers[axis] = value
    return struct.pack("<I8s4x128d", 0, bytes(mask), *numbers)


class Pen:
    def __init__(self, path, size):
        self.size = size
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.connect(path)
        self.send(VERSION, struct.pack("<HH", 1, 0))
        self.answer()

    def send(self, kind, body=b""):
        self.socket.sendall(struct.pack("<II", 8 + len(body), kind) + body)

    def answer(self):
        length, _ = struct.unpack("<II", self.socket.recv(8, socket.MSG_WAITALL))
        self.socket.recv(length - 8, socket.MSG_WAITALL)

    def sync(self):
        self.send(SYNC)
        self.answer()

    def move(self, x, y, pressure=None):
        values = {0: (x + 0.5) * LARGEST / self.size[0], 1: (y + 0.5) * LARGEST / self.size[1]}
        if pressure is not None:
            values[4] = pressure * HARDEST
        self.send(MOTION, struct.pack("<I4x", 1) + axes(values))
        self.sync()

    def button(self, is_press):
        self.send(BUTTON, struct.pack("<iiI4x", 1, 1, is_press) + axes({}))
        self.sync()


def main():
    pen = Pen(sys.argv[1], (float(sys.argv[2]), float(sys.argv[3])))
    for line in sys.stdin:
        word, *numbers = line.split()
        if word == "move":
            pen.move(*map(float, numbers))
        elif word == "sleep":
            time.sleep(float(numbers[0]))
        else:
            pen.button(word == "press")


if __name__ == "__main__":
    main()
