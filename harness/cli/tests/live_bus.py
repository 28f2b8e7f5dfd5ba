# SPDX-License-Identifier: Apache-2.0
"""What the tests need that do something to the bus, the link or the clock of the machine: rights, kernel modules, `tc`."""
import ctypes
import os
import re
import shutil
import socket
import struct
import subprocess

FRAME = struct.Struct("=IB3x8s")  # CAN-ID, length, data
SO_TIMESTAMPNS = 35
SO_RCVBUFFORCE = 33
FINIT_MODULE = 313  # x86-64, the only machine with user-mode-linux


def load_module(path):
    """Whether the module, e.g. net/sched/sch_tbf, is in the kernel now or may come with its first use."""
    name = os.path.basename(path)
    with open("/proc/modules", encoding="ascii") as file:
        if any(line.split()[0] == name for line in file):
            return True
    # The guest of scripts/with-vcan has no modprobe.
    file = f"/usr/lib/uml/modules/{os.uname().release}/kernel/{path}.ko"
    if not os.path.exists(file):
        return subprocess.run(["modprobe", "-q", name], capture_output=True).returncode == 0 if shutil.which("modprobe") else False
    descriptor = os.open(file, os.O_RDONLY)
    try:
        return ctypes.CDLL(None, use_errno=True).syscall(FINIT_MODULE, descriptor, b"", 0) == 0
    finally:
        os.close(descriptor)


def in_guest():
    """A machine that is ours alone: the kernel that is an ordinary process."""
    with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
        return "User Mode Linux" in file.read()


def tc(*arguments):
    return subprocess.run(["tc", *arguments], capture_output=True, text=True)


class Shaped:
    """The interface behind a queueing discipline, e.g. Shaped("vcan0", "tbf", "rate", "128kbit", ...); skips `test` where that cannot be."""

    def __init__(self, test, interface, *discipline):
        self.test, self.interface, self.discipline = test, interface, discipline

    def __enter__(self):
        if shutil.which("tc") is None:
            self.test.skipTest("tc (iproute2) is not installed")
        load_module("net/sched/sch_" + self.discipline[0])
        done = tc("qdisc", "add", "dev", self.interface, "root", "handle", "1:", *self.discipline)
        if done.returncode != 0:
            self.test.skipTest(f"no {self.discipline[0]} on {self.interface}: {done.stderr.strip()}")
        return self

    def __exit__(self, *_):
        tc("qdisc", "del", "dev", self.interface, "root")


class Selected:
    """Frames of the CAN-IDs `number`/`mask` pass netem, e.g. Selected(test, "vcan0", 0x600, 0x780, "loss", "1%"); the others do not."""

    def __init__(self, test, interface, number, mask, *fault):
        self.test, self.interface, self.number, self.mask, self.fault = test, interface, number, mask, fault

    def __enter__(self):
        if shutil.which("tc") is None:
            self.test.skipTest("tc (iproute2) is not installed")
        for module in ("sch_prio", "sch_netem", "cls_basic", "em_canid"):
            load_module("net/sched/" + module)
        for arguments in (["qdisc", "add", "dev", self.interface, "root", "handle", "1:", "prio", "bands", "2", "priomap", *["0"] * 16],
                          ["qdisc", "add", "dev", self.interface, "parent", "1:2", "handle", "2:", "netem", "limit", "100000", *self.fault],
                          ["filter", "add", "dev", self.interface, "parent", "1:", "prio", "1", "basic", "match",
                           f"canid(sff {self.number:#x}:{self.mask:#x})", "flowid", "1:2"]):
            done = tc(*arguments)
            if done.returncode != 0:
                self.__exit__()
                self.test.skipTest(f"frames cannot be selected on {self.interface}: {done.stderr.strip()}")
        return self

    def passed(self):
        """How many frames netem has let through so far."""
        return int(re.search(r"qdisc netem 2:.*\n Sent \d+ bytes (\d+) pkt", tc("-s", "qdisc", "show", "dev", self.interface).stdout)[1])

    def __exit__(self, *_):
        tc("qdisc", "del", "dev", self.interface, "root")


class Witness:
    """Hears every frame of the interface beside the harness, with the kernel's stamp."""

    def __init__(self, interface):
        self.socket = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, 64 << 20)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.socket.bind((interface,))
        self.socket.setblocking(False)

    def close(self):
        self.socket.close()

    def frames(self):
        """(nanoseconds, CAN-ID, data) of all that came."""
        out = []
        while True:
            try:
                data, ancillary, _, _ = self.socket.recvmsg(16, 64)
            except BlockingIOError:
                return out
            seconds, nanoseconds = struct.unpack("=qq", ancillary[0][2][:16])
            can_id, length, payload = FRAME.unpack(data)
            out.append((seconds * 10**9 + nanoseconds, can_id & 0x1FFFFFFF, payload[:length]))
