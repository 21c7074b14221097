#!/usr/bin/env python3
"""Opens the sample host in a window on a virtual display, presses keys and looks at the screen.

Passes if the window shows a picture that is not flat, if walking (W), the next view (V) and the
next camera (C) each change it, if a resize is followed, and if Escape ends the program.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from PIL import Image, ImageChops, ImageGrab, ImageStat

from display import Display

SIZE = (640, 400)
LARGER = (720, 450)


class Host:
    """The program under test and its window."""

    def __init__(self, display, program, scene):
        self.display = display
        self.environment = display.environment()
        self.folder = tempfile.TemporaryDirectory()
        self.process = subprocess.Popen(
            [program, "--scene", scene, "--size", "%dx%d" % SIZE, "--quiet"],
            env=self.environment,
            cwd=self.folder.name,
        )
        self.window = self.wait_for(self.find_window, 120, "its window")

    def xdotool(self, *arguments):
        return subprocess.run(
            ["xdotool", *arguments], env=self.environment, capture_output=True, text=True
        ).stdout.strip()

    def find_window(self):
        return self.xdotool("search", "--name", "^Peregrine").split("\n")[0]

    def title(self):
        return self.xdotool("getwindowname", self.window)

    def wait_for(self, find, seconds, what):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.process.poll() is not None:
                sys.exit(f"the program ended with {self.process.returncode} before {what}")
            found = find()
            if found:
                return found
            time.sleep(0.1)
        sys.exit(f"waited {seconds} s for {what}")

    def screen(self, size=SIZE):
        place = dict(
            line.split("=")
            for line in self.xdotool("getwindowgeometry", "--shell", self.window).split("\n")
        )
        x, y = int(place["X"]), int(place["Y"])
        picture = ImageGrab.grab(xdisplay=self.display.name)
        return picture.crop((x, y, x + size[0], y + size[1])).convert("RGB")

    def hold(self, key, seconds):
        self.xdotool("keydown", "--window", self.window, key)
        self.xdotool("keydown", key)
        time.sleep(seconds)
        self.xdotool("keyup", key)
        self.xdotool("keyup", "--window", self.window, key)

    def press(self, key):
        self.xdotool("key", "--window", self.window, key)


def difference(a, b):
    """Mean absolute difference of two pictures, 0 to 255."""
    return sum(ImageStat.Stat(ImageChops.difference(a, b)).mean) / 3


def contrast(picture):
    return max(ImageStat.Stat(picture).stddev)


def walk(host, out):
    host.wait_for(lambda: " ms" in host.title(), 120, "a frame time in the title")
    host.xdotool("windowfocus", host.window)
    first = host.screen()
    first.save(out / "1_start.png")
    assert contrast(first) > 10, "the window is flat"

    host.hold("w", 1.5)
    walked = host.wait_for(
        lambda: (p := host.screen()) and difference(p, first) > 3 and p, 60, "W to move the camera"
    )
    time.sleep(1)
    walked = host.screen()
    walked.save(out / "2_walked.png")

    host.press("v")
    host.wait_for(lambda: difference(host.screen(), walked) > 10, 60, "V to change the view")
    host.wait_for(lambda: "normals" in host.title(), 60, "the view in the title")
    host.screen().save(out / "3_normals.png")
    for view in ("depth", "steps", "shaded"):
        host.press("v")
        host.wait_for(lambda: view in host.title(), 60, "the view " + view)
    host.press("c")
    host.wait_for(lambda: difference(host.screen(), walked) > 5, 60, "C to change the camera")

    host.xdotool("windowsize", host.window, *map(str, LARGER))
    host.wait_for(lambda: "%dx%d" % LARGER in host.title(), 60, "the new size in the title")
    larger = host.screen(LARGER)
    larger.save(out / "4_larger.png")
    corner = larger.crop((SIZE[0], SIZE[1], *LARGER))
    assert contrast(corner) > 1, "the grown part of the window is flat"

    host.press("Escape")
    time.sleep(0.3)
    host.press("Escape")
    host.process.wait(60)
    assert host.process.returncode == 0, f"exit status {host.process.returncode}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scene", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path, help="folder for screenshots")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    with Display() as display:
        host = Host(display, arguments.program, arguments.scene)
        try:
            walk(host, arguments.out)
        finally:
            host.process.kill()
    print("walked; screenshots are in", arguments.out)


if __name__ == "__main__":
    main()
