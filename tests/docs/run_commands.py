#!/usr/bin/env python3
"""The commands of README.md and docs/*.md: run_commands.py SOURCE PROGRAM [--run] [--slow]

Of each command in a block of sh, subcommand, options and config files are looked for. With --run
every block is also carried out, page by page, in a folder that has the checkout's files and the
program as build/vitruvia; a table of those that were not says why. A comment before a block says
what else it is: <!-- slow: REASON --> is carried out with --run --slow only, <!-- sketch: REASON -->
never, and before <!-- given: NAME --> given/NAME.sh is, which makes the files that the block takes
for granted.
"""
import os
import re
import shlex
import subprocess
import sys
import tempfile
import time

BLOCK = re.compile(r"(?:<!-- (slow|sketch|given): ([^\n]*) -->\n)?```sh\n(.*?)```", re.DOTALL)
GIVEN = os.path.join(os.path.dirname(os.path.realpath(__file__)), "given")


def blocks_of(page):
    with open(page, encoding="utf-8") as file:
        return BLOCK.findall(file.read())


def make_sandbox(source, program, folder):
    """Links to the checkout; what commands write stays in the sandbox."""
    for name in os.listdir(source):
        if name not in ("out",) and not name.startswith(("build", ".")):
            os.symlink(os.path.join(source, name), os.path.join(folder, name))
    os.mkdir(os.path.join(folder, "build"))
    os.symlink(program, os.path.join(folder, "build", "vitruvia"))


def help_of(program, words):
    return subprocess.run([program, *words, "--help"], capture_output=True, text=True).stdout


def problems_of(command, program, source):
    """What of a command's subcommand, options, files and targets there is not."""
    words = shlex.split(command, comments=True)
    if not words:
        return []
    while words[0] in ("do", "then") or re.match(r"[A-Z_]+=", words[0]):
        words = words[1:]
    if words[0] == "make":
        with open(os.path.join(source, "Makefile"), encoding="utf-8") as file:
            targets = re.findall(r"^([a-z]+):", file.read(), re.MULTILINE)
        return [w for w in words[1:] if "=" not in w and w not in targets]
    if words[0] != "build/vitruvia":
        return []
    plain = [w for w in words[1:] if not w.startswith("-")]
    depth = 2 if plain[:1] and plain[0] in ("learn", "import") else 1
    text = help_of(program, plain[:depth])
    found = [] if text else [" ".join(plain[:depth])]
    found += [w for w in words if w.startswith("-") and not re.search(
        rf"(?<![\w-]){re.escape(w.split('=')[0])}(?![\w-])", text)]
    return found + [w for w in plain if w.startswith("configs/")
                    and not os.path.exists(os.path.join(source, w))]


def carried_out(page, block, given, folder):
    """What went wrong: a list, empty if nothing did."""
    script = (f". {shlex.quote(given)}\n" if given else "") + block
    started = time.monotonic()
    done = subprocess.run(["bash", "-euc", script], cwd=folder, capture_output=True, text=True)
    print(f"{page}: {time.monotonic() - started:.1f} s, exit code {done.returncode}: "
          f"{block.splitlines()[0]}", flush=True)
    if done.returncode == 0:
        return []
    return [f"{page}: exit code {done.returncode} of:\n{block}{done.stderr[-2000:]}"]


def print_left_out(count, left_out):
    print(f"\n{count - len(left_out)} of {count} lines carried out; not these:\n"
          "| page | command | why |\n|---|---|---|")
    for page, line, why in left_out:
        print(f"| {page} | `{line.split('#')[0].strip()}` | {why} |")
    print()


def main():
    source, program = sys.argv[1:3]
    run, slow = "--run" in sys.argv, "--slow" in sys.argv
    docs = os.path.join(source, "docs")
    pages = [os.path.join(source, "README.md")]
    pages += sorted(os.path.join(docs, f) for f in os.listdir(docs) if f.endswith(".md"))
    failures, count, left_out = [], 0, []
    for page in pages:
        name = os.path.relpath(page, source)
        with tempfile.TemporaryDirectory() as folder:
            make_sandbox(source, program, folder)
            for kind, about, block in blocks_of(page):
                lines = [line for line in block.splitlines() if line.strip()]
                count += len(lines)
                for line in lines:
                    failures += [f"{name}: {line}: there is no {p}"
                                 for p in problems_of(line, program, source)]
                if kind == "sketch" or (kind == "slow" and not slow):
                    left_out += [(name, line, about) for line in lines]
                elif run:
                    given = os.path.join(GIVEN, about + ".sh") if kind == "given" else ""
                    failures += carried_out(name, block, given, folder)
    if run:
        print_left_out(count, left_out)
    print("\n".join(failures) or f"all commands of {len(pages)} pages {'work' if run else 'exist'}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
