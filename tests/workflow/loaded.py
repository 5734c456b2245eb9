"""Snakemake, loaded once and then forked for each command: loading is half of what a start takes.

Of this project nothing is loaded before the fork, so that a command meets the modules of its own
`PYTHONPATH`, as it would in a new process.
"""

import functools
import importlib
import json
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

MODULES = ("snakemake.cli", "snakemake.report.html_reporter", "smart_open", "numpy.ma", "pydantic")
OWN = ("branchcrush", "snakemake_logger_plugin_branchcrush")


def snakemake(arguments, folder, environment, timeout):
    """Run `python -m snakemake` with arguments, as if typed in a folder.

    Returns what subprocess.run would, with `processor_time` [s] of the command, without loading.
    """
    server = _server()
    with tempfile.TemporaryDirectory() as place:
        files = [str(Path(place, name)) for name in ("stdout", "stderr")]
        request = {
            "arguments": arguments,
            "folder": str(folder),
            "environment": environment,
            "files": files,
            "timeout": timeout,
        }
        server.stdin.write(json.dumps(request) + "\n")
        server.stdin.flush()
        code, used = json.loads(server.stdout.readline())
        stdout, stderr = (Path(file).read_text(encoding="utf-8") for file in files)
    if code == -signal.SIGALRM:
        raise subprocess.TimeoutExpired(arguments, timeout, stdout, stderr)
    run = subprocess.CompletedProcess(arguments, code, stdout, stderr)
    run.processor_time = used
    return run


@functools.cache
def _server():
    """Return the process that is forked, which ends when its input does."""
    return subprocess.Popen(
        [sys.executable, __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )


def _serve():
    for module in MODULES:
        importlib.import_module(module)
    assert not [name for name in sys.modules if name.split(".")[0] in OWN]
    while request := sys.stdin.readline():
        child = os.fork()
        if child == 0:
            _become(**json.loads(request))
        _, status, used = os.wait4(child, 0)
        answer = os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime
        print(json.dumps(answer), flush=True)


def _become(arguments, folder, environment, files, timeout):
    """Be the command from here on."""
    for number, (name, flags) in enumerate(
        [(os.devnull, os.O_RDONLY), *((file, os.O_WRONLY | os.O_CREAT) for file in files)]
    ):
        os.dup2(os.open(name, flags), number)
    signal.alarm(timeout)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    # Where `python -m` looks first.
    sys.path[:1] = [str(folder), *environment["PYTHONPATH"].split(os.pathsep)]
    sys.argv = ["snakemake", *arguments]
    from snakemake.cli import main

    main()
    sys.exit()


if __name__ == "__main__":
    _serve()
