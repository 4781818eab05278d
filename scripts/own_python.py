"""Packages for a script: it goes on in an environment of its own, where they are installed on the first run."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def with_packages(name, packages):
    """Starts the script again in `target/NAME`, or the folder that VENV names, with these packages."""
    venv = Path(os.environ.get("VENV", ROOT / "target" / name))
    python, installed = venv / "bin" / "python", venv / "installed.txt"
    if Path(sys.prefix).resolve() == venv.resolve():
        return
    if not installed.exists() or installed.read_text().split() != packages:
        subprocess.run([sys.executable, "-m", "venv", venv], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *packages], check=True)
        installed.write_text("\n".join(packages))
    os.execv(python, [python, *sys.argv])
