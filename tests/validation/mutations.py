#!/usr/bin/python3
"""Spoils the inputs of luxfit, one at a time, and checks that every run ends in words: exit status 0, 1 or 2, never 70 or a signal.

    tests/validation/mutations.py PROGRAM FIXTURES [COUNT] [SEED]

COUNT (700) mutations are drawn by SEED (1): the same two give the same inputs. Half of them are of a small room with a photometric file
(`simulate`, `doctor`, `fit` to readings), half of the office's (`simulate`, `doctor` with two photos). A mutation is one of KINDS, of one
file. A run that refuses without saying what it expected, or that prints bytes that are no UTF-8, fails too. The table counts exit statuses
for each kind; "silent" counts runs with status 0, no warning, and illuminances that differ by more than 1 %: there the input is another
valid one. The inputs of runs that failed are kept in the folder that is named at the end. A hundred take two minutes.
"""
import collections
import csv
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

BOX = {
    "session.toml": b'''name = "box"

[scene]
mesh = "room.obj"
unit = "m"

[scene.albedo]
wall = 0.5
floor = [0.6, 0.3, 0.1]

[groups]
both = ["A", "B"]

[states]
one = { A = 1.0 }
all = { both = 1.0 }

[[luminaire]]
id = "A"
photometry = "lambertian"
shape = "rectangle"
size_m = [0.3, 0.3]
position_m = [1, 1, 1.9]
position_sigma_m = 0
flux_lm = 1000
flux_sigma_lm = 300

[[luminaire]]
id = "B"
photometry = "lamp.ies"
position_m = [2, 1, 1.9]
position_sigma_m = 0
aim = [0, 0, -1]
flux_lm = 300
flux_sigma_lm = 100

[luxmeter]
readings = "luxmeter.csv"
fit = ["P*"]
sensitivity = "meter.csv"
class = "B"
''',
    "room.obj": b'''# a box
v 0 0 0
v 3 0 0
v 3 2 0
v 0 2 0
v 0 0 2
v 3 0 2
v 3 2 2
v 0 2 2
usemtl floor
f 1 2 3 4
usemtl wall
f 5 8 7 6
f 1 5 6 2
f 2 6 7 3
f 3 7 8 4
f 4 8 5 1
''',
    "lamp.ies": b'''IESNA:LM-63-2002
[MANUFAC] maker
TILT=INCLUDE
1
2
0 90
1 0.8
1 1000 1 4 1 1 2 -0.1 -0.1 0
1 1 9
0 30 60 90
0
100 80 30 0
''',
    "luxmeter.csv": b'''id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx
P1,2,1,0.01,0,0,1,one,60
P1,2,1,0.01,0,0,1,all,130
P2,0.5,0.5,1,1,0,0,all,90
P3,1.0,1.2,0.01,0,0,1,one,120
Q1,1.0,0.5,0.8,0,0,1,all,
''',
    "meter.csv": b'angle_deg,relative\n0,1\n60,0.49\n90,0\n',
}
OFFICE_FILES = ("session.toml", "room.obj", "luxmeter.csv", "tags.json", "photos.csv", "cam0.yaml")
HIGH = [b"\xe4", b"\xff", b"\xc3\xa4", b"\x80", b"\xed\xa0\x80", b"\xf0\x9f\x92\xa1", b"\xc2\xa0", b"\xe2\x80\x93"]
NUMBER = re.compile(rb"(?<![\w.])-?\d+(?:\.\d+)?(?![\w.])")


def somewhere(text, rng):
    return rng.randrange(len(text) + 1)


def high_byte(text, rng):
    at = somewhere(text, rng)
    return text[:at] + rng.choice(HIGH) + text[at:]


def high_letter(text, rng):
    """A letter of a name or word becomes a byte of another encoding."""
    letters = [i for i, c in enumerate(text) if chr(c).isalpha()]
    at = rng.choice(letters)
    return text[:at] + rng.choice(HIGH) + text[at + 1:]


def encoding(text, rng):
    words = text.decode("latin-1")
    return rng.choice([lambda: words.encode("utf-16"), lambda: words.encode("utf-16-be"), lambda: b"\xef\xbb\xbf" + text,
                       lambda: text.replace(b"\n", b"\r"), lambda: text.replace(b"\n", b"\r\n"), lambda: words.encode("utf-32"),
                       lambda: text + b"\x00" * 3, lambda: text.replace(b" ", b"\xa0"), lambda: text.replace(b"\n", b"\n\n")])()


def number(text, rng, change):
    found = list(NUMBER.finditer(text))
    if not found:
        return text
    one = rng.choice(found)
    return text[:one.start()] + change(one.group()) + text[one.end():]


def unit(text, rng):
    factor = rng.choice([1000, 100, 0.001, 0.01, 25.4, 0.3048, 10.764])
    return number(text, rng, lambda n: b"%g" % (float(n) * factor))


def sign(text, rng):
    return number(text, rng, lambda n: n[1:] if n[:1] == b"-" else b"-" + n)


def no_number(text, rng):
    return number(text, rng, lambda n: rng.choice([b"nan", b"inf", b"-inf", b"1e999", b"", b"1,5", b"0", b"1e-320", b"0x1F", b"99999999999",
                                                   b"--1", b"1.2.3", b"twelve", b"4294967296"]))


def columns(text, rng):
    """Two fields change places, in one row or in all rows."""
    lines = text.split(b"\n")
    mark = b"," if any(b"," in line for line in lines) else b" "
    wide = [i for i, line in enumerate(lines) if line.count(mark) > 0]
    if not wide:
        return text
    rows = wide if rng.random() < 0.5 else [rng.choice(wide)]
    first, second = rng.randrange(4), rng.randrange(4)
    for i in rows:
        fields = lines[i].split(mark)
        a, b = first % len(fields), second % len(fields)
        fields[a], fields[b] = fields[b], fields[a]
        lines[i] = mark.join(fields)
    return b"\n".join(lines)


def names(text, rng):
    """A word becomes another word of the file, changes its case, loses a letter or becomes very long."""
    words = [w for w in re.finditer(rb"[A-Za-z_]+\d*", text)]
    if not words:
        return text
    one, other = rng.choice(words), rng.choice(words)
    name = one.group()
    new = rng.choice([other.group(), name.swapcase(), name[:-1], name + b"x", name * 300, b"../" + name, b"%s%n", b"a\tb", b"'" + name])
    return text[:one.start()] + new + text[one.end():]


def lines(text, rng):
    rows = text.split(b"\n")
    at = rng.randrange(len(rows))
    return rng.choice([lambda: b"\n".join(rows[:at] + rows[at + 1:]), lambda: b"\n".join(rows[:at] + [rows[at]] + rows[at:]),
                       lambda: text[:somewhere(text, rng)], lambda: b"", lambda: b"\n".join(rng.sample(rows, len(rows)))])()


KINDS = {"bytes above 0x7F": high_byte, "letters above 0x7F": high_letter, "encodings": encoding, "units": unit, "signs": sign,
         "no numbers": no_number, "columns": columns, "names": names, "lines": lines}


def office(fixtures):
    """The office of the fixture with everything given, for simulate, and two of its photos, for doctor."""
    folder = pathlib.Path(fixtures) / "office"
    files = {name: (folder / name).read_bytes() for name in OFFICE_FILES}
    files["photos.csv"] = b"\n".join(files["photos.csv"].split(b"\n")[:3]) + b"\n"
    known = re.findall(rb"usemtl (\S+)", files["room.obj"])
    luminaires = b"".join(b'\n[[luminaire]]\nid = "%s"\nphotometry = "lambertian"\nshape = "disc"\nsize_m = [0.2]\n'
                          b'position_m = [%.1f, 2.0, 2.7]\nflux_lm = 2000\n' % (name, x)
                          for name, x in ((b"A", 1.5), (b"B", 4.2), (b"C", 2.9), (b"D", 5.2)))
    albedo = b"\n[scene.albedo]\n" + b"".join(b"%s = 0.5\n" % m for m in sorted(set(known)))
    files["session.toml"] += luminaires + albedo
    return files, folder / "photos"


class Case:
    def __init__(self, files, folder, photos=None):
        self.files, self.folder = files, folder
        folder.mkdir()
        if photos:
            (folder / "photos").symlink_to(photos.resolve())
        self.write(files)

    def write(self, files):
        for name, data in files.items():
            (self.folder / name).write_bytes(data)

    def run(self, program, command):
        out = self.folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        arguments = [program, command, str(self.folder / "session.toml")]
        if command != "doctor":
            arguments += ["-o", str(out)]
        if command == "fit":
            arguments += ["--budget", "5"]
        try:
            done = subprocess.run(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120, check=False)
        except subprocess.TimeoutExpired:
            return "time", b"more than 120 s", {}
        return done.returncode, done.stdout, self.illuminance(out)

    @staticmethod
    def illuminance(out):
        table = out / "illuminance.csv"
        if not table.exists():
            return {}
        rows = csv.DictReader(table.read_text(encoding="utf-8").splitlines())
        return {(row["id"], row["state"]): float(row["illuminance_lx"] or "nan") for row in rows}


def differs(now, before):
    return now.keys() != before.keys() or any(not abs(now[k] - before[k]) <= 0.01 * abs(before[k]) + 1e-3 for k in before)


def fault(status, output):
    """Why a run is not allowed to end so; empty where it may."""
    if status not in (0, 1, 2):
        return f"ended with {status}"
    try:
        words = output.decode("utf-8")
    except UnicodeDecodeError:
        return "printed bytes that are no UTF-8"
    if status == 2 and not re.search(r"expected|cannot|could not|is not|must", words):
        return "refused without saying what was expected"
    return ""


def main(program, fixtures, count=700, seed=1):
    rng = random.Random(int(seed))
    work = pathlib.Path(tempfile.mkdtemp(prefix="luxfit_mutations_"))
    files, photos = office(fixtures)
    cases = [(Case(BOX, work / "box"), ("simulate", "doctor", "fit")), (Case(files, work / "office", photos), ("simulate", "doctor"))]
    before = {}
    for case, commands in cases:
        for command in commands:
            status, output, light = case.run(program, command)
            if status == 2 or fault(status, output):
                sys.exit(f"{case.folder.name}: {command} of the whole inputs ended with {status}:\n{output.decode(errors='replace')}")
            before[case.folder.name, command] = light
    table = collections.defaultdict(collections.Counter)
    failed = []
    for i in range(int(count)):
        case, commands = cases[i % len(cases)]
        kind = rng.choice(list(KINDS))
        command = rng.choice(commands)
        name = rng.choice([n for n in case.files if command != "simulate" or n not in ("tags.json", "photos.csv", "cam0.yaml")])
        spoilt = KINDS[kind](case.files[name], rng)
        case.write({name: spoilt})
        status, output, light = case.run(program, command)
        case.write(case.files)
        table[kind][status] += 1
        if status == 0 and command == "simulate" and b"warning" not in output and differs(light, before[case.folder.name, command]):
            table[kind]["silent"] += 1
        why = fault(status, output)
        if why:
            kept = work / f"failed_{i}"
            kept.mkdir()
            (kept / name).write_bytes(spoilt)
            print(f"{i}: {name}, {command}, {kind}: {why}", file=sys.stderr, flush=True)
            failed.append(f"{i}: {case.folder.name}, {command}, {kind} in {name}: {why}; {kept}\n"
                          f"   {output.decode(errors='replace').strip()[-300:]}")
    heads = sorted({s for row in table.values() for s in row}, key=str)
    print(f"{'mutation':<20}" + "".join(f"{str(h):>8}" for h in heads))
    for kind in KINDS:
        print(f"{kind:<20}" + "".join(f"{table[kind][h]:>8}" for h in heads))
    print(f"{'all':<20}" + "".join(f"{sum(row[h] for row in table.values()):>8}" for h in heads))
    if failed:
        print("\n".join(failed))
        sys.exit(f"{len(failed)} of {count} runs failed; their inputs are in {work}")
    shutil.rmtree(work)


if __name__ == "__main__":
    if not 3 <= len(sys.argv) <= 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
