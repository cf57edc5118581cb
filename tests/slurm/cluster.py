"""A Slurm cluster of this machine, with munge, in a folder of its own: real daemons on loopback.

It has no accounting database, no cgroups, and touches no service of the system.
"""

from __future__ import annotations

import getpass
import os
import secrets
import shutil
import socket
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

# Debian keeps the daemons where users' PATH does not lead.
DAEMON_PATH = os.pathsep.join([os.environ["PATH"], "/usr/sbin", "/sbin"])

CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/affinity
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SwitchType=switch/none
MpiDefault=none
MinJobAge=3600
KillWait=2
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory_mb}
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class Cluster:
    """A cluster that runs between ``start`` and ``stop``.

    Args:
        folder: where keys, sockets, states and logs go; short, since a socket's path is.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.daemons: list[subprocess.Popen] = []
        self.environment = {
            "SLURM_CONF": str(folder / "slurm.conf"),
            "PATH": os.pathsep.join([str(folder / "bin"), os.environ["PATH"]]),
        }

    def start(self, patience_s: float = 20.0) -> None:
        """Start the daemons and wait until the node takes jobs."""
        for name in ("munged", "slurmctld", "slurmd"):
            if shutil.which(name, path=DAEMON_PATH) is None:
                raise RuntimeError(f"missing: {name}; get it with: apt-get install slurm-wlm munge")
        self.folder.chmod(0o755)  # munged's clients must get at its socket
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o400)
        (self.folder / "slurm.conf").write_text(self._configuration())
        self._wrap_srun()
        places = {"socket": "socket", "pid-file": "pid", "seed-file": "seed", "log-file": "log"}
        options = [f"--{option}={self.folder}/munge.{end}" for option, end in places.items()]
        self._launch("munged", "--foreground", f"--key-file={key}", *options)
        self._wait_for((self.folder / "munge.socket").exists, patience_s, "munged")
        self._launch("slurmctld", "-D")
        self._launch("slurmd", "-D")
        self._wait_for(lambda: "idle" in self.ask("sinfo", "-h", "-o", "%T"), patience_s, "slurmd")

    def _wait_for(self, condition: Callable[[], bool], patience_s: float, what: str) -> None:
        deadline = time.monotonic() + patience_s
        while not condition():
            if time.monotonic() > deadline:
                said = "".join(path.read_text() for path in sorted(self.folder.glob("*.out")))
                raise TimeoutError(f"{what} did not start within {patience_s:g} s:\n{said}")
            time.sleep(0.1)

    def _configuration(self) -> str:
        memory_mb = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20
        return CONFIGURATION.format(
            host=socket.gethostname().split(".")[0],
            user=getpass.getuser(),
            folder=self.folder,
            ports=_free_ports(2),
            cpus=os.cpu_count(),
            memory_mb=int(0.9 * memory_mb),
        )

    def _wrap_srun(self) -> None:
        """Tell `srun` where the configuration is: the plugin drops SLURM_CONF before it."""
        wrapper = self.folder / "bin" / "srun"
        wrapper.parent.mkdir()
        srun = shutil.which("srun")
        wrapper.write_text(f'#!/bin/sh\nSLURM_CONF={self.folder}/slurm.conf exec {srun} "$@"\n')
        wrapper.chmod(0o755)

    def _launch(self, *command: str) -> None:
        with open(self.folder / f"{command[0]}.out", "w") as output:
            daemon = subprocess.Popen(
                command,
                env={**os.environ, **self.environment, "PATH": DAEMON_PATH},
                stdout=output,
                stderr=subprocess.STDOUT,
            )
        self.daemons.append(daemon)

    def ask(self, *command: str) -> str:
        """What a command of Slurm prints; nothing if it fails."""
        result = subprocess.run(
            command,
            env={**os.environ, **self.environment},
            capture_output=True,
            text=True,
            check=False,
        )
        return result.stdout

    def jobs(self, state: str) -> dict[str, str]:
        """Numbers and comments of all jobs in a state, finished ones included."""
        lines = self.ask("squeue", "--states", state, "-h", "-o", "%A|%k").splitlines()
        return dict(line.split("|", 1) for line in lines)

    def stop(self) -> None:
        """Cancel all jobs and end the daemons, last started first."""
        if not self.daemons:
            return
        self.ask("scancel", "--user", getpass.getuser())
        deadline = time.monotonic() + 10
        while self.ask("squeue", "-h") and time.monotonic() < deadline:
            time.sleep(0.2)
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


def _free_ports(number: int) -> list[int]:
    sockets = [socket.socket() for _ in range(number)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports
