"""OpenSCAD's pictures and what they cost, kept from run to run: it takes minutes for a file."""

import contextlib
import hashlib
import json
import math
import os
import resource
import signal
import subprocess
import tempfile
import time

from common import fail


@contextlib.contextmanager
def display():
    """DISPLAY for a program that draws: the one there is, or a server of its own as long as needed."""
    if os.environ.get("DISPLAY"):
        yield os.environ["DISPLAY"]
        return
    read_end, write_end = os.pipe()
    try:
        server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1280x1024x24",
                                   "-nolisten", "tcp"], pass_fds=[write_end], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    except FileNotFoundError:
        fail("OpenSCAD draws on a display; there is none, and no Xvfb (package xvfb)")
    os.close(write_end)
    try:
        with os.fdopen(read_end) as ready:
            number = ready.readline().strip()
        if not number:
            fail("Xvfb did not start")
        yield f":{number}"
    finally:
        server.terminate()
        server.wait()


def run_measured(command, limit_s, log, environment=None):
    """Runs a command to its end or so much processor time; what it says goes to the file `log`."""
    limit = math.ceil(limit_s)
    start = time.monotonic()
    with open(log, "w") as said:
        process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=said, stderr=said, env=environment,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1)))
    try:
        # The children's sum would count others too; this is the one child's own.
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    finally:
        process.kill()
    stopped = process.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
    return {"exit_code": process.returncode, "ended": not stopped,
            "wall_s": time.monotonic() - start, "cpu_s": usage.ru_utime + usage.ru_stime,
            "memory_mb": usage.ru_maxrss / 1024}


def version(program):
    try:
        done = subprocess.run([program, "--version"], capture_output=True, text=True)
    except OSError as error:
        fail(f"{program}: {error.strerror}")
    return (done.stdout + done.stderr).strip()


class OpenScad:
    """Renders files, each once: what the cache has of a file, a size and a version is not made again."""

    def __init__(self, program, size, limit_s, cache, on_display):
        self.version = version(program)
        self._program = program
        self._limit_s = limit_s
        self._cache = cache
        self._display = on_display
        self.options = ["--viewall", "--autocenter", f"--imgsize={size[0]},{size[1]}"]
        self._key = f"{size[0]}x{size[1]}"

    def render(self, path):
        """What a run cost, and `picture` and `log`, files in the cache; there may be no picture."""
        with open(path, "rb") as file:
            digest = hashlib.sha256(file.read()).hexdigest()
        name = f"{os.path.splitext(os.path.basename(path))[0]}-{digest[:8]}-{self._key}"
        picture, log, record = (os.path.join(self._cache, name + end) for end in (".png", ".log", ".json"))
        known = self._known(record)
        if not known:
            known = self._make(path, picture, log)
            known.update(version=self.version, limit_s=self._limit_s)
            # Killed by somebody else, or for its memory: that says nothing about the next time.
            if known["exit_code"] != -signal.SIGKILL:
                with open(record + ".part", "w") as file:
                    json.dump(known, file, indent=2)
                os.replace(record + ".part", record)
        with open(log, errors="replace") as file:
            said = file.read()
        return {**known, "picture": picture if os.path.exists(picture) else None, "said": said}

    def _known(self, record):
        try:
            with open(record) as file:
                known = json.load(file)
        except FileNotFoundError:
            return None
        enough = known["ended"] or known["limit_s"] >= self._limit_s
        return known if enough and known["version"] == self.version else None

    def _make(self, path, picture, log):
        with contextlib.suppress(FileNotFoundError):
            os.remove(picture)
        load = os.getloadavg()[0]
        with tempfile.TemporaryDirectory() as home:
            environment = {**os.environ, "HOME": home, "DISPLAY": self._display,
                           "LIBGL_ALWAYS_SOFTWARE": "1"}
            # The word after a bare --render would be its value.
            cost = run_measured([self._program, "--render=force", *self.options, "-o", picture, path],
                                self._limit_s, log, environment)
        return {**cost, "load_before": load, "load_after": os.getloadavg()[0]}
