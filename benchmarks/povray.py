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


# The whole model with a margin around it, as whittle shows it unless told otherwise; or from the
# same eye with half the field of view, so that the model fills the picture.
VIEWS = ("whole", "near")
NEAR_FOV = 11.25  # degrees


def view_options(view, model, folder, whittle):
    """What to tell whittle to see a model so."""
    if view == "whole":
        return []
    pov = os.path.join(folder, f"{model}.pov")
    make_model(model, pov, whittle)
    with open(pov) as file:
        text = file.read()
    eye, forward = ([float(x) for x in re.search(rf"{name} <(.*?)>", text).group(1).split(",")]
                    for name in ("location", "direction"))
    ahead = [a + 100 * b for a, b in zip(eye, forward)]
    return ["--camera", ",".join(repr(x) for x in eye + ahead), "--fov", NEAR_FOV]


def render_both(model, size, threads, folder, whittle, repeat=1, view=()):
    """Pictures of both in `folder`, with the lighting of the paper: their names, the model's .csg,
    and the median milliseconds of POV-Ray's trace (its own statistics). `view`: whittle's options."""
    csg, pov = (os.path.join(folder, f"{model}.{kind}") for kind in ("csg", "pov"))
    make_model(model, csg, whittle)
    make_model(model, pov, whittle, *view)
    ours, theirs = (os.path.join(folder, f"{model}-{who}.png") for who in ("whittle", "povray"))
    call(whittle, csg, "-o", ours, "--style", "blinn", "--imgsize", f"{size},{size}",
         "--threads", threads, "--quiet", *view)
    times = []
    for _ in range(repeat):
        log = call("povray", f"+I{pov}", f"+O{theirs}", f"+W{size}", f"+H{size}", "+Q3", "-A", "-D",
                   "-P", f"+WT{threads}").stderr
        found = re.search(r"Trace Time:.*\(([\d.]+) seconds\)", log)
        if not found:
            fail("POV-Ray's statistics hold no trace time")
        times.append(1000 * float(found.group(1)))
    return csg, ours, theirs, statistics.median(times)
