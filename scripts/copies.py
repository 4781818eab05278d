"""A copy of the sources to which the mutants of `proofs/mutants.toml` are applied; for scripts/mutants."""

import contextlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()
IGNORED = shutil.ignore_patterns("target", ".git", "__pycache__")


class Copy:
    """The sources in a folder of their own, built below target/mutants."""

    def __init__(self, folder):
        self.path = pathlib.Path(folder) / "mufasa"
        # Every file is new, or a build would take what an earlier run has left for the same.
        shutil.copytree(ROOT, self.path, ignore=IGNORED, copy_function=shutil.copyfile)
        command = ["cargo", "build", "-q", "--locked", "-p", "mufasa-mutants", "--bin", "mutants"]
        self.check(command, cwd=ROOT)
        self.applier = shutil.copy(TARGET / "debug/mutants", folder)
        self.sources = {file: file.read_bytes() for file in self.path.rglob("*.rs")}
        self.mutants = tomllib.loads((self.path / "proofs/mutants.toml").read_text())["mutant"]

    @contextlib.contextmanager
    def changed(self, mutant):
        """Applies a mutant, and takes it back."""
        self.check([self.applier, self.path, mutant["change"]])
        self.mutant = mutant
        try:
            yield
        finally:
            for file, content in self.sources.items():
                if file.read_bytes() != content:
                    file.write_bytes(content)

    def run(self, command, family, **environment):
        """Runs a command in the copy; families of engines that build alike share a target folder."""
        settings = dict(os.environ, RUSTFLAGS="-A warnings", RUST_BACKTRACE="0",
                        CARGO_TARGET_DIR=str(TARGET / "mutants" / family), **environment)
        return subprocess.run(command, cwd=self.path, env=settings, text=True, capture_output=True)

    def check(self, command, **where):
        done = subprocess.run(command, text=True, capture_output=True, **where)
        if done.returncode:
            sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")


def fingerprint(mutant):
    """FNV-1a of what a mutant changes, as `Mutant::fingerprint` in proofs/mutants."""
    hash_ = 0xCBF29CE484222325
    for place in mutant["at"]:
        for part in [place["item"].encode(), place["from"].encode(), place["to"].encode()]:
            for byte in len(part).to_bytes(8, "little") + part:
                hash_ = (hash_ ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return f"{hash_:016x}"


@contextlib.contextmanager
def copy():
    with tempfile.TemporaryDirectory() as folder:
        yield Copy(folder)
