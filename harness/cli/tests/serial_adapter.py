# SPDX-License-Identifier: Apache-2.0
"""A CAN adapter on a serial line that is a pseudo-terminal: the kernel's slcan driver at one end, which makes an interface with a
bit rate and a controller of it, and at the other end this, which carries frames to and from an interface where the device is."""
import fcntl
import os
import pty
import select
import socket
import struct
import subprocess
import termios
import threading
import tty

LINE_DISCIPLINE = 17  # N_SLCAN
SIOCGIFNAME = 0x8910
CAN_FRAME = struct.Struct("<IB3x8s")


class SerialAdapter:
    """Interface `name`, bridged to `bus`; OSError where the kernel has no slcan or we may not use it."""

    def __init__(self, bus):
        self.master, self.slave = pty.openpty()
        self.bus = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.wake, self.waker = os.pipe()
        self.lock = threading.Lock()
        self.reads = True  # False: stalled, nothing is taken from the line
        self.carries = True  # False: frames are taken from the line and go nowhere
        self.heard = 0  # frames that came from the line
        self.ends = False
        self.name = ""
        try:
            self.bus.bind((bus,))
            tty.setraw(self.slave)
            fcntl.ioctl(self.slave, termios.TIOCSETD, struct.pack("i", LINE_DISCIPLINE))
            self.name = fcntl.ioctl(self.slave, SIOCGIFNAME, bytes(16)).split(b"\0")[0].decode()
        except OSError:
            self.close_all()
            raise
        self.thread = threading.Thread(target=self.carry, daemon=True)
        self.thread.start()

    def switch_on(self, bit_rate=500000):
        self.ip("type", "can", "bitrate", str(bit_rate))
        self.ip("up")

    def ip(self, *arguments):
        done = subprocess.run(["ip", "link", "set", self.name, *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            raise OSError(f"ip link set {self.name} {' '.join(arguments)}: {done.stderr.strip()}")

    def carry(self):
        rest = b""
        while not self.ends:
            watched = [self.bus, self.wake] + ([self.master] if self.reads else [])
            try:
                ready = select.select(watched, [], [])[0]
                if self.wake in ready:
                    os.read(self.wake, 64)
                if self.bus in ready:
                    self.from_bus(self.bus.recv(CAN_FRAME.size))
                if self.master in ready and self.reads:
                    *lines, rest = (rest + os.read(self.master, 4096)).split(b"\r")
                    for line in lines:
                        self.from_line(line)
            except OSError:
                if self.ends:
                    return
                raise

    def from_bus(self, frame):
        number, length, data = CAN_FRAME.unpack(frame)
        if not self.carries or number & 0xE0000000:
            return
        self.write(f"t{number:03x}{length}{data[:length].hex()}\r".encode())

    def from_line(self, line):
        if line[:1] != b"t":
            return  # commands: open, close, bit rate
        self.heard += 1
        if self.carries:
            length = int(line[4:5])
            self.bus.send(CAN_FRAME.pack(int(line[1:4], 16), length, bytes.fromhex(line[5:5 + 2 * length].decode())))

    def write(self, text):
        with self.lock:
            os.write(self.master, text)

    def told(self, state, receive=0, transmit=0):
        """The controller tells its state: a(ctive), w(arning), p(assive), b(us-off), and its error counters."""
        self.write(f"s{state}{receive:03}{transmit:03}\r".encode())

    def stall(self, stalled):
        self.reads = not stalled
        os.write(self.waker, b"x")

    def unplug(self):
        """What the kernel notices when the cable is drawn: the line is hung up and the interface gone."""
        self.ends = True
        os.write(self.waker, b"x")
        self.thread.join(5)
        self.close_all()

    def close_all(self):
        for descriptor in (self.master, self.slave, self.wake, self.waker):
            os.close(descriptor)
        self.bus.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if not self.ends:
            self.unplug()
