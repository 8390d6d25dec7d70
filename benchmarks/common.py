"""What the benchmark scripts share: where things are, what machine this is, how results are kept."""

import datetime
import json
import os
import platform
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
RESULTS = os.path.join(ROOT, "benchmarks", "results")
BUILD = os.path.join(ROOT, "build", "release")
WHITTLE = os.path.join(BUILD, "apps", "whittle", "whittle")


def fail(message):
    sys.exit(f"{os.path.basename(sys.argv[0])}: {message}")


def call(*command):
    words = [str(word) for word in command]
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"{' '.join(words)} failed:\n{done.stderr.strip()[-2000:]}")
    return done


def processor():
    try:
        with open("/proc/cpuinfo") as file:
            return re.search(r"model name\s*: (.*)", file.read()).group(1).strip()
    except (OSError, AttributeError):
        return platform.processor() or "unknown"


def today():
    return datetime.date.today().isoformat()


def machine():
    return f"{processor()}, {os.cpu_count()} cores"


def make_model(model, path, whittle=WHITTLE, *options):
    """Writes a model named in one word, as in cheese1000; the path's ending says as what."""
    parts = re.fullmatch(r"(r9|[a-z]+)(\d*)", model)
    if not parts:
        fail(f"{model}: a model is a name and a size in one word, as in cheese1000")
    call(whittle, "model", *(part for part in parts.groups() if part), "-o", path, *options)


def write_results(kind, content, folder=RESULTS):
    """Writes KIND-DATE.json, with machine and date, whole or not at all."""
    path = os.path.join(folder, f"{kind}-{today()}.json")
    os.makedirs(folder, exist_ok=True)
    with open(path + ".part", "w") as file:
        json.dump({"date": today(), "machine": machine(), **content}, file, indent=2)
        file.write("\n")
    os.replace(path + ".part", path)
    print(f"wrote {os.path.relpath(path)}")
