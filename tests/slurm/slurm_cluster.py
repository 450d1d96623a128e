"""A Slurm of one node that lives in a folder of its own and runs as the user who started it."""

import contextlib
import os
import pwd
import secrets
import shutil
import socket
import string
import subprocess
import tempfile
from pathlib import Path

import psutil

from conftest import wait_for

PATIENCE = 60.0
"""Seconds in which a daemon must be down."""
USER = pwd.getpwuid(os.getuid()).pw_name


def free_ports(count: int) -> list[int]:
    """Ports that nothing on this machine listens to."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]


class Cluster:
    """The daemons, and the commands of Slurm that speak to them; a context."""

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="slurm-"))
        self.environment = {
            **os.environ,
            "PATH": f"{self.folder}/bin:{os.environ['PATH']}:/usr/sbin:/sbin",
            "SLURM_CONF": str(self.folder / "slurm.conf"),
        }
        self.daemons: list[subprocess.Popen] = []

    def __enter__(self) -> "Cluster":
        try:
            self._write_files()
            socket_path = self.folder / "munge.socket"
            self._start_daemon("munged", "--foreground", *self._munge_files(socket_path))
            wait_for(socket_path.exists)
            self._start_daemon("slurmctld", "-D")
            self._start_daemon("slurmd", "-D")
            wait_for(lambda: self.command("sinfo", "-h", "-o", "%T") == "idle\n")
        except BaseException as error:
            error.add_note(self._last_words())
            self.__exit__()
            raise
        return self

    def __exit__(self, *_) -> None:
        """End all jobs, then the daemons, the one started last first."""
        try:
            self.command("scancel", "--user", USER)
            wait_for(lambda: self.command("squeue", "-h") == "")
        finally:
            for daemon in reversed(self.daemons):
                daemon.terminate()
                try:
                    daemon.wait(PATIENCE)
                except subprocess.TimeoutExpired:
                    daemon.kill()
                    daemon.wait()
            shutil.rmtree(self.folder)

    def command(self, *words: str) -> str:
        """What a command of Slurm says; empty where it fails."""
        run = subprocess.run(words, env=self.environment, capture_output=True, text=True)
        return run.stdout

    def _munge_files(self, socket_path: Path) -> list[str]:
        names = {"key": "munge.key", "pid": "munge.pid", "log": "munge.log", "seed": "munge.seed"}
        files = [f"--{kind}-file={self.folder / name}" for kind, name in names.items()]
        return [*files, f"--socket={socket_path}"]

    def _start_daemon(self, *words: str) -> None:
        # ends with the tests even if these are killed; a Ctrl-C is theirs alone
        self.daemons.append(
            subprocess.Popen(
                ["setpriv", "--pdeathsig", "TERM", *words],
                env=self.environment,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
        )

    def _write_files(self) -> None:
        self.folder.chmod(0o755)
        key = self.folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(secrets.token_bytes(1024))
        for name in ("bin", "state", "spool"):
            (self.folder / name).mkdir()
        # the plugin takes SLURM_CONF away from the srun of its jobs
        srun = self.folder / "bin" / "srun"
        srun.write_text(f'#!/bin/sh\nSLURM_CONF={self.folder}/slurm.conf exec /usr/bin/srun "$@"\n')
        srun.chmod(0o755)
        controller_port, node_port = free_ports(2)
        template = string.Template((Path(__file__).parent / "slurm.conf.in").read_text())
        values = {
            "node": socket.gethostname().split(".")[0],
            "folder": self.folder,
            "controller_port": controller_port,
            "node_port": node_port,
            "user": USER,
            "memory": psutil.virtual_memory().total // 2**20 * 9 // 10,
        }
        (self.folder / "slurm.conf").write_text(template.substitute(values))

    def _last_words(self) -> str:
        logs = sorted(self.folder.glob("*.log"))
        return "\n".join(f"{log.name}:\n{log.read_text()[-2000:]}" for log in logs)
