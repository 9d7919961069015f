#!/usr/bin/python3
"""The short test of server/packaging: what can be seen without making packages (tests/packaging/run makes them).

Usage: packaging_test.py SOURCE_FOLDER BUILD_FOLDER [CASE...]
"""
import fnmatch
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
BUILD = pathlib.Path(sys.argv[2]).resolve()
PACKAGING = SOURCE / "server/packaging"
PROGRAMS = BUILD / "bin"
MOST_EXPOSED = 1.5  # of systemd-analyze security, from 0 (nothing) to 10 (everything)


def run(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **more)
    return done.returncode, done.stdout, done.stderr


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Unit(WithFolder):
    def analyze(self, *words):
        if shutil.which("systemd-analyze") is None:
            self.fail("systemd-analyze is missing; tests/packages.txt lists its package")
        return run("systemd-analyze", *words)

    # With the program of this build: that of the package is not installed here.
    def unit(self, **instead):
        text = (PACKAGING / "skerryd.service").read_text().replace("/usr/bin/skerryd", str(PROGRAMS / "skerryd"))
        for key, value in instead.items():
            text = re.sub(rf"^{key}=.*$", f"{key}={value}", text, flags=re.M)
        file = self.folder / "skerryd.service"
        file.write_text(text)
        return file

    def test_is_understood_by_systemd(self):
        code, out, err = self.analyze("verify", "--man=no", self.unit())
        self.assertEqual((code, out + err), (0, ""))

    def test_a_misspelt_key_is_found(self):
        file = self.unit()
        file.write_text(file.read_text().replace("ProtectHome=", "ProtectHouse="))
        self.assertIn("ProtectHouse", "".join(self.analyze("verify", "--man=no", file)[1:]))

    def exposure(self, file):
        code, out, err = self.analyze("security", "--offline=true", f"--threshold={MOST_EXPOSED * 10:.0f}", "--no-pager", file)
        found = re.search(r"Overall exposure level for skerryd.service: ([0-9.]+)", out)
        self.assertTrue(found, out + err)
        return float(found[1]), code

    def test_exposes_little(self):
        level, code = self.exposure(self.unit())
        print(f"systemd-analyze security: {level}, at most {MOST_EXPOSED}")
        self.assertLessEqual(level, MOST_EXPOSED)
        self.assertEqual(code, 0)
        self.assertGreater(self.exposure(self.unit(RestrictNamespaces="no"))[0], level)

    # It goes before other programs by setpriority, which the set @resources would take.
    def test_leaves_it_its_priority(self):
        text = (PACKAGING / "skerryd.service").read_text()
        self.assertLess(text.index("SystemCallFilter=~@privileged @resources"), text.index("SystemCallFilter=setpriority"))
        self.assertIn("SystemCallErrorNumber=EPERM", text)
        self.assertIn("LimitNICE=-10", text)
        niceness = re.search(r"kRadarNiceness = (-\d+)", (SOURCE / "server/radar/thread_priority.hpp").read_text())
        self.assertEqual(niceness and niceness[1], "-10")


class Configuration(unittest.TestCase):
    def test_of_the_service_is_good(self):
        code, out, err = run(PROGRAMS / "skerryd", "--config", PACKAGING / "skerryd.yaml", "--check")
        self.assertEqual(code, 0, out + err)

    # What stands behind a # as an example can be uncommented.
    def test_of_the_service_has_good_examples(self):
        keys = set(self.keys())
        for line in (PACKAGING / "skerryd.yaml").read_text().splitlines():
            example = re.match(r"( *)# ([a-z_]+): ", line)
            if example:
                prefix = "recorder." if example[1] else ""
                self.assertTrue({prefix + example[2], prefix + example[2] + "[]"} & keys, line)

    def test_serves_the_own_host_alone(self):
        self.assertIn("\nbind: 127.0.0.1\n", (PACKAGING / "skerryd.yaml").read_text())

    def keys(self):
        code, out, err = run(PACKAGING / "config_page.py", "--keys", SOURCE)
        self.assertEqual(code, 0, err)
        return out.splitlines()

    def test_page_has_every_key_of_the_schema(self):
        keys = self.keys()
        self.assertEqual(len(keys), len(set(keys)))
        schema = re.sub(r"//.*", "", (SOURCE / "server/app/config.proto").read_text())
        for field in set(re.findall(r"^\s*(?:optional |repeated )?[\w.]+ (\w+) = \d+[ ;\[]", schema, re.M)):
            self.assertIn(field, {key.split(".")[-1].removesuffix("[]") for key in keys})
        code, page, err = run(PACKAGING / "config_page.py", SOURCE)
        self.assertEqual(code, 0, err)
        self.assertIn("\\fBhttp_port\\fR (whole number from 0 to 65535)", page)
        self.assertIn("\\fBnavico_halo\\fR", page)
        # The same bytes for the same time.
        twice = {run(PACKAGING / "config_page.py", SOURCE, env=dict(os.environ, SOURCE_DATE_EPOCH="1764000000"))[1] for _ in "ab"}
        self.assertEqual(len(twice), 1)
        self.assertIn('"2025-11-24"', twice.pop())


def takes(pattern, name):
    """Whether a line of an install list takes a file: it, or a folder above it."""
    wanted, parts = pattern.split("/"), name.split("/")
    return len(parts) >= len(wanted) and all(fnmatch.fnmatchcase(*pair) for pair in zip(parts, wanted))


class Lists(WithFolder):
    def patterns(self):
        """What the install lists take of what CMake installs."""
        lines = [line for file in (PACKAGING / "deb").glob("*.install") for line in file.read_text().splitlines()]
        return {line for line in lines if line.startswith("usr/")}

    def test_have_each_installed_file_once(self):
        code, out, err = run("cmake", "--install", BUILD, "--prefix", self.folder / "usr")
        self.assertEqual(code, 0, err)
        patterns = self.patterns()
        unused = set(patterns)
        for file in sorted(self.folder.rglob("*")):
            if file.is_dir():
                continue
            name = str(file.relative_to(self.folder))
            # Debian has libraries in a folder of the machine's kind; a build for /usr/local does not.
            names = {name, name.replace("usr/lib/", "usr/lib/machine/", 1)}
            owners = {pattern for pattern in patterns for each in names if takes(pattern, each)}
            self.assertEqual(len(owners), 1, f"{name} is in the lists {sorted(owners)} of server/packaging/deb; it must be in one")
            unused -= owners
        self.assertEqual(unused, set(), "nothing is installed that these lists of server/packaging/deb take")

    def test_of_symbols_are_those_of_the_libraries(self):
        for name in ("echo", "board"):
            library = next(BUILD.glob(f"*/*/libskerry_{name}.so"))
            code, out, err = run("nm", "--dynamic", "--defined-only", library)
            self.assertEqual(code, 0, err)
            exported = {line.split()[2].split("@")[0] for line in out.splitlines()}
            listed = set(re.findall(r"^ (\w+)@", (PACKAGING / f"deb/libskerry-{name}1.symbols").read_text(), re.M))
            self.assertEqual(exported, listed, f"server/packaging/deb/libskerry-{name}1.symbols is not what is exported")


class Folder(WithFolder):
    def test_is_made_with_the_version_of_the_project(self):
        code, out, err = run(PACKAGING / "build-packages", "--folder-only", "--into", self.folder)
        self.assertEqual(code, 0, err)
        debian = pathlib.Path(out.strip()) / "debian"
        version = re.search(r"project\(skerry VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        self.assertTrue((debian / "changelog").read_text().startswith(f"skerry ({version}) "))
        control = (debian / "control").read_text()
        self.assertNotIn("@", control.replace("maintainers@", ""))
        for file in (debian.glob("*.install")):
            self.assertRegex(control, rf"(?m)^Package: {re.escape(file.stem)}$")
        for package in (SOURCE / "server/packages.txt").read_text().split("\n"):
            if package.startswith("lib"):
                self.assertIn(f" {package}", control)

    def test_is_refused_without_a_word_on_the_newest_version(self):
        copy = self.folder / "copy"
        for file in ("CMakeLists.txt", "server/packages.txt"):
            (copy / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / file, copy / file)
        shutil.copytree(PACKAGING, copy / "server/packaging")
        page = copy / "server/packaging/CHANGELOG.md"
        page.write_text(re.sub(r"^## \S+,", "## 0.0.1,", page.read_text(), count=1, flags=re.M))
        code, _, err = run(PACKAGING / "debian_folder.py", copy)
        self.assertEqual(code, 1)
        self.assertIn("its newest version is 0.0.1", err)


class Pages(unittest.TestCase):
    def test_are_made_of_every_program_and_command(self):
        code, out, err = run(PACKAGING / "man_pages.py", "--list", PROGRAMS)
        self.assertEqual(code, 0, err)
        pages = out.split()
        self.assertEqual(len(pages), len(set(pages)))
        for line in (PACKAGING / "deb/skerry-tools.install").read_text().splitlines():
            if line.startswith("usr/bin/"):
                self.assertIn(line.removeprefix("usr/bin/") + ".1", pages)
        for page in ("skerryd.1", "skerry-status.1", "skerry-recording-cut.1", "skerry-user-add.1", "skerry-exercise-report.1"):
            self.assertIn(page, pages)


class Completion(unittest.TestCase):
    def completed(self, *words):
        script = f"""
            PATH={PROGRAMS}:$PATH
            source {PACKAGING}/skerry.bash-completion
            COMP_WORDS=({' '.join(f"'{word}'" for word in words)})
            COMP_CWORD={len(words) - 1}
            _skerry
            printf '%s\\n' "${{COMPREPLY[@]}}" """
        code, out, err = run("bash", "--norc", "-c", script)
        self.assertEqual((code, err), (0, ""))
        return out.split()

    def test_knows_commands_and_options(self):
        self.assertEqual(self.completed("skerry", "rec"), ["record", "recording"])
        self.assertEqual(self.completed("skerry", "recording", "c"), ["cut", "cat"])
        self.assertEqual(self.completed("skerry", "status", "--js"), ["--json"])
        self.assertIn("--role", self.completed("skerry", "token", "new", "--r"))
        self.assertIn("--record-roll-mib", self.completed("skerryd", "--record-r"))

    # A file or a name that was typed is given to no program.
    def test_runs_only_what_is_a_command(self):
        self.assertEqual(self.completed("skerry", "recording", "info", "play", "--js"), ["--json"])
        self.assertEqual(self.completed("skerry", "; echo hacked >&2", "stat"), ["status"])


class Materials(unittest.TestCase):
    def test_are_listed_in_spdx(self):
        code, out, err = run(PACKAGING / "sbom.py", "--name", "skerryd", "--version", "0.1.0", "--built-with",
                             SOURCE / "server/packages.txt", PROGRAMS / "skerryd")
        self.assertEqual(code, 0, err)
        bill = json.loads(out)
        self.assertEqual(bill["spdxVersion"], "SPDX-2.3")
        names = {package["name"] for package in bill["packages"]}
        self.assertLessEqual({"skerryd", "libprotobuf32", "libgdal32", "libc6", "libboost-dev"}, names)
        ids = {package["SPDXID"] for package in bill["packages"]} | {"SPDXRef-DOCUMENT"}
        for relation in bill["relationships"]:
            self.assertLessEqual({relation["spdxElementId"], relation["relatedSpdxElement"]}, ids)
        for package in bill["packages"]:
            self.assertRegex(package["SPDXID"], r"^SPDXRef-[A-Za-z0-9.-]+$")


class Admin(unittest.TestCase):
    def test_says_what_it_lacks(self):
        code, out, err = run(PACKAGING / "skerry-admin")
        self.assertEqual((code, err), (0, ""))
        self.assertIn("Usage: skerry-admin COMMAND", out)
        if not os.path.exists("/var/lib/skerry") and os.getuid() == 0:
            code, out, err = run(PACKAGING / "skerry-admin", "user", "list")
            self.assertEqual(code, 1)
            self.assertIn("/var/lib/skerry is not there; start the service once: systemctl start skerryd", err)


unittest.main(argv=[sys.argv[0]] + sys.argv[3:], verbosity=2)
