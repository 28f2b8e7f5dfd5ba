#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The n-th system call fails, and the n-th allocation: no crash, no hang, no verdict from it, and no report that is half. Usage:
failing_calls_test.py PROGRAM; in simulation only. $CONFORM_FAULT_EVERY: each so manieth call of a kind (151)."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM = os.path.abspath(sys.argv.pop(1))
EVERY = int(os.environ.get("CONFORM_FAULT_EVERY", "151"))
CASES = ["cia301/dictionary/1000-device-type", "cia301/dictionary/1001-error-register"]
FILES = ["r.html", "j.xml", "r.json", "c.pcapng", "c.log", "s.md"]
# What the kernel says of each when a disk is full, a file system broken, too much open.
FAULTS = {"write": "ENOSPC", "openat": "EMFILE", "read": "EIO", "close": "EIO", "fsync": "EIO", "rename": "EACCES"}
OLD = "the report of an earlier run"
# malloc, calloc, realloc and new: one call, number $FAIL_AT, finds no memory; how many there were goes to $COUNT_TO. All of the C library,
# whatever allocator the program has.
SHIM = r"""
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <new>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void __libc_free(void*);
}
static long calls, at = -1;
static bool fails() {
  if (at < 0) {
    const char* text = getenv("FAIL_AT");
    at = text ? atol(text) : 0;
  }
  /* One alone: what the program allocates to tell of it is there. */
  if (__atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED) != at) return false;
  errno = ENOMEM;
  return true;
}
extern "C" {
void* malloc(size_t size) noexcept { return fails() ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) noexcept { return fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) noexcept { return fails() ? nullptr : __libc_realloc(old, size); }
void free(void* old) noexcept { __libc_free(old); }
void* aligned_alloc(size_t to, size_t size) noexcept { return fails() ? nullptr : __libc_memalign(to, size); }
int posix_memalign(void** out, size_t to, size_t size) noexcept {
  *out = fails() ? nullptr : __libc_memalign(to, size);
  return *out ? 0 : ENOMEM;
}
}
static void* made(size_t size) {
  void* const out = malloc(size);
  if (!out) throw std::bad_alloc();
  return out;
}
void* operator new(size_t size) { return made(size); }
void* operator new[](size_t size) { return made(size); }
void* operator new(size_t size, const std::nothrow_t&) noexcept { return malloc(size); }
void* operator new[](size_t size, const std::nothrow_t&) noexcept { return malloc(size); }
void* operator new(size_t size, std::align_val_t to) {
  void* const out = fails() ? nullptr : __libc_memalign(static_cast<size_t>(to), size);
  if (!out) throw std::bad_alloc();
  return out;
}
void operator delete(void* old) noexcept { __libc_free(old); }
void operator delete[](void* old) noexcept { __libc_free(old); }
void operator delete(void* old, size_t) noexcept { __libc_free(old); }
void operator delete[](void* old, size_t) noexcept { __libc_free(old); }
void operator delete(void* old, const std::nothrow_t&) noexcept { __libc_free(old); }
void operator delete[](void* old, const std::nothrow_t&) noexcept { __libc_free(old); }
void operator delete(void* old, std::align_val_t) noexcept { __libc_free(old); }
void operator delete(void* old, size_t, std::align_val_t) noexcept { __libc_free(old); }
__attribute__((destructor)) static void tell() {
  const char* path = getenv("COUNT_TO");
  if (!path) return;
  char text[32];
  const int length = snprintf(text, sizeof text, "%ld\n", calls);
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || write(file, text, (size_t)length) != length) _exit(99);
  close(file);
}
"""
# The end of a pipe that is written to stays open: its reader never comes to the end.
STUCK_PIPE = r"""
#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

extern "C" int close(int file) {
  struct stat about;
  if (file > 2 && fstat(file, &about) == 0 && S_ISFIFO(about.st_mode) && (fcntl(file, F_GETFL) & O_ACCMODE) == O_WRONLY) {
    errno = EIO;
    return -1;
  }
  return (int)syscall(SYS_close, file);
}
"""


class FailingCalls(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="conform-faults-")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def command(self):
        return [PROGRAM, "run", "--simulate", "-q", *CASES, "--html", self.path("r.html"), "--junit", self.path("j.xml"), "--json", self.path("r.json"),
                "--capture", self.path("c.pcapng"), "--candump", self.path("c.log"), "--markdown", self.path("s.md")]

    def run_with(self, before=(), **variables):
        for name in FILES:
            with open(self.path(name), "w", encoding="ascii") as file:
                file.write(OLD)
        environment = dict(os.environ, XDG_STATE_HOME=self.path("state"), LC_ALL="C", **variables)
        return subprocess.run([*before, *self.command()], capture_output=True, text=True, errors="replace", timeout=120, env=environment)

    def state_of(self, name):
        """'old', 'new' (and complete), or what is wrong with the file."""
        try:
            with open(self.path(name), encoding="utf-8", errors="replace") as file:
                text = file.read()
        except FileNotFoundError:
            return "gone"
        if text == OLD:
            return "old"
        if name == "j.xml":
            root = ElementTree.fromstring(text)
            # A run that did not come to its end says so, in one case with an error.
            if root.find(".//property[@name='run.aborted']") is not None and int(root.get("errors")) > 0:
                return "aborted"
            return "new" if len(list(root.iter("testcase"))) == self.cases else "half"
        if name == "r.json":
            result = json.loads(text)
            if result["run"].get("aborted") and result["summary"]["exit_code"] != 0:
                return "aborted"
            return "new" if len(result["cases"]) == self.cases else "half"
        if name == "r.html":
            return "new" if text.rstrip().endswith("</html>") else "half"
        if name == "s.md":
            return "new" if text else "empty"
        return "stream"

    def measure(self):
        clean = self.run_with()
        self.assertEqual(clean.returncode, 0, clean.stderr)
        with open(self.path("r.json"), encoding="utf-8") as file:
            self.cases = len(json.load(file)["cases"])
        self.sizes = {name: os.path.getsize(self.path(name)) for name in ("c.pcapng", "c.log")}

    def gave_up(self, done):
        """Libraries (CLI11, the directory iterator of libstdc++) end the program where an allocation of theirs fails in a function that
        may not throw. They are in use before the run begins: nothing may have been sent by then."""
        if done.returncode != -6 or "terminate called" not in done.stderr:
            return False
        with open(self.path("c.log"), encoding="utf-8", errors="replace") as file:
            return file.read() in (OLD, "")

    def judge(self, done, what):
        if self.gave_up(done):
            return
        self.assertGreaterEqual(done.returncode, 0, f"{what}: died of signal {-done.returncode}: {done.stderr[-300:]}")
        self.assertLess(done.returncode, 126, f"{what}: exit {done.returncode}: {done.stderr[-300:]}")
        # 1 is the verdict that the device does not conform.
        self.assertNotEqual(done.returncode, 1, f"{what}: a fault of the machine became a verdict: {done.stdout[-300:]}")
        for name in FILES:
            state = self.state_of(name)
            self.assertIn(state, ("old", "new", "aborted", "stream"), f"{what}: {name} is {state}, exit {done.returncode}")
            if done.returncode == 0:
                self.assertIn(state, ("new", "stream"), f"{what}: exit 0, and {name} is {state}")
                if name in self.sizes:
                    self.assertEqual(os.path.getsize(self.path(name)), self.sizes[name], f"{what}: exit 0, and {name} is not whole")

    def test_each_system_call_may_fail(self):
        strace = shutil.which("strace")
        if strace is None:
            self.skipTest("strace is not installed")
        probe = subprocess.run([strace, "-o", os.devnull, "true"], capture_output=True, text=True)
        if probe.returncode != 0:
            self.skipTest("strace may not trace here: " + probe.stderr.strip().splitlines()[-1])
        self.measure()
        trace = self.path("trace")
        done = self.run_with([strace, "-f", "-o", trace, "-e", "trace=" + ",".join(FAULTS)])
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(trace, encoding="utf-8", errors="replace") as file:
            calls = re.findall(r"^\d+\s+(\w+)\(", file.read(), re.MULTILINE)
        played, told = 0, 0
        for call, error in FAULTS.items():
            count = calls.count(call)
            self.assertGreater(count, 0, call)
            every = EVERY if count >= 4 * EVERY else max(1, min(EVERY, count // 4))
            for n in range(1, count + 1, every):
                what = f"{call} {n} of {count}: {error}"
                with self.subTest(what):
                    done = self.run_with([strace, "-f", "-o", os.devnull, "-e", f"trace={call}", "-e", f"inject={call}:error={error}:when={n}"])
                    played += 1
                    # The dynamic linker's own calls: the program has not begun.
                    if done.returncode == 127 and "error while loading shared libraries" in done.stderr:
                        continue
                    told += done.returncode != 0
                    self.judge(done, what)
        print(f"{played} system calls failed, one at a time; {told} of the runs ended with an error of their own")

    def library_of(self, source):
        """For LD_PRELOAD."""
        compiler = shutil.which("c++") or shutil.which("g++")
        if compiler is None:
            self.skipTest("no C++ compiler")
        with open(self.path("shim.cpp"), "w", encoding="ascii") as file:
            file.write(source)
        subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", self.path("shim.so"), self.path("shim.cpp")], check=True)
        return self.path("shim.so")

    def test_a_pipe_that_does_not_close_keeps_nobody_waiting(self):
        stuck = self.library_of(STUCK_PIPE)
        self.measure()
        done = self.run_with(LD_PRELOAD=stuck)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_each_allocation_may_fail(self):
        shim = self.library_of(SHIM)
        self.measure()
        done = self.run_with(LD_PRELOAD=shim, COUNT_TO=self.path("count"))
        if not os.path.exists(self.path("count")):
            self.skipTest("allocations cannot be counted here (a static program, or one with a sanitizer)")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("count"), encoding="ascii") as file:
            count = int(file.read())
        played = told = 0
        for n in range(1, count + 1, max(1, EVERY * count // 4000)):
            what = f"allocation {n} of {count}"
            with self.subTest(what):
                done = self.run_with(LD_PRELOAD=shim, FAIL_AT=str(n))
                played += 1
                if "error while loading shared libraries" in done.stderr:
                    continue
                told += done.returncode != 0
                self.judge(done, what)
        print(f"{played} of {count} allocations failed, one at a time; {told} of the runs ended with an error of their own")


if __name__ == "__main__":
    unittest.main(verbosity=2)
