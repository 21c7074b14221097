"""What docs and comments name must exist: files, links, functions, options, programs, variables.

Usage: check_names.py ROOT. Prints what does not exist, and returns 1 if there is anything.
"""

import os
import re
import sys

SKIPPED = {"build", "out", ".git"}
FILE = re.compile(r"(?<![\w$%./<>*-])(?:\.\./)*\w[\w./-]*\.(?:h|cpp|c|py|cmake|md|png|rules|replay)\b"
                  r"(?![\w(*/-])")
OUTPUT = re.compile(r"--(?:out|record|replay|json|stats)\s+\S+|\w+_NNNN\.png")
FOREIGN_FILES = re.compile(r"^host_sample/pads/")  # its comments name documents of others
FOREIGN_OPTIONS = {"--install", "--preset", "--build", "--cflags", "--libs", "--reload",
                   "--gtest_filter"}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def find_paths(root):
    for folder, names, files in os.walk(root):
        names[:] = [name for name in names if name not in SKIPPED]
        for name in files + names:
            yield os.path.relpath(os.path.join(folder, name), root)


def comments(text):
    return "\n".join(re.findall(r"//[^\n]*|/\*.*?\*/", text, re.S))


def slug(heading):
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


class Checker:
    def __init__(self, root):
        self.root = root
        self.paths = set(find_paths(root))
        self.tails = {path[at:] for path in self.paths
                      for at in [0] + [m.end() for m in re.finditer("/", path)]}
        sources = [p for p in self.paths if "/released/" not in p and not p.startswith("tests/docs/")]
        self.docs = sorted(p for p in sources if p.endswith(".md"))
        self.code = {p: read(os.path.join(root, p)) for p in sorted(sources)
                     if p.endswith((".h", ".cpp", ".c", ".py", ".cmake", "CMakeLists.txt"))
                     or p in ("check", "play") or p.endswith("/run")}
        everything = "\n".join(self.code.values())
        header = self.code["abi/include/peregrine/rt.h"]
        self.names = set(re.findall(r"\b(?:rt|RT)_\w+", header))
        self.options = set(re.findall(r"(?<![\w-])--[a-z][\w-]+", everything)) | FOREIGN_OPTIONS
        self.variables = set(re.findall(r"\bPEREGRINE_\w+", everything))
        self.programs = set(re.findall(
            r"(?:add_executable|peregrine_test|abi_client)\(\s*([\w.]+)", everything))
        self.design = read(os.path.join(root, "docs/design.md"))
        self.complaints = []

    def expect(self, ok, path, complaint):
        if not ok: self.complaints.append(f"{path}: {complaint}")

    def place(self, path, name):  # of what is named relative to the file that names it
        return os.path.normpath(os.path.join(os.path.dirname(path), name))

    def check_names(self, path, text):
        for name in sorted(set(re.findall(r"\b(?:rt|RT)_\w+", text))):
            family = name.endswith("_") and any(n.startswith(name) for n in self.names)
            self.expect(family or name in self.names, path, f"{name} is not in rt.h")

    def check_files(self, path, text):
        if FOREIGN_FILES.match(path): return
        for name in sorted(set(FILE.findall(OUTPUT.sub("", text)))):
            known = name in self.tails or self.place(path, name) in self.paths
            self.expect(known or name.startswith(("build/", "linux/", "hwy/")), path,
                        f"there is no {name}")

    # Comments cite by the last author and the year, or by "Arauna"; docs/design.md has the titles.
    def check_papers(self, path, text):
        self.expect(not re.search(r"\bthe\s+(//\s+)?paper\b", text), path, "which paper?")
        for author, year in re.findall(r"\b([A-Z]\w+)(?: et al\.)?,? ((?:19|20)\d\d)\b", text):
            entry = re.search(rf"{author}[^\n]*\n?[^\n]*\n?[^\n]*{year}", self.design)
            self.expect(entry, path, f"docs/design.md does not list {author} {year}")

    def check_links(self, path, text):
        for target in re.findall(r"\]\(([^)\s]+)\)", text):
            if re.match(r"https?:", target): continue
            name, _, anchor = target.partition("#")
            file = self.place(path, name) if name else path
            self.expect(file in self.paths, path, f"the link {target} leads nowhere")
            if not anchor or file not in self.docs: continue
            headings = re.findall(r"^#+ (.*)", read(os.path.join(self.root, file)), re.M)
            self.expect(anchor in map(slug, headings), path, f"there is no heading for {target}")

    def check_commands(self, path, text):
        for option in sorted(set(re.findall(r"(?<![\w-])--[a-z][\w-]+", text))):
            self.expect(option in self.options, path, f"nothing takes {option}")
        for program in sorted(set(re.findall(r"build/\w+/bin/([\w.]+\w)", text)
                                  + re.findall(r"`(\w+_test)`", text))):
            self.expect(program in self.programs, path, f"no {program} is built")
        for variable in sorted(set(re.findall(r"\bPEREGRINE_\w+", text))):
            self.expect(variable in self.variables, path, f"nothing reads {variable}")

    def check_tables(self, path, text):
        for table in re.findall(r"(?:^\|.*\n)+", text + "\n", re.M):
            rows = [re.sub(r"`[^`]*`|\\\|", "", row) for row in table.splitlines()]
            ok = len(rows) > 2 and re.fullmatch(r"[| :-]+", rows[1]) \
                and len({row.count("|") for row in rows}) == 1
            self.expect(ok, path, f"this is no whole table: {table[:60]}...")

    def run(self):
        for path in self.docs:
            text = read(os.path.join(self.root, path))
            for check in (self.check_names, self.check_files, self.check_links, self.check_commands,
                          self.check_tables):
                check(path, text)
        for path, text in self.code.items():
            if not path.endswith((".h", ".cpp", ".c")): continue
            self.check_names(path, comments(text))
            self.check_files(path, comments(text))
            if path.startswith("engine/"): self.check_papers(path, comments(text))
        return self.complaints


def main():
    complaints = Checker(sys.argv[1]).run()
    print("\n".join(complaints + [f"{len(complaints)} complaints"]))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
