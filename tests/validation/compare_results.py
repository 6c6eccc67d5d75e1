#!/usr/bin/env python3
"""Compares the numbers and texts of two result.json files, key by key.

    compare_results.py BEFORE AFTER [--tolerance 1e-6]

Prints how many numbers were compared, the largest relative difference and where it is, and every key or text that
differs. Times, versions, command lines and input hashes are left out. Exit status 1 where a number differs by more than
the tolerance, or a key is missing afterwards.
"""
import argparse
import json
import sys

LEFT_OUT = {"timing_s", "luxfit_version", "session_file", "format_version", "command", "command_line", "inputs", "input_hashes", "created", "session", "options",
            "reused_stages", "threads"}


def leaves(value, path=""):
    if isinstance(value, dict):
        for key, item in value.items():
            if key not in LEFT_OUT:
                yield from leaves(item, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for i, item in enumerate(value):
            yield from leaves(item, f"{path}[{i}]")
    else:
        yield path, value


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("--tolerance", type=float, default=1e-6)
    parser.add_argument("--floor", type=float, default=1e-9, help="differences below it count as none")
    options = parser.parse_args()
    with open(options.before) as before_file, open(options.after) as after_file:
        before, after = dict(leaves(json.load(before_file))), dict(leaves(json.load(after_file)))
    numbers, worst, worst_at, failed = 0, 0.0, "", False
    for path, old in before.items():
        if path not in after:
            print(f"missing: {path}")
            failed = True
            continue
        new = after[path]
        if not (is_number(old) and is_number(new)):
            if old != new:
                print(f"text: {path}: {old!r} -> {new!r}")
                failed = failed or is_number(old) or is_number(new)
            continue
        numbers += 1
        scale = max(abs(old), abs(new))
        difference = 0.0 if abs(old - new) <= options.floor else abs(old - new) / scale
        if difference > worst:
            worst, worst_at = difference, f"{path}: {old!r} -> {new!r}"
        if difference > options.tolerance:
            print(f"number: {path}: {old!r} -> {new!r} ({difference:.2g})")
            failed = True
    for path in after.keys() - before.keys():
        print(f"new: {path}")
    print(f"{numbers} numbers, largest relative difference {worst:.2g} {worst_at}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
