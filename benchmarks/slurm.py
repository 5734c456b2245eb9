"""A cluster of one node on this machine: Debian's munge and Slurm, in a folder of their own.

The node has a name and process numbers of its own, so that for a job the machine that it was
submitted from is another one; what they share is the files.
"""

import contextlib
import os
import secrets
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

from branchcrush.lammps.processes import end_with_parent

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "unshare")
# More cores than the machine has: jobs of this size are hardly at work at once.
NODE, CORES, MEMORY = "node1", 4, 32000
SETTINGS = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser=root
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
# Neither systemd nor cgroups nor a database.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
# Begin jobs when they are submitted, and end those that are cancelled soon.
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
KillWait=3
ReturnToService=2
SlurmdParameters=config_overrides
NodeName={node} NodeAddr=127.0.0.1 CPUs={cores} RealMemory={memory}
PartitionName=all Nodes=ALL Default=YES State=UP
"""


class Cluster:
    """Munge, the controller and the node, while they run."""

    def __init__(self, folder):
        missing = [name for name in PROGRAMS if shutil.which(name, path=_PATH) is None]
        if missing:
            raise RuntimeError(
                f"no {', '.join(missing)} here; on Debian: apt-get install slurm-wlm munge"
            )
        if os.geteuid() != 0:
            raise RuntimeError("a node with process numbers of its own needs root")
        self.folder = Path(folder)
        self.environment = {**os.environ, "PATH": _PATH, "SLURM_CONF": f"{folder}/etc/slurm.conf"}
        self._daemons = []

    def start(self):
        """Begin all three, and wait until the node takes jobs."""
        folder = self.folder
        for name in ("etc", "state", "spool"):
            (folder / name).mkdir()
        (folder / "munge.key").write_bytes(secrets.token_bytes(128))
        (folder / "munge.key").chmod(0o600)
        controller_port, node_port = _free_ports(2)
        (folder / "etc" / "slurm.conf").write_text(
            SETTINGS.format(
                host=socket.gethostname().split(".")[0],
                controller_port=controller_port,
                node_port=node_port,
                folder=folder,
                node=NODE,
                cores=CORES,
                memory=MEMORY,
            )
        )
        files = [f"--{name}-file={folder}/munge.{name}" for name in ("key", "pid", "seed", "log")]
        self._begin("munged", "--foreground", "--force", f"--socket={folder}/munge.socket", *files)
        self._wait_for(lambda: (folder / "munge.socket").exists(), "munged")
        self._begin("slurmctld", "-D")
        own = ("--pid", "--uts", "--mount", "--fork", "--kill-child", "--mount-proc")
        # Snakemake's executor takes SLURM_CONF from what it starts there.
        shown = f"mount --bind {folder}/etc /etc/slurm"
        node = f"hostname {NODE} && {shown} && exec slurmd -D -N {NODE}"
        self._begin("unshare", *own, "sh", "-c", node)
        self._wait_for(lambda: self.said("sinfo", "-h", "-o", "%t") == "idle", "the node")

    def stop(self):
        """End all of them, and with the node whatever runs on it."""
        for daemon in reversed(self._daemons):
            daemon.kill()
            daemon.wait()
        self._daemons = []

    def said(self, *command):
        """Return what one of Slurm's commands prints; nothing of one that fails."""
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        return done.stdout.strip()

    def jobs(self, *states):
        """Return the numbers of jobs in some states, or of all that are not at their end."""
        chosen = ["--states", ",".join(states)] if states else []
        return self.said("squeue", "-h", "-o", "%A", *chosen).split()

    def _begin(self, *command):
        with open(self.folder / f"{command[0]}.txt", "w") as output:
            daemon = subprocess.Popen(
                command,
                env=self.environment,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                preexec_fn=end_with_parent,
            )
        self._daemons.append(daemon)

    def _wait_for(self, ready, what):
        end = time.monotonic() + 30
        while not ready():
            if time.monotonic() > end:
                texts = [path.read_text() for path in self.folder.glob("*.txt")]
                self.stop()
                raise RuntimeError("\n".join([f"{what} does not start", *texts]))
            time.sleep(0.1)


# Slurm's daemons are not on everybody's path.
_PATH = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"], "/usr/sbin"])


def _free_ports(number):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(number)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]
