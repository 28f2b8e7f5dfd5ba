#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What reports cost on a real AF_CAN socket: a run with all of them against one without, in one boot. Usage:
live_cost_test.py BIN_FOLDER SUITES [ID...]; the interface is $CONFORM_TEST_CAN."""
import os
import subprocess
import sys
import tempfile
import time

SELECT = sys.argv[3:]
del sys.argv[3:]
from live_device import SUITES, Node, command  # noqa: E402  (it takes its arguments from sys.argv)

MOST = 1.05


def seconds(folder, *arguments):
    environment = dict(os.environ, XDG_STATE_HOME=os.path.join(folder, "state"))
    with Node():
        begin = time.monotonic()
        done = subprocess.run(command("--quiet", "--device", os.path.join(SUITES, "devices/reference-node.yaml"), *arguments, *SELECT),
                              capture_output=True, text=True, env=environment)
        spent = time.monotonic() - begin
    # 3: the machine was late for some case, which says nothing about the time that the reports take.
    if done.returncode not in (0, 3):
        sys.exit(done.stdout[-3000:] + done.stderr)
    return spent


def main():
    with tempfile.TemporaryDirectory() as folder:
        reports = [f"--{name}={folder}/{name}" for name in ("junit", "markdown", "json", "html", "capture", "candump")]
        pairs = [(seconds(folder), seconds(folder, *reports)) for _ in range(2)]
    without, with_all = min(pair[0] for pair in pairs), min(pair[1] for pair in pairs)
    print(f"without reports {without:.1f} s, with all {with_all:.1f} s: {with_all / without:.3f} times", flush=True)
    return 0 if with_all / without <= MOST else 1


if __name__ == "__main__":
    sys.exit(main())
