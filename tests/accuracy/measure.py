"""Measures the accuracy of the service and writes docs/accuracy.md.

A server is started on a free port with a store of its own, meshes are ingested
and searched with the command line, as a user would. Everything made lies in a
work folder named after the server's binary: started again, a run goes on with
the first row that is not there yet.
"""

import argparse
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import report
import rows

ROOT = pathlib.Path(__file__).resolve().parents[2]
START_SECONDS = 20


def say(text):
    print(f"[{time.strftime('%H:%M:%S')}] {text}", file=sys.stderr, flush=True)


class Server:
    """argmeshd on a free loopback port, stopped at the end of a `with`."""

    def __init__(self, binaries, work):
        self._binaries = binaries
        self._work = work
        self._process = None

    def __enter__(self):
        try:
            return self._start()
        except BaseException:
            self.__exit__()
            raise

    def _start(self):
        address = self._work / "address"
        address.unlink(missing_ok=True)
        with open(self._work / "server.log", "ab") as log:
            self._process = subprocess.Popen(
                [self._binaries / "argmeshd", "--data", self._work / "store",
                 "--listen", "127.0.0.1:0", "--port-file", address],
                stdout=log, stderr=log)
        for _ in range(START_SECONDS * 10):
            if address.exists() and address.read_text():
                self.address = address.read_text().strip()
                return self
            if self._process.poll() is not None:
                break
            time.sleep(0.1)
        raise RuntimeError(f"the server did not start: {log.name}")

    def __exit__(self, *unused):
        if self._process:
            self._process.terminate()
            self._process.wait()


class Measurement:
    def __init__(self, binaries, data, work):
        self._binaries = binaries
        self._data = data
        self._work = work
        self._ready = set()  # collections

    def results(self):
        """Row key -> result, of the rows measured so far."""
        found = {}
        for row in rows.ROWS:
            path = self._result_path(row)
            if path.exists():
                found[row.key] = json.loads(path.read_text())
        return found

    def measure(self, row, server):
        self._ingest(row.collection, server)
        command = ["evaluate", "--collection", row.collection, *row.arguments]
        if row.queries:
            command += ["--queries", self._changed(row.queries) / "queries.tsv"]
        result = self._argmesh(server, *command, json_output=True)
        # Written in one step: half a result would count as measured.
        path = self._result_path(row)
        path.with_suffix(".new").write_text(json.dumps(result))
        path.with_suffix(".new").rename(path)
        return result

    def _result_path(self, row):
        # Other queries, another result.
        every = f"-{rows.CHANGES[row.queries][2]}" if row.queries else ""
        return self._work / f"{row.key}{every}.json"

    def _argmesh(self, server, *command, json_output=False):
        extra = ["--json"] if json_output else []
        done = subprocess.run(
            [self._binaries / "argmesh", *extra, "--server", server.address,
             "--timeout", "600", *map(str, command)],
            stdout=subprocess.PIPE)
        # 1: some files or queries failed; they are in the answer.
        if done.returncode not in (0, 1):
            raise RuntimeError(f"argmesh {command[0]} failed")
        return json.loads(done.stdout) if json_output else None

    def _ingest(self, name, server):
        if name in self._ready:
            return
        collection = rows.COLLECTIONS[name]
        folder = self._data / collection.source
        if collection.variant:
            folder = self._variants(name, collection.source,
                                    collection.variant, 1)
        say(f"ingesting {name}")
        self._argmesh(server, "ingest", "--collection", name, "--labels",
                      folder / "labels.tsv", folder)
        for more in collection.more:
            # The folder above, so that sources are called `null/cat.off`.
            self._ingest_unlabelled(name, self._data / more, server)
        self._ready.add(name)

    def _ingest_unlabelled(self, name, folder, server):
        lone = self._work / f"{name}-more"
        lone.mkdir(exist_ok=True)
        link = lone / folder.name
        if not link.exists():
            link.mkdir()
            for mesh in folder.iterdir():
                (link / mesh.name).write_bytes(mesh.read_bytes())
        self._argmesh(server, "ingest", "--collection", name, lone)

    def _changed(self, name):
        folder, options, every = rows.CHANGES[name]
        return self._variants(name, folder, options, every)

    def _variants(self, name, folder, options, every):
        out = self._work / "variants" / f"{name}-{every}"
        if not (out / "complete").exists():
            say(f"changing meshes: {name}")
            subprocess.run(
                [self._binaries / "make_variants", self._data / folder, out,
                 "--every", str(every), *options], check=True)
            (out / "complete").touch()
        return out


def digest_of(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()[:12]


def parse_arguments():
    parser = argparse.ArgumentParser(
        prog="./run accuracy", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true",
                        help="only the rows of the first collection")
    parser.add_argument("--report-only", action="store_true",
                        help="write the page from what is measured already")
    parser.add_argument("--binaries", type=pathlib.Path,
                        default=ROOT / "build/release/bin")
    parser.add_argument("--work", type=pathlib.Path,
                        default=ROOT / "build/accuracy")
    parser.add_argument("--out", type=pathlib.Path,
                        default=ROOT / "docs/accuracy.md")
    parser.add_argument(
        "--data", type=pathlib.Path,
        default=os.environ.get("ARGMESH_DATA_DIR"),
        help="folders shrec07_dev, psb_train, shrec16_cuts_dev; default: "
        "ARGMESH_DATA_DIR")
    arguments = parser.parse_args()
    if arguments.data is None or not arguments.data.is_dir():
        parser.error("no data: set ARGMESH_DATA_DIR")
    return arguments


def measure_all(measurement, server, quick):
    wanted = [row for row in rows.ROWS if row.quick or not quick]
    done = measurement.results()
    for number, row in enumerate(wanted, 1):
        if row.key in done:
            continue
        result = measurement.measure(row, server)
        say(f"{number} of {len(wanted)}: {row.key}  NN {result['nn']:.3f}  "
            f"FT {result['ft']:.3f}  in {result['seconds']:.0f} s")


def main():
    # Ended from outside, it ends its server.
    signal.signal(signal.SIGTERM, lambda *unused: sys.exit("ended"))
    arguments = parse_arguments()
    work = arguments.work / digest_of(arguments.binaries / "argmeshd")
    work.mkdir(parents=True, exist_ok=True)
    measurement = Measurement(arguments.binaries, arguments.data, work)
    if not arguments.report_only:
        with Server(arguments.binaries, work) as server:
            measure_all(measurement, server, arguments.quick)
    arguments.out.write_text(report.render(measurement.results()))
    say(f"wrote {arguments.out}")


if __name__ == "__main__":
    main()
