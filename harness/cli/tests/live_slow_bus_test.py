#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A bus that carries little, and one that carries hardly anything: a token bucket filter on a real AF_CAN socket. Usage:
live_slow_bus_test.py BIN_FOLDER SUITES; the interface is $CONFORM_TEST_CAN, which must be ours to shape. $CONFORM_SLOW_BUS_WHOLE=1: all cases
of SDO, heartbeat and PDO on the slow bus."""
import collections
import os
import shutil
import subprocess
import unittest

from live_bus import Shaped
from live_device import FOLDER, INTERFACE, Node, command, folder_for, until_judged, verdicts

WHOLE = os.environ.get("CONFORM_SLOW_BUS_WHOLE") == "1"
CASES = ["cia301/sdo", "cia301/heartbeat", "cia301/pdo"] if WHOLE else [
    "cia301/sdo/segmented-upload*", "cia301/sdo/block-upload/*", "cia301/heartbeat/producer/period", "cia301/pdo/tpdo-wired*", "cia301/pdo/rpdo-content/*"]
# 1000 frames a second, as at 125 kbit/s: a frame counts 16 bytes here, whatever it carries. The queue is longer than what one socket sends.
SLOW = ("tbf", "rate", "128kbit", "burst", "32", "limit", "16000")
# Two frames a second.
CRAWLING = ("tbf", "rate", "256bit", "burst", "32", "limit")
MOST_FUTILE = 100  # a second
# Who spins takes a whole processor; beside busy neighbours each of the few writes takes longer.
MOST_BUSY = 0.15
# send(): how often it found no room, for how long that went on, and what the processor did meanwhile; a line at the end.
SHIM = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>
static long futile, no_buffer;
static int waiting;
static double since, busy_since, last, busy_last, seconds, busy;
static double read_clock(clockid_t id) {
  struct timespec now;
  clock_gettime(id, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
static void end_of_wait(double now, double busy_now) {
  if (!waiting) return;
  waiting = 0;
  seconds += now - since;
  busy += busy_now - busy_since;
}
ssize_t send(int fd, const void* data, size_t length, int flags) {
  static ssize_t (*real)(int, const void*, size_t, int);
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, "send");
  const ssize_t done = real(fd, data, length, flags);
  const int error = errno;
  const double now = read_clock(CLOCK_MONOTONIC), busy_now = read_clock(CLOCK_PROCESS_CPUTIME_ID);
  if (done < 0 && (error == EAGAIN || error == ENOBUFS)) {
    /* So long behind the last try it had given up, at that one. */
    if (now - last > 0.1) end_of_wait(last, busy_last);
    if (!waiting) waiting = 1, since = now, busy_since = busy_now;
    ++futile;
    no_buffer += error == ENOBUFS;
    last = now, busy_last = busy_now;
  } else {
    end_of_wait(now, busy_now);
  }
  errno = error;
  return done;
}
__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("COUNT_TO");
  if (!path) return;
  end_of_wait(last, busy_last);
  char text[200];
  const int length = snprintf(text, sizeof text, "%ld %ld %.6f %.6f\n", futile, no_buffer, seconds, busy);
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || write(file, text, (size_t)length) != length) _exit(99);
  close(file);
}
"""


class SlowBus(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.folder = folder_for(self)

    def path(self, name):
        return os.path.join(self.folder, name)

    def judge(self, *arguments, environment=None):
        done = until_judged(lambda: subprocess.run(command(*arguments, "--junit", self.path("junit.xml")), capture_output=True, text=True,
                                                   timeout=900, env=environment))
        return done, verdicts(self.path("junit.xml"))

    def test_a_bus_of_125_kbit_changes_no_verdict(self):
        with Node():
            done, fast = self.judge(*CASES)
            self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
            with Shaped(self, INTERFACE, *SLOW):
                done, slow = self.judge(*CASES)
        different = {case: (fast[case][0], *slow[case]) for case in fast if fast[case][0] != slow[case][0]}
        self.assertEqual(different, {})
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        judged = sum(word != "n/a" for word, _ in slow.values())
        print(f"\n  1000 frames a second: {judged} cases judged as on a fast bus, on {INTERFACE}, an AF_CAN socket", flush=True)

    def counted(self, what, limit, *, beside=()):
        """What a run does whose frames find no room."""
        compiler = shutil.which("cc") or shutil.which("gcc")
        if compiler is None:
            self.skipTest("no C compiler")
        with open(self.path("shim.c"), "w", encoding="ascii") as file:
            file.write(SHIM)
        subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", self.path("shim.so"), self.path("shim.c"), "-ldl"], check=True)
        environment = dict(os.environ, LD_PRELOAD=self.path("shim.so"), COUNT_TO=self.path("count"))
        with Shaped(self, INTERFACE, *CRAWLING, limit):
            load = subprocess.Popen(beside, stdout=subprocess.DEVNULL) if beside else None
            try:
                done, found = self.judge("cia301/sdo/upload*", "--wait-for-bus", "3 s", environment=environment)
            finally:
                if load:
                    load.terminate()
                    load.wait()
        if not os.path.exists(self.path("count")):
            self.skipTest("calls cannot be counted here (a static program, or one with a sanitizer)")
        with open(self.path("count"), encoding="ascii") as file:
            futile, no_buffer, seconds, busy = map(float, file.read().split())
        print(f"\n  {what}: {futile:.0f} futile writes ({no_buffer:.0f} ENOBUFS) in {seconds:.2f} s of waiting, {busy / max(seconds, 1e-9):.1%} "
              f"of a processor, on {INTERFACE}, an AF_CAN socket", flush=True)
        counts = collections.Counter(word for word, _ in found.values())
        self.assertEqual(counts["fail"], 0, done.stdout[-3000:])
        self.assertEqual(done.returncode, 3, done.stdout[-3000:] + done.stderr)
        self.assertGreater(futile, 0, done.stdout[-3000:])
        self.assertLess(futile, MOST_FUTILE * seconds)
        self.assertLessEqual(busy, MOST_BUSY * seconds)
        return done

    def test_a_queue_that_others_keep_full_is_not_spun_at(self):
        with Node():
            self.counted("a queue that others fill", "160", beside=[os.path.join(FOLDER, "bus_load"), INTERFACE, "100000", "600"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
