#!/usr/bin/python3
"""Makes an image of the Open Container Initiative (image-spec 1.0) of a root file system, as one archive.

Usage: oci_image.py [OPTIONS] ROOT.TAR IMAGE.TAR COMMAND...

One layer, compressed; times are SOURCE_DATE_EPOCH, so the same root gives the same bytes.
"""
import argparse
import gzip
import hashlib
import io
import json
import os
import shutil
import tarfile
import tempfile
import time

EPOCH = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))


def sum_of(file):
    digest = hashlib.sha256()
    file.seek(0)
    while chunk := file.read(1 << 20):
        digest.update(chunk)
    return digest.hexdigest()


def add(archive, name, file):
    entry = tarfile.TarInfo(name)
    entry.size = file.seek(0, io.SEEK_END)
    entry.mtime = EPOCH
    entry.mode = 0o644
    file.seek(0)
    archive.addfile(entry, file)


def add_json(archive, value, name=None):
    """As a blob, or under its own name; gives its descriptor's digest and size."""
    data = json.dumps(value, sort_keys=True).encode()
    digest = hashlib.sha256(data).hexdigest()
    add(archive, name or f"blobs/sha256/{digest}", io.BytesIO(data))
    return {"digest": f"sha256:{digest}", "size": len(data)}


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--name", required=True)
    options.add_argument("--architecture", required=True)
    options.add_argument("--user", required=True)
    options.add_argument("--workdir", required=True)
    options.add_argument("--volume", action="append", default=[])
    options.add_argument("--stop-signal", required=True)
    options.add_argument("root")
    options.add_argument("image")
    options.add_argument("command", nargs=argparse.REMAINDER)
    given = options.parse_args()
    with open(given.root, "rb") as root, tempfile.TemporaryFile() as layer, tarfile.open(given.image, "w") as archive:
        uncompressed = sum_of(root)
        root.seek(0)
        with gzip.GzipFile(fileobj=layer, mode="wb", compresslevel=6, mtime=0, filename="") as packed:
            shutil.copyfileobj(root, packed, 1 << 20)
        digest = sum_of(layer)
        add(archive, f"blobs/sha256/{digest}", layer)
        created = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(EPOCH))
        config = {
            "created": created,
            "architecture": given.architecture,
            "os": "linux",
            "config": {
                "User": given.user,
                "WorkingDir": given.workdir,
                "Volumes": {volume: {} for volume in given.volume},
                "StopSignal": given.stop_signal,
                "Env": ["PATH=/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL=C.UTF-8"],
                "Cmd": given.command,
            },
            "rootfs": {"type": "layers", "diff_ids": [f"sha256:{uncompressed}"]},
            "history": [{"created": created, "created_by": "server/packaging/build-container"}],
        }
        kind = "application/vnd.oci.image."
        manifest = {
            "schemaVersion": 2,
            "mediaType": kind + "manifest.v1+json",
            "config": {"mediaType": kind + "config.v1+json", **add_json(archive, config)},
            "layers": [{"mediaType": kind + "layer.v1.tar+gzip", "digest": f"sha256:{digest}",
                        "size": layer.seek(0, io.SEEK_END)}],
        }
        entry = {"mediaType": kind + "manifest.v1+json", **add_json(archive, manifest),
                 "annotations": {"org.opencontainers.image.ref.name": given.name}}
        add_json(archive, {"schemaVersion": 2, "manifests": [entry]}, "index.json")
        add_json(archive, {"imageLayoutVersion": "1.0.0"}, "oci-layout")


main()
