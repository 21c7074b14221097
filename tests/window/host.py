"""The program under test in a window on a virtual display, and its screen."""

import subprocess
import sys
import tempfile
import time

from PIL import ImageChops, ImageGrab, ImageStat

SIZE = (640, 400)


class Host:
    """The program under test and its window. Its user's files are new, and its working folder, too,
    if none is given."""

    def __init__(self, display, program, *arguments, size=SIZE, folder=None):
        self.display = display
        self.size = size
        self.folder = tempfile.TemporaryDirectory()
        self.environment = dict(
            display.environment(),
            XDG_CONFIG_HOME=self.folder.name + "/config",
            XDG_DATA_HOME=self.folder.name + "/data",
        )
        self.process = subprocess.Popen(
            [program, "--size", "%dx%d" % size, "--quiet", *arguments],
            env=self.environment,
            cwd=folder or self.folder.name,
        )
        self.window = self.wait_for(self.find_window, 120, "its window")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def xdotool(self, *arguments):
        return subprocess.run(
            ["xdotool", *arguments], env=self.environment, capture_output=True, text=True
        ).stdout.strip()

    def find_window(self):
        return self.xdotool("search", "--name", "^(Peregrine|Three Cores)").split("\n")[0]

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

    def screen(self, size=None):
        size = size or self.size
        place = dict(
            line.split("=")
            for line in self.xdotool("getwindowgeometry", "--shell", self.window).split("\n")
        )
        x, y = int(place["X"]), int(place["Y"])
        picture = ImageGrab.grab(xdisplay=self.display.name)
        return picture.crop((x, y, x + size[0], y + size[1])).convert("RGB")

    def key_down(self, key):
        self.xdotool("keydown", "--window", self.window, key)
        self.xdotool("keydown", key)

    def key_up(self, key):
        self.xdotool("keyup", key)
        self.xdotool("keyup", "--window", self.window, key)

    def hold(self, key, seconds):
        self.key_down(key)
        time.sleep(seconds)
        self.key_up(key)

    def press(self, key):
        self.xdotool("key", "--window", self.window, key)

    def press_until_it_ends(self, key, seconds):
        end = time.monotonic() + seconds
        while self.process.poll() is None and time.monotonic() < end:
            self.press(key)
            time.sleep(0.5)
        assert self.process.returncode == 0, f"exit status {self.process.returncode}"


    def settled_screen(self):
        """The screen once two pictures of it are alike."""
        before = self.screen()

        def same():
            nonlocal before
            time.sleep(0.3)
            now = self.screen()
            alike = difference(now, before) < 0.5
            before = now
            return now if alike else None

        return self.wait_for(same, 60, "the picture to stand still")


def difference(a, b):
    """Mean absolute difference of two pictures, 0 to 255."""
    return sum(ImageStat.Stat(ImageChops.difference(a, b)).mean) / 3


def contrast(picture):
    return max(ImageStat.Stat(picture).stddev)
