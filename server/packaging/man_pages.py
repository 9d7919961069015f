#!/usr/bin/python3
"""Makes manual pages of skerryd, skerry, its commands and its tools out of their --help, by help2man.

Usage: man_pages.py [--list] PROGRAM_FOLDER [PAGE_FOLDER]      --list: only the pages' names, without help2man

A page for each command of skerry and each command in it: skerry-recording-cut(1).
"""
import argparse
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile

SECTION_8 = {"skerry-admin"}
SEE_ALSO = "[SEE ALSO]\n.BR skerryd (1),\n.BR skerry (1),\n.BR skerry.yaml (5)\n.PP\n" \
           "The pages of the package skerry\\-doc, in /usr/share/doc/skerry.\n"
# Tools that are no command of skerry under their own name.
TOOLS = ["skerry-access"]
# A delegated command's own commands that lead to the tool's others.
ELSEWHERE = {("skerry", "scenario"): {"traffic", "report"}}


def help_of(command):
    run = subprocess.run(command + ["--help"], capture_output=True, text=True, check=False)
    if run.returncode != 0 or "Usage:" not in run.stdout:
        sys.exit(f"man_pages.py: {' '.join(command)} --help gave no help: {run.stderr.strip()}")
    return run.stdout


def commands_in(text):
    """The names that a help text lists."""
    found = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.M)
    return re.findall(r"^  ([a-z][\w-]*) ", found[1], re.M) if found else []


def pages(programs):
    """Pairs of a page's name and the command whose help it is."""
    made = [(tool, [os.path.join(programs, tool)]) for tool in ["skerryd"] + TOOLS]

    def add(words, depth):
        command = [os.path.join(programs, words[0])] + words[1:]
        made.append(("-".join(words), command))
        if depth == 0:
            return
        for name in commands_in(help_of(command)):
            if name not in ELSEWHERE.get(tuple(words), ()):
                add(words + [name], depth - 1)

    add(["skerry"], 2)
    return made


def make(name, command, folder, version):
    section = 8 if name in SECTION_8 else 1
    text = help_of(command)
    about = text.lstrip().splitlines()[0].rstrip(".")
    about = about[0].lower() + about[1:] if about[:2] != about[:2].upper() else about
    with tempfile.TemporaryDirectory() as scratch:
        # help2man names the page after the file that it runs.
        runner = os.path.join(scratch, name)
        with open(runner, "w", encoding="utf-8") as file:
            # The usage begins with the name that a program was run by: not with the builder's path.
            name_of_program = os.path.basename(command[0])
            file.write(f"#!/bin/bash\nexec -a '{name_of_program}' " + " ".join(f"'{word}'" for word in command) + ' "$@"\n')
        os.chmod(runner, 0o755)
        more = os.path.join(scratch, "more")
        with open(more, "w", encoding="utf-8") as file:
            file.write(SEE_ALSO)
        page = os.path.join(folder, f"{name}.{section}")
        subprocess.run(["help2man", "--no-info", f"--section={section}", f"--name={about}", "--manual=Skerry",
                        f"--source=skerry {version}", f"--version-string={version}", f"--include={more}",
                        f"--output={page}", runner], check=True)
    with open(page, encoding="utf-8") as file:
        text = file.read()
    # help2man makes a paragraph of examples; each is a line.
    text = re.sub(r"^\.IP\n((?:(?!\.).*\n)+)", r".IP\n.nf\n\1.fi\n", text, flags=re.M)
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--list", action="store_true")
    options.add_argument("programs")
    options.add_argument("folder", nargs="?", default=".")
    given = options.parse_args()
    programs = os.path.abspath(given.programs)
    wanted = pages(programs)
    if given.list:
        for name, _ in wanted:
            print(f"{name}.{8 if name in SECTION_8 else 1}")
        return
    said = subprocess.run([os.path.join(programs, "skerry"), "--version"], capture_output=True, text=True, check=True)
    version = said.stdout.split()[-1]
    admin = os.path.join(os.path.dirname(os.path.abspath(__file__)), "skerry-admin")
    wanted.append(("skerry-admin", [admin]))
    os.makedirs(given.folder, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for done in [pool.submit(make, name, command, given.folder, version) for name, command in wanted]:
            done.result()


main()
