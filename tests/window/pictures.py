#!/usr/bin/env python3
"""Makes the pictures of docs/game.md by playing, on a virtual display:

    /usr/bin/python3 tests/window/pictures.py --program build/release/bin/peregrine_play --out docs

On a fast machine there is less time to look: see what came out.
"""

import argparse
import pathlib
import time

from PIL import Image, ImageChops, ImageOps

from display import Display
from host import Host, contrast

SIZE = (1280, 720)
SAVED = (960, 540)  # as many pixels as --scale 0.75 renders
MOST_BYTES = 600_000
ALARM = (255, 69, 56)  # of the label that tells it
ALARM_AT = (640 - 34, 74, 640 + 34, 94)  # where that is
BESIDE_ALARM_AT = (640 - 55, 74, 640 - 43, 94)  # where a longer word would be
MARKS_AT = [(150, 120, 450, 640), (830, 120, 1130, 640)]  # where a drone is well in view
CORE = (115, 222, 255)  # of the third diamond over a round that was won
CORE_AT = (136, 64, 152, 84)
CAUGHT = (246, 147, 142)  # of the heading of one that was lost
CAUGHT_AT = (72, 110, 400, 170)


def count(picture, colour, box):
    """Pixels of nearly this colour."""
    part = picture.crop(box)
    red, green, blue = ImageChops.difference(part, Image.new("RGB", part.size, colour)).split()
    farthest = ImageChops.lighter(ImageChops.lighter(red, green), blue)
    return sum(farthest.histogram()[:12])


class Camera:
    def __init__(self, display, program, out):
        self.display, self.program, self.out = display, program, out

    def game(self, *arguments):
        return Host(self.display, self.program, "--mute", "--scale", "0.75", *arguments, size=SIZE)

    def save(self, picture, name):
        """With as many bits a channel as there is room for."""
        small = picture.resize(SAVED, Image.Resampling.LANCZOS)
        for bits in range(8, 3, -1):
            file = self.out / f"game_{name}.png"
            ImageOps.posterize(small, bits).save(file, optimize=True)
            if file.stat().st_size < MOST_BYTES:
                return

    def best(self, host, seconds, rate):
        """The picture with the highest rating of those of some seconds."""
        best, most = None, -1
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            picture = host.screen()
            rating = rate(picture)
            if rating > most:
                best, most = picture, rating
        return best


def begin(host):
    host.wait_for(lambda: contrast(host.screen()) > 10, 180, "the title")
    host.xdotool("windowfocus", host.window)
    time.sleep(4)


def menus(camera):
    with camera.game("--difficulty", "normal", "--seed", "7") as host:
        begin(host)
        camera.save(host.screen(), "title")
        host.press("Return")
        time.sleep(3)
        camera.save(host.screen(), "play")
        # A step to the side bends the arc.
        host.key_down("g")
        time.sleep(2)
        host.key_down("a")
        time.sleep(1.2)
        camera.save(host.screen(), "preview")
        host.press("Escape")
        host.key_up("a")
        host.key_up("g")
        time.sleep(7)  # toasts go
        camera.save(host.settled_screen(), "pause")
        for _ in range(2):
            host.press("Down")
            time.sleep(0.6)
        host.press("Return")
        time.sleep(2)
        camera.save(host.settled_screen(), "options")


def lost(camera):
    """By standing in sight of the drone of the nave, and then walking along it."""
    def is_alarmed(picture):
        return count(picture, ALARM, ALARM_AT) > 200 and not count(picture, ALARM, BESIDE_ALARM_AT)

    def rate(picture):
        return is_alarmed(picture) and 1 + sum(count(picture, ALARM, box) for box in MARKS_AT)

    with camera.game("--difficulty", "hard", "--seed", "7") as host:
        begin(host)
        host.press("Return")
        host.wait_for(lambda: is_alarmed(host.screen()), 300, "the alarm")
        camera.save(camera.best(host, 6, rate), "alarm")
        host.key_down("shift")
        host.hold("w", 8)
        host.key_up("shift")
        host.wait_for(lambda: count(host.screen(), CAUGHT, CAUGHT_AT) > 200, 180, "the end of the round")
        time.sleep(3)
        camera.save(host.screen(), "lost")


def won(camera):
    """By the bot."""
    with camera.game("--bot", "--difficulty", "normal", "--seed", "1") as host:
        host.wait_for(lambda: contrast(host.screen()) > 10, 180, "the round")
        host.wait_for(lambda: count(host.screen(), CORE, CORE_AT) > 40, 300, "the end")
        time.sleep(3)
        camera.save(host.screen(), "won")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path, help="folder for the pictures")
    takes = {"menus": menus, "lost": lost, "won": won}
    parser.add_argument("--take", choices=takes, help="these pictures only")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    program = str(pathlib.Path(arguments.program).absolute())
    with Display() as display:
        camera = Camera(display, program, arguments.out)
        for take in [arguments.take] if arguments.take else takes:
            takes[take](camera)
    print("the pictures are in", arguments.out)


if __name__ == "__main__":
    main()
