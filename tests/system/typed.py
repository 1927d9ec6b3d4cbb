#!/usr/bin/env python3
"""Makes a shell script of a page's `sh` and `python` blocks, in their order: typed.py PAGE [--all]

The script shows each command, runs it, and names it if it fails. Python blocks continue one another. Blocks that are
called `sh slow` are left out, unless --all is given. Other languages are not typed.
"""

import re
import shlex
import subprocess
import sys

BEGINNING = r"""
type_it() {
  printf '$ %s\n' "${1%%$'\n'*}"
  eval "$1"
  code=$?
  case $code:$1 in 6:"misalign card "*) code=0 ;; esac  # a requirement is not met, which the page says
  [ $code = 0 ] || printf 'LINE FAILED: exit %s: %s\n' "$code" "$1"
}"""


def blocks(page, everything):
    """Language and text of each block that is typed."""
    for indent, info, text in re.findall(r"^( *)```([^\n`]+)\n(.*?)^ *```$", page, re.M | re.S):
        language, *words = info.split()
        if language in ("bash", "shell", "console", "py") or words not in ([], ["slow"]):
            sys.exit(f"a block is called {info}; what is typed is `sh`, `sh slow` or `python`")
        if language in ("sh", "python") and (everything or not words):
            yield language, re.sub(f"^{indent}", "", text, flags=re.M)


def commands(text):
    """Commands of a shell block: a line each, with all that the shell still waits for at its end."""
    command = []
    for line in text.splitlines():
        command.append(line)
        heard = subprocess.run(["bash", "-n"], input="\n".join(command) + "\n", capture_output=True, text=True)
        if line.endswith("\\") or heard.stderr:
            continue  # an open quote, loop or here-document
        if line.strip():
            yield "\n".join(command)
        command = []
    if command:
        sys.exit(f"a command has no end: {command}")


def main(page, everything):
    with open(page, encoding="utf-8") as file:
        typed = list(blocks(file.read(), everything))
    print(BEGINNING.strip())
    python = ""
    for language, text in typed:
        if language == "python":
            python += text
            print("type_it", shlex.quote(f"/usr/bin/python3 -c {shlex.quote(python)}"))
        else:
            for command in commands(text):
                print("type_it", shlex.quote(command))


main(sys.argv[1], "--all" in sys.argv[2:])
