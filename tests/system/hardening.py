#!/usr/bin/env python3
"""Reads in programs and libraries what the build promises of hardening, as checksec does; prints a table.

Usage: hardening.py FILE...   Exit code 1 if one of them lacks something.

Expected of each (GCC manual, "Instrumentation Options"; ld manual, "-z keyword"): position independent; relocations
read-only and bound at the start (full RELRO); a stack that is not executable; a stack protector; at least one function
of libc in its checked form (_FORTIFY_SOURCE); on x86 endbr64 where code can be jumped to (CET), seen in the code itself:
the linker marks a program only if libc's startup files are marked too, and Debian 12's are not; no search path of its
own for libraries.
"""
import platform
import re
import subprocess
import sys
import tempfile


def readelf(file):
    run = subprocess.run(["readelf", "--wide", "-h", "-l", "-d", "-n", "--dyn-syms", file], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"hardening.py: {file} cannot be read: {run.stderr.strip()}")
    return run.stdout


# Functions of the file's own code that begin with endbr64.  A few come with libgcc, whatever the flags are.
def landing_places(file):
    with tempfile.NamedTemporaryFile() as text:
        subprocess.run(["objcopy", "--output-target=binary", "--only-section=.text", file, text.name], check=True)
        with open(text.name, "rb") as code:
            return code.read().count(b"\xf3\x0f\x1e\xfa")


def findings(file):
    text = readelf(file)
    stack = re.search(r"GNU_STACK.*", text)
    found = {
        "PIE": re.search(r"Type:\s+DYN", text) is not None,
        "RELRO": "GNU_RELRO" in text and re.search(r"\(FLAGS(_1)?\).*NOW", text) is not None,
        "stack not executable": stack is not None and "RWE" not in stack.group(),
        "stack protector": "__stack_chk_fail" in text,
        "FORTIFY": re.search(r"__\w+_chk@", text.replace("__stack_chk_fail@", "")) is not None,
        "no RPATH": re.search(r"\((RPATH|RUNPATH)\)", text) is None,
    }
    if platform.machine() == "x86_64":
        found["CET"] = landing_places(file) >= 20
    return found


def main(files):
    if not files:
        sys.exit(__doc__)
    lacking = 0
    for file in files:
        found = findings(file)
        lacking += sum(not good for good in found.values())
        print(f"{file.rsplit('/', 1)[-1]:28}" + "  ".join(f"{what}: {'yes' if good else 'NO'}" for what, good in found.items()))
    if lacking:
        sys.exit(f"hardening.py: {lacking} of the above are missing; they come from SKERRY_HARDENED in CMakeLists.txt")


main(sys.argv[1:])
