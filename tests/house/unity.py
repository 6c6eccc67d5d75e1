#!/usr/bin/env python3
"""The presets `ci` and `package` compile several files at a time as one, tests among them: names that each file has for itself must not meet
there, nor those of headers. Looks at the source alone: compiling every batch to see takes ten minutes.

  unity.py SOURCE
"""
import collections
import functools
import pathlib
import re
import subprocess
import sys
import tempfile

NAME = r"[A-Za-z_]\w*"


def batches(source):
    """Returns for every batch of the preset its files."""
    with tempfile.TemporaryDirectory() as build:
        subprocess.run(["cmake", "-S", source, "--preset", "ci", "-B", build], check=True, stdout=subprocess.DEVNULL)
        for unit in sorted(pathlib.Path(build).rglob("Unity/unity_*_cxx.cxx")):
            yield [f for f in re.findall(r'#include "(.*)"', unit.read_text()) if not f.startswith(build)]


def statements(path, space):
    """Yields what stands at the margin of a file's namespaces of one name, each up to its body or its end."""
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', pathlib.Path(path).read_text(), flags=re.S)
    for inside in re.findall(rf"^namespace {space}\{{$(.*?)^\}}  // namespace {space}".rstrip() + "$", text, re.M | re.S):
        inside = re.sub(r"//[^\n]*", "", inside)
        yield from (" ".join(s.split()) for s in re.findall(r"^[A-Za-z_\[][^;{]*(?:;|\{[^\n]*)", inside, re.M))


@functools.lru_cache(maxsize=None)
def headers(source, path):
    """Returns the project's headers that a file includes, those that these include among them."""
    included = re.findall(r'^#include "(.*)"', pathlib.Path(path).read_text(), re.M)
    direct = {f"{source}/{h}" for h in included if pathlib.Path(source, h).exists() and h.endswith(".h")}
    return direct.union(*(headers(source, h) for h in direct))


def parameters(statement):
    """Returns what stands between a statement's first parenthesis and the one that closes it."""
    begin, depth = statement.index("(") + 1, 1
    for end in range(begin, len(statement)):
        depth += {"(": 1, ")": -1}.get(statement[end], 0)
        if depth == 0:
            return statement[begin:end]
    return statement[begin:]


def parameter_types(plain):
    """Yields the types of a parameter list without names, and again without each of the last that have defaults."""
    while re.search(r"[<({][^<>(){}]*,[^<>(){}]*[>)}]", plain):
        plain = re.sub(r"([<({][^<>(){}]*),([^<>(){}]*[>)}])", r"\1;\2", plain)
    types = [re.sub(rf"(?<=[\s&*])({NAME})?\s*(=.*)?$", "", p.strip()).replace(" ", "") for p in plain.split(",")]
    yield types
    for p in reversed(plain.split(",")):
        if "=" not in p:
            return
        types = types[:-1]
        yield types or [""]


def names(statement):
    """Yields what a statement defines: a name, or a function with the types of its parameters."""
    kind = re.match(rf"(?:template <[^{{]*> )?(?:struct|class|enum(?: class)?|union) ({NAME})[^;(]*\{{", statement)
    alias = re.match(rf"using ({NAME}) =", statement)
    if kind or alias:
        yield (kind or alias).group(1)
    elif statement.startswith("using "):
        return
    elif "=" in statement.split("(")[0] or re.match(rf"(constexpr|const|static|std::)[^()]*\b{NAME}(\{{|;)", statement):
        yield from re.findall(rf"\b({NAME})(?:\[\w*\])? ?(?==(?!=)|\{{)", re.sub(r"\([^()]*\)", "", statement))
    elif re.match(r"(constexpr|const) [^()]*\bk[A-Z]\w*\(", statement):
        yield from re.findall(r"\b(k[A-Z]\w*)\(", statement)
    elif function := re.match(rf"[^(]*?\b({NAME})\(", statement):
        for types in parameter_types(parameters(statement)):
            yield f"{function.group(1)}({','.join(types)})"


def defined(path, space):
    """Returns the names of a file's namespaces of one name."""
    return {n for s in statements(path, space) if not s.startswith("namespace ") for n in names(s)}


def borrowed(path):
    """Returns the names that a file takes from other namespaces, such as kPi of `using support::kPi`."""
    return {n for s in statements(path, "") for n in re.findall(rf"^using [\w:]*::({NAME});", s)}


def main():
    source, found = sys.argv[1], 0
    all_batches = list(batches(source))
    if not all_batches:
        sys.exit("the preset ci builds no batches")
    for batch in all_batches:
        files = collections.defaultdict(set)
        for path in batch:
            for name in defined(path, ""):
                files[name].add(path)
        # A function of one's own hides a header's of its name; what JSON turns into by itself would then be taken.
        own = {name.split("(")[0]: paths for name, paths in files.items()}
        for header in sorted({h for path in batch for h in headers(source, path)}):
            for name in defined(header, "luxfit "):
                hidden = name.split("(")[0]
                if name in files:
                    files[name].add(header)
                elif "json&" in name and hidden in own:
                    files[hidden] = files.get(hidden, set()) | own[hidden] | {header}
        for path in batch:
            for name in borrowed(path) & files.keys():
                files[name].add(path)
        for name, paths in files.items():
            paths = paths | files.get(name.split("(")[0], set())  # a type hides, or is hidden by, a function of its name
            if len(paths) > 1:
                print(f"{name} is defined in {' and in '.join(sorted(paths))}, which are compiled as one", file=sys.stderr)
                found += 1
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
