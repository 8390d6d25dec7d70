"""POV-Ray's picture of a model of `whittle model`, its time, and how it differs from whittle's."""

import os
import re
import statistics

from common import call, fail, make_model

try:
    from PIL import Image, ImageChops
except ImportError:
    fail("needs the package python3-pil")


def channels(path):
    return Image.open(path).convert("RGB")


def differing_pixels(path_a, path_b, tolerance):
    """How many pixels differ by more than so many of 255 levels in any channel."""
    a, b = channels(path_a), channels(path_b)
    if a.size != b.size:
        fail(f"{path_a} and {path_b} differ in size")
    red, green, blue = ImageChops.difference(a, b).split()
    worst = ImageChops.lighter(ImageChops.lighter(red, green), blue)
    return sum(worst.histogram()[tolerance + 1:])


def render_both(model, size, threads, folder, whittle, repeat=1):
    """Pictures of both in `folder`, with the lighting of the paper: their names, the model's .csg,
    and the median milliseconds of POV-Ray's trace (its own statistics)."""
    csg, pov = (os.path.join(folder, f"{model}.{kind}") for kind in ("csg", "pov"))
    for out in (csg, pov):
        make_model(model, out, whittle)
    ours, theirs = (os.path.join(folder, f"{model}-{who}.png") for who in ("whittle", "povray"))
    call(whittle, csg, "-o", ours, "--style", "blinn", "--imgsize", f"{size},{size}",
         "--threads", threads, "--quiet")
    times = []
    for _ in range(repeat):
        log = call("povray", f"+I{pov}", f"+O{theirs}", f"+W{size}", f"+H{size}", "+Q3", "-A", "-D",
                   "-P", f"+WT{threads}").stderr
        found = re.search(r"Trace Time:.*\(([\d.]+) seconds\)", log)
        if not found:
            fail("POV-Ray's statistics hold no trace time")
        times.append(1000 * float(found.group(1)))
    return csg, ours, theirs, statistics.median(times)
