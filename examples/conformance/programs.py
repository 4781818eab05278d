"""The programs under test: how they are built, with a seeded bug or without, and judged."""
import json
import os
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import seeded_bugs

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LONGEST = 3600  # s, of one campaign
# Of each program, which begins with its language, and profile: the kinds of records.
PROGRAMS = {("Python", "paper"): "cycle,offloading,composition,line",
            ("Python", "hardened"): "cycle,offloading,line",
            ("Python monitor", "paper"): "monitor",
            ("Python monitor", "hardened"): "monitor",
            ("C++", "paper"): "cycle,line",
            ("JavaScript", "paper"): "cycle"}


@dataclass
class Run:
    code: int
    words: str
    classes: list

    def first(self):
        """The number of the first case that disagrees, from 1 on; None when none does."""
        cases = [found["first"] for found in self.classes if found["first"] is not None]
        return min(cases) + 1 if cases else None


def mufasa():
    """The program `mufasa`: MUFASA, or built."""
    if "MUFASA" in os.environ:
        return os.environ["MUFASA"]
    subprocess.run(["cargo", "build", "--release", "--locked", "-p", "mufasa-oracle"], cwd=ROOT,
                   check=True)
    return str(ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "release" / "mufasa")


def measured():
    """What a table is measured with: commit, versions, day."""
    programs = ["python3", "c++", "node"]
    return subprocess.check_output([ROOT / "scripts" / "measured", *programs], text=True).strip()


def runs(language):
    """What runs or builds programs in a language; None when it is not here."""
    names = {"Python": ("python3",), "C++": ("c++", "g++", "clang++"), "JavaScript": ("node",)}
    return next(filter(shutil.which, names[language.split()[0]]), None)


def build(language, folder, bug=None):
    """The command of a program, with a seeded bug if one is given, made in a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    sources = [path for path in HERE.iterdir() if path.suffix in (".py", ".mjs", ".cpp", ".hpp")]
    if bug is None:
        for source in sources:
            shutil.copy(source, folder)
    else:
        seeded_bugs.seed(bug, sources, folder)
    if language.startswith("Python"):
        return [runs(language), folder / "mufasa_py.py"]
    if language == "JavaScript":
        return [runs(language), folder / "mufasa_js.mjs"]
    subprocess.run([runs(language), "-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", "-o",
                    folder / "mufasa_cpp", folder / "mufasa_cpp.cpp"], check=True)
    return [folder / "mufasa_cpp"]


def conform(tool, language, profile, command, out, cases, *options):
    """Judges a program by `mufasa conform`, and reads the summary."""
    shutil.rmtree(out, ignore_errors=True)
    done = subprocess.run(
        [tool, "conform", "--profile", profile, "--kinds", PROGRAMS[language, profile],
         "--cases", str(cases), *options, "--out", out, "--",
         *command],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, timeout=LONGEST)
    summary = out / "summary.json"
    found = json.loads(summary.read_text()) if summary.exists() else {"classes": []}
    return Run(done.returncode, done.stdout, found["classes"])
