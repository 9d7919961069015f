#!/usr/bin/python3
"""Makes the manual page skerry.yaml(5) of server/app/config.proto: keys, ranges, units and comments are the schema's.

Usage: config_page.py [--keys] SOURCE_FOLDER >skerry.yaml.5      --keys: only the keys, one a line
"""
import argparse
import importlib
import os
import re
import subprocess
import sys
import tempfile
import time

from google.protobuf import descriptor_pb2

SCHEMA = "server/app/config.proto"
RULES = "protocol/wire/field_rules.proto"
Field = descriptor_pb2.FieldDescriptorProto
WORDS = {
    Field.TYPE_STRING: "text",
    Field.TYPE_BOOL: "true or false",
    Field.TYPE_DOUBLE: "number",
    Field.TYPE_UINT32: "whole number",
    Field.TYPE_INT32: "whole number",
}


def described(source):
    """The schema's descriptors and the extension that holds rules."""
    for needed in (SCHEMA, RULES):
        if not os.path.isfile(os.path.join(source, needed)):
            sys.exit(f"config_page.py: {source} has no {needed}; expected the project's folder")
    with tempfile.TemporaryDirectory() as folder:
        described_in = os.path.join(folder, "config.desc")
        subprocess.run(
            ["protoc", "-I", source, "--include_source_info", "--descriptor_set_out=" + described_in,
             "--python_out=" + folder, SCHEMA, RULES], check=True)
        sys.path.insert(0, folder)
        rules = importlib.import_module("protocol.wire.field_rules_pb2")
        with open(described_in, "rb") as file:
            files = descriptor_pb2.FileDescriptorSet.FromString(file.read())
    return next(file for file in files.file if file.name == SCHEMA), rules.rule


def comments_of(file):
    """By place in the file, as descriptor.proto numbers it: the comment before and behind, as one text."""
    texts = {}
    for place in file.source_code_info.location:
        text = " ".join(each.strip() for part in (place.leading_comments, place.trailing_comments)
                        for each in part.splitlines() if each.strip())
        if text:
            texts[tuple(place.path)] = text
    return texts


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def number(value):
    return f"{value:g}" if value < 1e6 else f"{value:.0f}"


def sentence(text):
    text = text.strip()
    return text if not text or text[-1] in ".:)" else text + "."


class Page:
    def __init__(self, file, rule):
        self.file, self.rule, self.comments = file, rule, comments_of(file)
        self.messages, self.enums = {}, {}
        for index, message in enumerate(file.message_type):
            self.collect("." + file.package, message, (4, index))
        self.keys, self.lines = [], []

    def collect(self, scope, message, path):
        name = f"{scope}.{message.name}"
        self.messages[name] = (message, path)
        for index, inner in enumerate(message.nested_type):
            self.collect(name, inner, path + (3, index))
        for index, enum in enumerate(message.enum_type):
            self.enums[f"{name}.{enum.name}"] = (enum, path + (4, index))

    def holds(self, field, rule):
        if field.type == Field.TYPE_ENUM:
            text = "one of the words below"
        elif field.type == Field.TYPE_MESSAGE:
            text = "section, see below"
        else:
            text = WORDS[field.type]
        if rule.one_of:
            text += " of " + ", ".join(number(each) for each in rule.one_of)
        elif rule.HasField("min") and rule.HasField("max"):
            text += f" from {number(rule.min)} to {number(rule.max)}"
        elif rule.HasField("max"):
            text += f" up to {number(rule.max)}" if field.type == Field.TYPE_DOUBLE else f" from 0 to {number(rule.max)}"
        elif rule.HasField("min"):
            text += f" from {number(rule.min)}"
        if rule.unit:
            text += " " + rule.unit
        if field.label == Field.LABEL_REPEATED:
            text = "list; each: " + text
        if rule.required:
            text += "; required"
        return text

    def section(self, name, prefix):
        """The keys of a message, and those of its inner sections behind them."""
        message, path = self.messages[name]
        inner = []
        for index, field in enumerate(message.field):
            rule = field.options.Extensions[self.rule]
            key = prefix + field.name + ("[]" if field.label == Field.LABEL_REPEATED else "")
            self.keys.append(key)
            self.lines += [".TP", rf"\fB{roff(field.name)}\fR ({roff(self.holds(field, rule))})"]
            told = sentence(self.comments.get(path + (2, index), ""))
            if field.type == Field.TYPE_ENUM:
                enum, enum_path = self.enums[field.type_name]
                words = []
                for at, value in enumerate(enum.value):
                    why = self.comments.get(enum_path + (2, at), "").rstrip(".")
                    words.append(rf"\fB{roff(value.name)}\fR" + (f" ({roff(why)})" if why else ""))
                self.lines.append("Words: " + ", ".join(words) + ".")
            self.lines.append(roff(told) if told else r"\&")
            if field.type == Field.TYPE_MESSAGE:
                inner.append((field, key))
        for field, key in inner:
            self.lines += [".SS " + roff(key.replace("[]", ""))]
            told = self.comments.get(self.messages[field.type_name][1], "")
            self.lines += [roff(sentence(told))] if told else []
            self.section(field.type_name, key + ".")


HEAD = r""".TH SKERRY.YAML 5 "{date}" "skerry {version}" "Skerry"
.SH NAME
skerry.yaml \- configuration of the marine\-radar video server skerryd
.SH SYNOPSIS
\fBskerryd \-\-config\fR \fIFILE\fR
.br
\fI/etc/skerry/skerryd.yaml\fR
.SH DESCRIPTION
A YAML file with the keys below, each of which may be left out unless it says so.  A key that is none of them, or a
value out of its range, is an error with its line and column, and skerryd does not start.  The command line of
.BR skerryd (1)
goes before the file.  \fBskerryd \-\-config\fR \fIFILE\fR \fB\-\-check\fR says what is wrong and starts nothing.
.SH KEYS
"""
TAIL = r""".SH FILES
.TP
\fI/etc/skerry/skerryd.yaml\fR
What the service skerryd reads.
.TP
\fI/var/lib/skerry\fR
What the service writes.
.SH EXAMPLES
.nf
bind: 192.0.2.7
tls: /var/lib/skerry/tls
users: /var/lib/skerry/users.yaml
recorder: {folder: /var/lib/skerry/recordings, record: true, roll_minutes: 60}
outputs:
  \- {kind: navico_4g, interface_address: 192.0.2.7, obeys: true}
.fi
.SH "SEE ALSO"
.BR skerryd (1),
.BR skerry (1),
.BR skerry\-admin (8)
"""


def version_of(source):
    with open(os.path.join(source, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(skerry VERSION ([0-9.]+)", file.read())[1]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--keys", action="store_true")
    options.add_argument("source")
    given = options.parse_args()
    page = Page(*described(given.source))
    page.section(".skerry.app.ServerConfig", "")
    if given.keys:
        print("\n".join(page.keys))
        return
    date = time.strftime("%Y-%m-%d", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))
    head = HEAD.replace("{date}", date).replace("{version}", version_of(given.source))
    print(head + "\n".join(page.lines) + "\n" + TAIL, end="")


main()
