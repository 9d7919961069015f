#!/usr/bin/python3
"""Writes a bill of materials (SPDX 2.3, JSON): what programs and libraries are linked with, and were built with.

Usage: sbom.py --name NAME --version VERSION --built-with PACKAGES.TXT... FILE... >NAME.spdx.json

Of each FILE (a program or shared library) the libraries it needs are looked up with ldd, and the Debian packages that
own them with dpkg-query.  Headers and tools are the packages of the lists that the build was made with.  The time is
SOURCE_DATE_EPOCH, so the same build gives the same bytes.
"""
import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
import time
import uuid


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def libraries_of(file):
    """Paths of the shared libraries that the file names itself; what those need is theirs."""
    needed = set(re.findall(r"\(NEEDED\).*\[(.+)\]", output_of("readelf", "--wide", "-d", file)))
    found = dict(re.findall(r"^\s*(\S+) => (/\S+)", output_of("ldd", file), re.M))
    return [os.path.realpath(found[name]) for name in sorted(needed) if name in found]


def owner_of(path):
    # A library of /lib is listed under the name that it had before /usr was merged.
    for name in (path, path.removeprefix("/usr")):
        run = subprocess.run(["dpkg-query", "-S", name], capture_output=True, text=True, check=False)
        if run.returncode == 0:
            return run.stdout.split(":")[0]
    return None


def listed(files):
    for name in files:
        with open(name, encoding="utf-8") as file:
            for line in file:
                if line.split("#")[0].strip():
                    yield line.split("#")[0].strip()


def licence_of(package):
    """The licence of most of the package, where its copyright file is machine-readable and SPDX knows the word."""
    known = {"Apache-2.0", "BSD-2-clause", "BSD-3-clause", "BSL-1.0", "Expat", "GPL-2+", "GPL-3+", "LGPL-2+", "LGPL-2.1",
             "LGPL-2.1+", "LGPL-3+", "MIT", "MPL-2.0", "Zlib", "CC0", "ISC"}
    spdx = {"BSD-2-clause": "BSD-2-Clause", "BSD-3-clause": "BSD-3-Clause", "Expat": "MIT", "GPL-2+": "GPL-2.0-or-later",
            "GPL-3+": "GPL-3.0-or-later", "LGPL-2+": "LGPL-2.0-or-later", "LGPL-2.1": "LGPL-2.1-only",
            "LGPL-2.1+": "LGPL-2.1-or-later", "LGPL-3+": "LGPL-3.0-or-later", "CC0": "CC0-1.0"}
    try:
        with open(f"/usr/share/doc/{package}/copyright", encoding="utf-8", errors="replace") as file:
            text = file.read()
    except OSError:
        return "NOASSERTION"
    found = re.search(r"^Files: *\*\s*\n(?:.+\n)*?License: *(\S+) *$", text, re.M)
    word = found[1] if found else ""
    return spdx.get(word, word) if word in known else "NOASSERTION"


def entry(package):
    shown = output_of("dpkg-query", "-W", "-f=${Version}\t${Architecture}\t${source:Package}\t${source:Version}\n", package)
    version, architecture, source, source_version = shown.splitlines()[0].split("\t")
    return {
        "SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", package),
        "name": package,
        "versionInfo": version,
        "supplier": "Organization: Debian",
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": licence_of(package),
        "copyrightText": "NOASSERTION",
        "sourceInfo": f"built from Debian source package {source} {source_version}",
        "externalRefs": [{
            "referenceCategory": "PACKAGE-MANAGER",
            "referenceType": "purl",
            "referenceLocator": f"pkg:deb/debian/{package}@{version.replace(':', '%3A').replace('+', '%2B')}?arch={architecture}",
        }],
    }


def installed(package):
    run = subprocess.run(["dpkg-query", "-W", "-f=${db:Status-Status}", package], capture_output=True, text=True, check=False)
    return run.returncode == 0 and run.stdout.startswith("installed")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--name", required=True)
    options.add_argument("--version", required=True)
    options.add_argument("--built-with", action="append", default=[])
    options.add_argument("files", nargs="+")
    given = options.parse_args()
    linked = {owner_of(library) for file in given.files for library in libraries_of(file)}
    if None in linked:
        sys.exit("sbom.py: a library that a program needs belongs to no Debian package; see ldd")
    built_with = {package for package in listed(given.built_with) if installed(package)} - linked
    top = {
        "SPDXID": "SPDXRef-Package",
        "name": given.name,
        "versionInfo": given.version,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "Apache-2.0",
        "licenseDeclared": "Apache-2.0",
        "copyrightText": "NOASSERTION",
    }
    entries = {package: entry(package) for package in sorted(linked | built_with)}
    relations = [("SPDXRef-DOCUMENT", "DESCRIBES", "SPDXRef-Package")]
    relations += [("SPDXRef-Package", "DYNAMIC_LINK", entries[package]["SPDXID"]) for package in sorted(linked)]
    relations += [(entries[package]["SPDXID"], "BUILD_DEPENDENCY_OF", "SPDXRef-Package") for package in sorted(built_with)]
    packages = [top] + list(entries.values())
    digest = hashlib.sha256(json.dumps(packages, sort_keys=True).encode()).hexdigest()
    now = time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())))
    document = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"{given.name}-{given.version}",
        "documentNamespace": f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, digest)}",
        "creationInfo": {
            "created": time.strftime("%Y-%m-%dT%H:%M:%SZ", now),
            "creators": ["Tool: skerry-sbom"],
        },
        "packages": packages,
        "relationships": [
            {"spdxElementId": one, "relationshipType": how, "relatedSpdxElement": other} for one, how, other in relations
        ],
    }
    json.dump(document, sys.stdout, indent=1)
    print()


main()
