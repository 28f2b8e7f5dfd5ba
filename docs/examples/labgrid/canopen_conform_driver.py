# SPDX-License-Identifier: Apache-2.0
"""canopen-conform as a driver of labgrid: it runs on the host that has the CAN interface, and its reports come back."""
import os
import shlex
import subprocess
from getpass import getuser
from socket import gethostname

import attr
from labgrid import step, target_factory
from labgrid.driver import Driver
from labgrid.driver.exception import ExecutionError


@target_factory.reg_driver
@attr.s(eq=False)
class CANopenConformDriver(Driver):
    """Runs canopen-conform beside a CAN interface.

    Args:
        profile (str): device profile, relative to the environment file
        files (list): what the profile names (EDS, waivers), relative to the folder of the profile
        program (str): canopen-conform on the host of the interface
    """

    bindings = {"interface": {"RemoteNetworkInterface", "USBNetworkInterface"}}
    profile = attr.ib(validator=attr.validators.instance_of(str))
    files = attr.ib(factory=list, validator=attr.validators.instance_of(list))
    program = attr.ib(default="canopen-conform", validator=attr.validators.instance_of(str))

    @Driver.check_active
    @step(args=["arguments"], result=True)
    def run(self, arguments, reports):
        """Runs the suite. Whatever it ends with, junit.xml, report.html, result.json and run.pcapng come into the folder `reports`.

        Args:
            arguments (list): of `canopen-conform run`, beside the interface and the profile
            reports (str): a folder; it is made where it is missing

        Returns:
            int: the exit code, 0 where the device conforms, 1 where a requirement failed, 3 where the bench is at fault

        Raises:
            ExecutionError: the host was not reached, or the connection broke
        """
        folder = self._output("mktemp -d /tmp/canopen-conform.XXXXXXXX").decode().strip()
        try:
            self._send(folder)
            command = ["env", *self._identity(), self.program, "run", "--interface", self.interface.ifname,
                       "--device", f"{folder}/{os.path.basename(self.profile)}", *arguments]
            for option, name in (("--junit", "junit.xml"), ("--html", "report.html"), ("--json", "result.json"), ("--capture", "run.pcapng")):
                command += [option, f"{folder}/reports/{name}"]
            code = self._on_host(f"mkdir {folder}/reports && {shlex.join(command)}").returncode
            os.makedirs(reports, exist_ok=True)
            packed = self._output(f"tar -c -C {folder}/reports .")
            subprocess.run(["tar", "-x", "-C", reports], input=packed, check=True)
            return code
        finally:
            self._on_host(f"rm -rf {folder}")

    def _send(self, folder):
        profile = self.target.env.config.resolve_path(self.profile)
        packed = subprocess.run(["tar", "-c", "-C", os.path.dirname(profile), "--", os.path.basename(profile), *self.files],
                                stdout=subprocess.PIPE, check=True).stdout
        self._on_host(f"tar -x -C {folder}", input=packed)

    def _identity(self):
        """Who has the place, for the labgrid-client in `power_cycle`: without it that would be somebody else on another host."""
        told = {name: value for name, value in os.environ.items()
                if name in ("LG_COORDINATOR", "LG_CROSSBAR", "LG_CROSSBAR_REALM", "LG_PLACE", "LG_TOKEN")}
        told["LG_HOSTNAME"] = os.environ.get("LG_HOSTNAME", gethostname())
        told["LG_USERNAME"] = os.environ.get("LG_USERNAME", getuser())
        return [f"{name}={value}" for name, value in told.items()]

    def _on_host(self, line, **options):
        # A local interface has no prefix; behind SSH's the shell of the other side takes the line.
        prefix = self.interface.command_prefix
        done = subprocess.run([*prefix, line] if prefix else ["sh", "-c", line], check=False, **options)
        if prefix and done.returncode == 255:
            raise ExecutionError(f"no connection to {self.interface.host}, or it broke: {line}")
        return done

    def _output(self, line):
        done = self._on_host(line, stdout=subprocess.PIPE)
        if done.returncode != 0:
            raise ExecutionError(f"exit code {done.returncode}: {line}")
        return done.stdout
