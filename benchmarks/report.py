"""Pages and charts made of result files: what the scripts that write docs/ share."""

import argparse
import glob
import json
import os
import subprocess
import sys

from common import RESULTS, ROOT, fail

sys.path.append(os.path.join(ROOT, "scripts"))
from wrap_docs import wrap  # noqa: E402


def latest(kind, folder=RESULTS):
    paths = sorted(glob.glob(os.path.join(folder, f"{kind}-*.json")))
    if not paths:
        fail(f"there is no {os.path.relpath(folder)}/{kind}-DATE.json")
    with open(paths[-1]) as file:
        return {"file": os.path.basename(paths[-1]), **json.load(file)}


def short(value):
    """Three digits; large numbers whole, with commas."""
    if value is None or value == "":
        return "–"
    if isinstance(value, str):
        return value
    if isinstance(value, int) or value >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value < 10 else f"{value:.1f}"


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |",
             "|" + "|".join(["---"] + ["--:"] * (len(heads) - 1)) + "|"]
    lines += ["| " + " | ".join(short(value) for value in row) + " |" for row in rows]
    return "\n".join(lines)


def source(*results):
    return "Source: " + "; ".join(
        f"[{r['file']}](../benchmarks/results/{r['file']}), {r['date']}, {r['machine']}"
        for r in results) + "."


def plot(folder, name, settings, data, curves):
    """One chart as SVG and PNG. data: name -> rows; curves: (data name, using, title)."""
    blocks = "".join(f"${key} << EOD\n" + "\n".join(" ".join(str(v) for v in row) for row in rows) +
                     "\nEOD\n" for key, rows in data.items())
    curves_text = ", ".join(f"${key} using {using} with linespoints lw 2 pt 7 ps 0.5 title '{title}'"
                            for key, using, title in curves)
    script = "set encoding utf8\nset grid lc rgb '#dddddd'\nset border 3\nset tics nomirror\n"
    script += "set key outside right\nset autoscale xfix\nset offsets graph 0.02, graph 0.02\n"
    # Colours that are told apart on white.
    for i, color in enumerate(("4477aa", "228833", "ee6677", "aa3377", "222222", "ccbb44"), 1):
        script += f"set linetype {i} lc rgb '#{color}'\n"
    script += settings + "\n" + blocks
    for terminal, ending in (("svg size 760,420 font 'sans,13' background 'white'", "svg"),
                             ("pngcairo size 760,420 font 'sans,10' background 'white'", "png")):
        path = os.path.join(folder, f"{name}.{ending}")
        script += f"set terminal {terminal}\nset output '{path}'\nplot {curves_text}\n"
    try:
        done = subprocess.run(["gnuplot"], input=script, text=True, capture_output=True)
    except FileNotFoundError:
        fail("charts need gnuplot (package gnuplot-nox)")
    if done.returncode != 0:
        fail(f"gnuplot: {done.stderr}")


def write_or_check(path, text, check):
    """Writes a page whole or not at all; with `check`, fails if it is not what stands there."""
    text = wrap(text)
    if check:
        with open(path) as file:
            if file.read() != text:
                fail(f"{os.path.relpath(path)} is not what benchmarks/results says; make it again")
        return
    with open(path + ".part", "w") as file:
        file.write(text)
    os.replace(path + ".part", path)


def page_arguments(description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--check", action="store_true",
                        help="make nothing; fail if the page is not what the results say")
    return parser
