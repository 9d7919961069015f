#!/usr/bin/python3
"""Makes debian/ in a copy of the project: server/packaging/deb, what the lists of packages say, and the changes.

Usage: debian_folder.py SOURCE_FOLDER      The folder holds the project and is changed.
"""
import datetime
import os
import re
import shutil
import sys
import textwrap

MAINTAINER = "Skerry maintainers <maintainers@skerry.example>"
# Of server/packages.txt: what every build has, and what only a running server needs.
NOT_TO_BUILD = {"g++", "gmt-gshhg-full"}
PAGES = (".md", ".proto", ".png")  # the documentation's files


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def write(text, *path):
    with open(os.path.join(*path), "w", encoding="utf-8") as file:
        file.write(text)


def listed(text):
    return [line.split("#")[0].strip() for line in text.splitlines() if line.split("#")[0].strip()]


def changelog(page, version):
    """Debian's form of CHANGELOG.md.  Error: its newest version is not that of the project."""
    versions = re.findall(r"^## (\S+), (\d{4}-\d\d-\d\d)\n(.*?)(?=^## |\Z)", page, re.M | re.S)
    if not versions or versions[0][0] != version:
        sys.exit(f"server/packaging/CHANGELOG.md: its newest version is {versions[0][0] if versions else 'none'}, "
                 f"that of CMakeLists.txt {version}; they must be the same")
    text = ""
    for number, date, points in versions:
        when = datetime.datetime.strptime(date, "%Y-%m-%d").strftime("%a, %d %b %Y 12:00:00 +0000")
        text += f"skerry ({number}) bookworm; urgency=medium\n\n"
        for point in re.findall(r"^- (.*?)(?=^- |\Z)", points, re.M | re.S):
            text += textwrap.fill(" ".join(point.split()), 76, initial_indent="  * ", subsequent_indent="    ") + "\n"
        text += f"\n -- {MAINTAINER}  {when}\n\n"
    return text.rstrip("\n") + "\n"


def pages(source):
    """Lines of an install list: each page into the folder that it has in the project."""
    lines = []
    for folder, folders, files in os.walk(source):
        folders[:] = sorted(name for name in folders if name not in ("debian", "node_modules", "corpus"))
        place = os.path.relpath(folder, source)
        if place.startswith("tests/") and "unit" in place:
            continue
        for name in sorted(files):
            if name.endswith(PAGES) and " " not in name:
                lines.append(f"{os.path.normpath(os.path.join(place, name))} usr/share/doc/skerry/{place}".rstrip("/."))
    return "\n".join(lines) + "\n"


def main(source):
    packaging = os.path.join(source, "server", "packaging")
    debian = os.path.join(source, "debian")
    shutil.copytree(os.path.join(packaging, "deb"), debian)
    os.remove(os.path.join(debian, "control.in"))
    shutil.copy(os.path.join(packaging, "skerryd.service"), debian)
    needed = set(listed(text_of(source, "server", "packages.txt")) + listed(text_of(packaging, "packages.txt")))
    needed = sorted(needed - NOT_TO_BUILD - {"dpkg-dev", "fakeroot"} - {"debhelper"})
    control = text_of(packaging, "deb", "control.in")
    control = control.replace("@MAINTAINER@", MAINTAINER)
    control = control.replace("@BUILD_DEPENDS@", ",\n ".join(["debhelper-compat (= 13)"] + needed))
    write(control, debian, "control")
    version = re.search(r"project\(skerry VERSION ([0-9.]+)", text_of(source, "CMakeLists.txt"))[1]
    write(changelog(text_of(packaging, "CHANGELOG.md"), version), debian, "changelog")
    os.makedirs(os.path.join(debian, "source"))
    write("3.0 (native)\n", debian, "source", "format")
    write(pages(source), debian, "skerry-doc.install")


if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
    sys.exit(__doc__)
main(sys.argv[1])
