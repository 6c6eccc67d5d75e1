#!/usr/bin/python3
"""Packs the Python module as a wheel that brings its libraries along.

    make_wheel.py MODULE STUBS VERSION LICENSE OUT_FOLDER

MODULE is the built luxfit.cpython-*.so, STUBS its luxfit.pyi. Every library that it needs but those of glibc and GCC, which each
Linux has, goes into luxfit.libs/ under a name of its own (with a hash), so that no library of the same name that the system or another
module brings takes its place. The copyright file of each library's Debian package goes along. Prints the wheel's path. Packages: patchelf.

Sources: PEP 427 (wheels), PEP 600 (manylinux), PEP 561 (stubs), and what auditwheel does.
"""
import base64
import concurrent.futures
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

# What a system has that runs Python: glibc, and the C++ library, which a program takes from the newest compiler.
SYSTEM_LIBRARIES = re.compile(r"(ld-linux-x86-64|libc|libm|libdl|librt|libpthread|libresolv|libutil|libstdc\+\+|libgcc_s)\.so\.\d+$")


def output_of(*command: object) -> str:
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def libraries_of(module: Path) -> dict[str, Path]:
    """The libraries that the module needs, also by way of others: path by name."""
    text = output_of("ldd", module)
    missing = re.findall(r"^\s*(\S+) => not found", text, re.M)
    if missing:
        sys.exit(f"{module}: expected all of its libraries, {', '.join(missing)} is not there; run ldconfig")
    found = dict(re.findall(r"^\s*(\S+) => (/\S+)", text, re.M))
    return {name: Path(path).resolve() for name, path in found.items() if not SYSTEM_LIBRARIES.match(name)}


def own_name(name: str, path: Path) -> str:
    """libtbb.so.12 -> libtbb-0123abcd.so.12"""
    stem, dot, rest = name.partition(".so")
    return f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}{dot}{rest}"


def point_to_own(library: Path, own_names: dict[str, str], folder: str) -> None:
    """Makes a library load those that come along, from that folder."""
    needed = output_of("patchelf", "--print-needed", library).split()
    replaced = [word for name in needed if name in own_names for word in ("--replace-needed", name, own_names[name])]
    # patchelf 0.14 mixes names up where one call changes them and the folder.
    if replaced:
        output_of("patchelf", *replaced, library)
    output_of("patchelf", "--set-rpath", folder, library)


def bring_along(module: Path, root: Path) -> list[Path]:
    libraries = libraries_of(module)
    own_names = {name: own_name(name, path) for name, path in libraries.items()}
    folder = root / "luxfit.libs"
    folder.mkdir()

    def vendor(name: str) -> None:
        target = folder / own_names[name]
        shutil.copyfile(libraries[name], target)
        point_to_own(target, own_names, "$ORIGIN")
        output_of("patchelf", "--set-soname", own_names[name], target)
        target.chmod(0o755)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(vendor, libraries))
    target = root / module.name
    output_of("strip", "--strip-unneeded", "-o", target, module)
    point_to_own(target, own_names, "$ORIGIN/luxfit.libs")
    return sorted(set(libraries.values()))


def copyrights_of(paths: list[Path]) -> dict[str, Path]:
    """The copyright files of the Debian packages that these libraries are of, by package."""
    # Debian's records know some libraries by their place before /lib was merged into /usr.
    names = [str(path) for path in paths] + [str(path).removeprefix("/usr") for path in paths]
    owners = subprocess.run(["dpkg", "-S", *names], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False).stdout
    files: dict[str, Path] = {}
    for line in owners.splitlines():
        package = line.split(":")[0]
        file = Path("/usr/share/doc") / package / "copyright"
        if file.exists():
            files[package] = file
    return files


def metadata(version: str) -> str:
    return f"""Metadata-Version: 2.1
Name: luxfit
Version: {version}
Summary: Inverse-lighting calibration of rooms
License: Apache-2.0; libraries in luxfit.libs: see the folder licenses
Requires-Python: >={sys.version_info.major}.{sys.version_info.minor}
Requires-Dist: numpy
"""


def record_line(root: Path, path: Path) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(path.read_bytes()).digest()).rstrip(b"=").decode()
    return f"{path.relative_to(root)},sha256={digest},{path.stat().st_size}\n"


def add_information(root: Path, version: str, tag: str, own_license: str, paths: list[Path]) -> None:
    info = root / f"luxfit-{version}.dist-info"
    licenses = info / "licenses"
    licenses.mkdir(parents=True)
    shutil.copyfile(own_license, licenses / "luxfit.txt")
    for package, file in copyrights_of(paths).items():
        shutil.copyfile(file, licenses / f"{package}.txt")
    (info / "METADATA").write_text(metadata(version))
    (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: luxfit\nRoot-Is-Purelib: false\nTag: {tag}\n")
    files = sorted(path for path in root.rglob("*") if path.is_file())
    record = info / "RECORD"
    record.write_text("".join(record_line(root, path) for path in files) + f"{record.relative_to(root)},,\n")


def pack(root: Path, wheel: Path) -> None:
    """Packs the folder, the same for the same content."""
    part = wheel.with_suffix(".part")
    with zipfile.ZipFile(part, "w") as archive:
        for path in sorted(path for path in root.rglob("*") if path.is_file()):
            entry = zipfile.ZipInfo(str(path.relative_to(root)), (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (path.stat().st_mode & 0xFFFF) << 16
            # A level of 6 takes twice the time for 5 % less.
            archive.writestr(entry, path.read_bytes(), zipfile.ZIP_DEFLATED, compresslevel=3)
    part.rename(wheel)


def main() -> None:
    module, stubs, version, own_license, out_folder = sys.argv[1:]
    if not shutil.which("patchelf"):
        sys.exit("expected the program patchelf, found none; install the package patchelf")
    glibc = str(os.confstr("CS_GNU_LIBC_VERSION")).split()[1].replace(".", "_")
    python = sysconfig.get_config_var("py_version_nodot")
    tag = f"cp{python}-cp{python}-manylinux_{glibc}_x86_64"
    out = Path(out_folder)
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        root = Path(work) / "wheel"
        root.mkdir()
        paths = bring_along(Path(module), root)
        (root / "luxfit-stubs").mkdir()
        shutil.copyfile(stubs, root / "luxfit-stubs" / "__init__.pyi")
        add_information(root, version, tag, own_license, paths)
        wheel = out / f"luxfit-{version}-{tag}.whl"
        pack(root, wheel)
    print(wheel)


if __name__ == "__main__":
    main()
