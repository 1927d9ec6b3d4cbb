"""Reference pages from the program itself: what it prints of its verbs and keys."""

import inspect
import re
import subprocess


def said(program, *words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def verbs_of(program):
    """Each verb with its sentence, as `misalign help` lists them."""
    listed = re.search(r"^Verbs:\n(.*?)\n\n", said(program, "help"), re.M | re.S)[1]
    entries = re.findall(r"^  (\w+) +(\S.*(?:\n {4,}\S.*)*)", listed, re.M)
    return {name: re.sub(r"\s+", " ", words) for name, words in entries}


def verb_page(program, name):
    words = said(program, "help", name).rstrip()
    return f"# misalign {name}\n\n*Reference.* What `misalign help {name}` prints.\n\n```text\n{words}\n```\n"


def keys_page(program):
    return ("# Keys of campaigns and patterns\n\n*Reference.* What `misalign config --keys` prints.\n\n" +
            said(program, "config", "--keys"))


def python_page():
    """Words of the package, which it has to be on PYTHONPATH for."""
    import misalign

    parts = [f"# Python\n\n*Reference.* The package `misalign`, as `help(misalign)` shows it.\n\n"
             f"```text\n{inspect.getdoc(misalign)}\n```\n"]
    for name in misalign.__all__:
        thing = getattr(misalign, name)
        if not callable(thing):
            continue
        parts.append(f"## {name}\n\n{documented(thing)}")
        if inspect.isclass(thing):
            parts += [f"### {name}.{each}\n\n{documented(method)}" for each, method in vars(thing).items()
                      if not each.startswith("_") and inspect.getdoc(method)]
    return "\n".join(parts)


def documented(thing):
    try:
        signature = f"{thing.__name__}{inspect.signature(thing)}\n\n" if callable(thing) else ""
    except ValueError:
        signature = ""
    return f"```text\n{signature}{inspect.getdoc(thing)}\n```\n"


def pages(program):
    """Name below search/manual/, and text."""
    verbs = verbs_of(program)
    made = {f"reference/{name}.md": verb_page(program, name) for name in verbs}
    made["reference/keys.md"] = keys_page(program)
    made["reference/python.md"] = python_page()
    return made
