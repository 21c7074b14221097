"""Measurements: rows of peregrine_bench."""

import json
import pathlib
import subprocess
import tempfile


class Failure(Exception):
    """A measurement that did not come about; the text says why."""


class Bench:
    """Runs peregrine_bench and keeps the commands, so that a page can name them."""

    def __init__(self, build, scenes, quick):
        self.programs = pathlib.Path(build) / "bin"
        self.scenes = scenes  # files by name, the hall first
        self.quick = quick
        self.commands = []

    def rows(self, command, *options):
        """What a sub-command writes with --json, as dictionaries."""
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "rows.json"
            line = [str(self.programs / "peregrine_bench"), command, *map(str, options)]
            self.commands.append(" ".join(["peregrine_bench", command, *map(shown, options)]))
            self.run([*line, "--json", str(out)])
            return json.loads(out.read_text(encoding="utf-8"))["rows"]

    def run(self, line, least_status=0):
        done = subprocess.run(line, capture_output=True, text=True, check=False)
        if done.returncode > least_status or done.returncode < 0:
            last = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
            raise Failure(f"{pathlib.Path(line[0]).name} ended with {done.returncode}: {' '.join(last)}")
        return done.stdout

    def scene(self, *names):
        """Options for the scenes of these names, or for the hall if none of them is there."""
        files = [self.scenes[name] for name in names if name in self.scenes] or [self.scenes["hall"]]
        return [word for file in files for word in ("--scene", file)]


def shown(option):
    path = pathlib.Path(str(option))
    return path.name if path.is_absolute() else str(option)
