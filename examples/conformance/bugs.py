"""The seeded bugs: `--bug NAME` sets ON, and the code asks for it where the bug is. README.md says
what each one does."""
NAMES = ("le-for-lt", "no-sqrt", "missing-skip", "wrong-horizon", "off-by-one-lane", "no-hold",
         "nan-accepted", "only-explained", "no-shift")
ON = None
