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
        """Runs the suite. Whatever it ends with, junit.xml, report.html, result.json and run.pcapng come into the folder `reports`. When it is
        interrupted, it returns to its caller after the run has put back what it changed.

        Args:
            arguments (list): of `canopen-conform run`, beside the interface and the profile
            reports (str): a folder; it is made where it is missing

        Returns:
            int: the exit code, 0 where the device conforms, 1 where a requirement failed, 3 where the bench is at fault

        Raises:
            ExecutionError: the host was not reached, or the connection broke
        """
        # A local interface has no prefix. Taken once: after Ctrl-C labgrid holds the connection for lost, although it is not.
        self._prefix = self.interface.command_prefix
        folder = self._output("mktemp -d /tmp/canopen-conform.XXXXXXXX").decode().strip()
        try:
            self._send(folder)
            command = ["env", *self._identity(), self.program, "run", "--interface", self.interface.ifname,
                       "--device", f"{folder}/{os.path.basename(self.profile)}", *arguments]
            for option, name in (("--junit", "junit.xml"), ("--html", "report.html"), ("--json", "result.json"), ("--capture", "run.pcapng")):
                command += [option, f"{folder}/reports/{name}"]
            self._on_host(f"mkdir {folder}/reports")
            try:
                return self._run_with_us(shlex.join(command))
            finally:
                os.makedirs(reports, exist_ok=True)
                subprocess.run(["tar", "-x", "-C", reports], input=self._output(f"tar -c -C {folder}/reports ."), check=True)
        finally:
            self._on_host(f"rm -rf {folder}")

    def _run_with_us(self, command):
        """Neither SSH nor a shell ends a program whose client is gone, and the place would be given back before the run is over. So the other
        side ends it when its standard input does, however that came."""
        line = (f"exec 3<&0; {command} & run=$!; {{ cat <&3 >/dev/null; kill -TERM $run; }} 2>/dev/null >/dev/null & watch=$!; "
                "wait $run; code=$?; kill $watch 2>/dev/null; exit $code")
        # Ctrl-C is for us and not for SSH.
        process = subprocess.Popen(self._line(line), stdin=subprocess.PIPE, start_new_session=True)
        try:
            return self._connected(process.wait(), command)
        finally:
            process.stdin.close()
            process.wait()

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

    def _line(self, line):
        return [*self._prefix, line] if self._prefix else ["sh", "-c", line]  # behind SSH the shell of the other side takes it

    def _connected(self, code, line):
        if self._prefix and code == 255:
            raise ExecutionError(f"no connection to {self.interface.host}, or it broke: {line}")
        return code

    def _on_host(self, line, **options):
        done = subprocess.run(self._line(line), check=False, **options)
        self._connected(done.returncode, line)
        return done

    def _output(self, line):
        done = self._on_host(line, stdout=subprocess.PIPE)
        if done.returncode != 0:
            raise ExecutionError(f"exit code {done.returncode}: {line}")
        return done.stdout
