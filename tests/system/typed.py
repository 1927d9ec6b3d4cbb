#!/usr/bin/env python3
"""Makes a shell script of a page's `sh` and `python` blocks, in their order: typed.py PAGE [--all]

Each command is shown, run, and named if it fails. Python blocks continue one another. Blocks called `sh slow` or
`python slow` are left out unless --all is given. Other languages are not typed.
"""

import re
import shlex
import subprocess
import sys


def blocks(page):
    """Language, whether it is slow, and the lines of each block."""
    for info, text in re.findall(r"^ *```([^\n`]*)\n(.*?)^ *```$", page, re.M | re.S):
        words = info.split() or [""]
        if words[0] in ("bash", "shell", "console", "py"):
            sys.exit(f"a block is called {words[0]}: `sh` and `python` are typed")
        if words[0] in ("sh", "python"):
            yield words[0], "slow" in words[1:], text


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
        sys.exit(f"no end: {command}")


def main(page, everything):
    with open(page, encoding="utf-8") as file:
        typed = list(blocks(file.read()))
    python = ""
    for language, slow, text in typed:
        if slow and not everything:
            continue
        if language == "sh":
            for command in commands(text):
                print(f"printf '%s\\n' {shlex.quote('$ ' + command)}")
                print(f"{command}\ncode=$?; [ $code = 0 ] || echo \"LINE FAILED: exit $code:\" {shlex.quote(command)}")
        else:
            python += text
            print("printf '%s\\n' '$ python'")
            print(f"/usr/bin/python3 -c {shlex.quote(python)} || echo 'LINE FAILED: python' {shlex.quote(text)}")


main(sys.argv[1], "--all" in sys.argv[2:])
