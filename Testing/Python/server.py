# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""A pvserver for one test: started on a free port, gone at the end whatever happens."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time

STARTS_WITHIN = 60  # seconds
LIVES_FOR = 400  # seconds: "timeout" ends it then, should this process be gone
READY = re.compile(r"Accepting connection\(s\): .*:(\d+)")


def environment():
    """For mpiexec: pvpython has told this process that it is one of MPI's already."""
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("OMPI_", "PMIX_"))}
    environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return environment


class Server:
    """with Server(processes=2) as server: simple.Connect("localhost", server.port)"""

    def __init__(self, processes=1):
        self.processes = processes
        self.port = None
        self._log = None
        self._process = None

    def __enter__(self):
        command = ["timeout", "-k", "5", str(LIVES_FOR)]
        if self.processes > 1:
            command += [shutil.which("mpiexec"), "--oversubscribe", "-n", str(self.processes)]
        command += [shutil.which("pvserver"), "--server-port=0"]  # one that is free
        self._log = tempfile.NamedTemporaryFile(suffix=".log")
        # A group of its own, which can be ended with all that it has started.
        self._process = subprocess.Popen(command, stdout=self._log, stderr=subprocess.STDOUT,
                                         env=environment(), start_new_session=True)
        end = time.monotonic() + STARTS_WITHIN
        while not READY.search(self.output()):
            if time.monotonic() > end or self._process.poll() is not None:
                output = self.output()
                self._end()
                raise RuntimeError("pvserver did not start: " + output)
            time.sleep(0.05)
        self.port = int(READY.search(self.output()).group(1))
        return self

    def __exit__(self, *_):
        self._end()

    def output(self):
        """What it has printed so far."""
        with open(self._log.name, encoding="utf-8", errors="replace") as log:
            return log.read()

    def wait(self, seconds):
        """The exit code, once it has ended by itself; None if it has not within this time."""
        try:
            return self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None

    def _end(self):
        if self._process.poll() is None:
            os.killpg(self._process.pid, signal.SIGTERM)
            if self.wait(10) is None:
                os.killpg(self._process.pid, signal.SIGKILL)
                self._process.wait()
        self._log.close()
