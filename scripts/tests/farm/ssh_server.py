#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The exporter's host, as far as SSH shows it: runs commands for whoever has the key. A server of its own, because a real sshd is one of the
whole machine. Usage: ssh_server.py PORT HOST_KEY AUTHORIZED_KEYS"""
import asyncio
import sys

import asyncssh


async def pump(source, sink):
    while data := await source.read(65536):
        sink.write(data)
        await sink.drain()


async def feed(source, sink):
    try:
        await pump(source, sink)
    except (BrokenPipeError, ConnectionResetError):  # a command need not read all that it is told
        pass
    sink.close()


async def run(process):
    pipe = asyncio.subprocess.PIPE
    child = await asyncio.create_subprocess_shell(process.command, stdin=pipe, stdout=pipe, stderr=pipe)
    feeding = asyncio.create_task(feed(process.stdin, child.stdin))
    await asyncio.gather(pump(child.stdout, process.stdout), pump(child.stderr, process.stderr))
    code = await child.wait()
    feeding.cancel()
    process.exit(code if code >= 0 else 128 - code)


async def serve(port, host_key, authorized_keys):
    server = await asyncssh.listen("127.0.0.1", port, server_host_keys=[host_key], authorized_client_keys=authorized_keys,
                                   process_factory=run, encoding=None)
    print("ready", flush=True)
    await server.wait_closed()


if __name__ == "__main__":
    asyncio.run(serve(int(sys.argv[1]), *sys.argv[2:4]))
