"""What the scripts that make figures share."""

import os
import subprocess
import sys

NAME = os.path.basename(sys.argv[0])
try:
    from PIL import ImageFont
except ImportError:
    sys.exit(f"{NAME}: needs the package python3-pil")

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
WHITTLE = os.path.join(ROOT, "build/release/apps/whittle/whittle")


def fail(message):
    sys.exit(f"{NAME}: {message}")


def require_whittle():
    if not os.access(WHITTLE, os.X_OK):
        fail(f"{WHITTLE} is not there; ./run builds it")


def call(*command):
    """Runs a program that must succeed; what it says on standard error."""
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    except FileNotFoundError:
        fail(f"{command[0]} is not there")
    if done.returncode != 0:
        fail(f"{' '.join(command)} failed:\n{done.stderr.strip()[-2000:]}")
    return done.stderr


def font(size):
    return ImageFont.truetype("DejaVuSans.ttf", size)


def save(figure, name, folder=os.path.join(ROOT, "docs", "images")):
    """Writes FOLDER/NAME whole or not at all."""
    path = os.path.join(folder, name)
    figure.save(path + ".part", "PNG", optimize=True)
    os.replace(path + ".part", path)
