#!/usr/bin/env python3
"""Shows that a sweep gives the same result however it is carried out.

  tests/experiments/show_sweep.py build/vitruvia configs/ablations/terms_sweep.json FOLDER

One after the other, each into a folder of its own below FOLDER (which must be new):
  killed     kill -9 after 3, 9 and 20 finished runs, each time gone on with, then to its end
  shards     two processes with --shard 1/2 and 2/2 at the same time
  single     one run at a time, the sequences made before
  jobs       two at a time (-j 2); prints how much faster that was, and
             with the report, whose drawing takes both cores either way
Then compares summaries and records of all, but for what a clock or the memory's gauge says. Ends with 1 on a difference.
The speed-up means something only on a machine with nothing else to do.
"""
import json
import os
import signal
import subprocess
import sys
import time

CLOCK = {"frame_ms", "frame_ms_median", "frame_ms_p95", "frame_ms_max", "steps", "provenance",
         "tracker_memory_mb"}


def without_clock(value):
    if isinstance(value, dict):
        return {key: without_clock(item) for key, item in value.items() if key not in CLOCK}
    return [without_clock(item) for item in value] if isinstance(value, list) else value


def result(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        summary = json.load(file)
    records = {}
    for row in summary["rows"]:
        with open(os.path.join(folder, row["run_id"], "record.json")) as file:
            records[row["run_id"]] = json.load(file)
    return without_clock([summary, records])


def finished(folder):
    count = 0
    for name in os.listdir(folder) if os.path.isdir(folder) else []:
        status = os.path.join(folder, name, "status")
        if os.path.isfile(status):
            with open(status) as file:
                count += file.read().startswith("done")
    return count


def main():
    program, config, top = sys.argv[1:4]
    os.makedirs(top)

    def start(name, *options):
        log = open(os.path.join(top, name + ".log"), "a")
        return subprocess.Popen([program, "run", config, "-o", os.path.join(top, name), *options],
                                stdout=log, stderr=log, start_new_session=True)

    def timed(name, *options):
        begin = time.time()
        code = start(name, *options).wait()
        whole = time.time() - begin
        # The summary is written when the last run has ended, before the report is drawn.
        runs = os.path.getmtime(os.path.join(top, name, "summary.json")) - begin
        load = os.getloadavg()[0]
        print(f"{name}: exit code {code}, runs {runs:.1f} s, with the report {whole:.1f} s, "
              f"load average {load:.1f}", flush=True)
        return runs, whole

    killed = os.path.join(top, "killed")
    for enough in (3, 9, 20):
        process = start("killed", "-j", "2")
        while finished(killed) < enough:
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
        print(f"killed: with {finished(killed)} runs done", flush=True)
    timed("killed", "-j", "2")

    shards = [start("shards", "--shard", f"{i}/2") for i in (1, 2)]
    print("shards: exit codes", [shard.wait() for shard in shards])

    print(f"load average before: {os.getloadavg()[0]:.1f}")
    single = timed("single")
    jobs = timed("jobs", "-j", "2")
    print(f"two jobs are {single[0] / jobs[0]:.2f} times as fast as one, "
          f"{single[1] / jobs[1]:.2f} times with the report")

    expected = result(os.path.join(top, "single"))
    same = True
    for name in ("jobs", "killed", "shards"):
        equal = result(os.path.join(top, name)) == expected
        same = same and equal
        print(f"{name}: {len(expected[1])} runs, {'identical' if equal else 'DIFFERENT'}")
    sys.exit(0 if same else 1)


main()
