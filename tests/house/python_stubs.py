#!/usr/bin/python3
"""Checks that the type stubs apps/python/luxfit.pyi agree with the built module, and docs/python.md with the stubs.

    python_stubs.py SOURCE FOLDER_OF_THE_MODULE

mypy's stubtest compares names and kinds. It does not see the arguments of pybind11's functions. This test compares them with the signatures in
the docstrings, and types of values with the values of a session, a room, a simulation and two fits. Packages: mypy, numpy.
"""
import ast
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import types
import typing
import unittest

import numpy as np

SOURCE, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
os.environ["LUXFIT_FIXTURES"] = str(SOURCE / "fixtures")
sys.path[:0] = [str(FOLDER), str(SOURCE / "tests" / "apps" / "python")]
sys.dont_write_bytecode = True

import luxfit  # noqa: E402
import python_test  # noqa: E402

OFFICE = SOURCE / "fixtures" / "office"
PYI = SOURCE / "apps" / "python" / "luxfit.pyi"

# The stubs as a module, to evaluate their types. Stubs may name classes that are defined further down.
STUBS = types.ModuleType("luxfit_stubs")
exec(compile("from __future__ import annotations\n" + PYI.read_text(), str(PYI), "exec"), vars(STUBS))

MYPY_CACHE = tempfile.TemporaryDirectory()  # removed at the end

# The annotations that a stub may use for an argument of pybind11's type.
ARGUMENTS = {
    "bool": {"bool"}, "int": {"int"}, "float": {"float"}, "str": {"str", "_Unit", "_Shape", "_Furniture"}, "os.PathLike": {"_Path"},
    "numpy.ndarray": {"ArrayLike"}, "List[float]": {"_Numbers"}, "List[str]": {"Sequence[str]"}, "List[os.PathLike]": {"Sequence[_Path]"},
    "List[dict]": {"Sequence[dict[str, Any]]"}, "dict": {"dict[str, Any]"}, "Dict[str, float]": {"_Albedo"},
    "List[luxfit.Luminaire]": {"Sequence[Luminaire]"},
}


def mypy(module, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "MYPYPATH": str(PYI.parent), "PYTHONPATH": str(FOLDER), "MYPY_CACHE_DIR": MYPY_CACHE.name}
        return subprocess.run([sys.executable, "-m", module, *map(str, arguments)], cwd=folder, env=environment, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def parse_signature(text):
    """Parses pybind11's first line, such as `fit(session: os.PathLike, *, threads: int = 0) -> luxfit.Result`."""
    line = text.strip().splitlines()[0]
    name = "setter" if line.startswith("(") else ""
    return ast.parse(f"def {name}{line}: ...").body[0]


def said_argument(annotation):
    """Returns the annotations that the stub may use for that of pybind11."""
    if isinstance(annotation, ast.Subscript) and ast.unparse(annotation.value) == "Optional":
        return {f"Optional[{said}]" for said in said_argument(annotation.slice)}
    text = re.sub(r"^numpy\.ndarray\[.*$", "numpy.ndarray", ast.unparse(annotation))
    return ARGUMENTS.get(text, {text.removeprefix("luxfit.")})


def default_of(node):
    """Returns a default as text; None without one."""
    if node is None:
        return None
    try:
        return repr(ast.literal_eval(node))
    except ValueError:
        return "array"


def matches(value, hint):
    """Tells whether a value has a type, entries of lists and dicts included."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if hint is typing.Any:
        return True
    if origin in (typing.Union, types.UnionType):
        return any(matches(value, choice) for choice in arguments)
    if origin is typing.Literal:
        return value in arguments
    if origin is np.ndarray:
        return isinstance(value, np.ndarray) and value.dtype == typing.get_args(arguments[1])[0]
    if origin is list:
        return type(value) is list and all(matches(item, arguments[0]) for item in value)
    if origin is tuple:
        return type(value) is tuple and len(value) == len(arguments) and all(map(matches, value, arguments))
    if origin is dict:
        return type(value) is dict and all(matches(key, arguments[0]) and matches(item, arguments[1]) for key, item in value.items())
    if typing.is_typeddict(hint):
        hints = typing.get_type_hints(hint, vars(STUBS))
        return type(value) is dict and set(value) == set(hints) and all(matches(value[key], hints[key]) for key in hints)
    if isinstance(hint, type) and hint.__module__ == STUBS.__name__:
        return type(value) is getattr(luxfit, hint.__name__)
    return type(value) is hint


class Signatures(unittest.TestCase):
    """Compares arguments in the stub's text with pybind11's docstrings."""

    def compare(self, place, stub, text):
        module = parse_signature(text)
        with self.subTest(place):
            for kind in ("posonlyargs", "args", "kwonlyargs"):
                said, true = getattr(stub.args, kind), getattr(module.args, kind)
                self.assertEqual(len(said), len(true), kind)
                if module.name != "setter":  # there pybind11 says arg0 and arg1
                    self.assertEqual([a.arg for a in said], [a.arg for a in true])
                for one, other in zip(said, true):
                    if one.arg != "self":
                        self.assertIn(ast.unparse(one.annotation), said_argument(other.annotation), other.arg)
            returned = ast.unparse(module.returns)
            if returned == "None" or returned.startswith("luxfit."):
                self.assertEqual(ast.unparse(stub.returns), returned.removeprefix("luxfit."))
            for kind in ("defaults", "kw_defaults"):
                said, true = getattr(stub.args, kind), getattr(module.args, kind)
                self.assertEqual(len(said), len(true), kind)
                for one, other in zip(map(default_of, said), map(default_of, true)):
                    # Lists, dicts and arrays stand as ... in stubs.
                    self.assertIn(one, {"Ellipsis"} if other in ("array", "[]", "{}") else {other})

    def test_functions_methods_and_setters(self):
        count = 0
        for node in ast.parse(PYI.read_text()).body:
            if isinstance(node, ast.FunctionDef):
                self.compare(node.name, node, getattr(luxfit, node.name).__doc__)
                count += 1
            if not isinstance(node, ast.ClassDef) or node.name.startswith("_"):
                continue
            for member in node.body:
                if not isinstance(member, ast.FunctionDef):
                    continue
                of_module = vars(getattr(luxfit, node.name))[member.name]
                decorators = [ast.unparse(d) for d in member.decorator_list]
                if decorators == [f"{member.name}.setter"]:
                    self.compare(f"{node.name}.{member.name}", member, of_module.fset.__doc__)
                elif not decorators and member.args.vararg is None:
                    self.compare(f"{node.name}.{member.name}", member, of_module.__doc__)
                count += 1
        self.assertGreater(count, 80)

    def test_setters_are_where_the_module_has_them(self):
        for name, stub in vars(STUBS).items():
            for key in dir(stub) if isinstance(stub, type) and not name.startswith("_") else ():
                member = getattr(stub, key)
                if isinstance(member, property):
                    with self.subTest(f"{name}.{key}"):
                        self.assertEqual(member.fset is None, vars(getattr(luxfit, name))[key].fset is None)

    def test_choices_are_those_that_the_module_names(self):
        for words, call in ((STUBS._Unit, lambda: luxfit.Room(OFFICE / "room.obj", unit="?")),
                            (STUBS._Shape, lambda: luxfit.Luminaire([0, 0, 0], 1, shape="?")),
                            (STUBS._Furniture, lambda: luxfit.fit_room(luxfit.Room(OFFICE / "room.obj"), {}, furniture="?"))):
            with self.assertRaises(luxfit.InputError) as raised:
                call()
            named = re.search("expected (.*), got", str(raised.exception))[1]
            self.assertEqual(set(re.split(", | or ", named)), set(typing.get_args(words)))


class Values(unittest.TestCase):
    """Compares types with the values of properties and functions."""

    def expect(self, place, value, hint):
        with self.subTest(place):
            self.assertTrue(matches(value, hint), f"expected {hint}, got {value!r}")

    def expect_all(self, value):
        name = type(value).__name__
        stub = getattr(STUBS, name)
        for key, hint in typing.get_type_hints(stub, vars(STUBS)).items():
            self.expect(f"{name}.{key}", getattr(value, key), hint)
        for key in dir(stub):
            member = getattr(stub, key)
            if isinstance(member, property):
                self.expect(f"{name}.{key}", getattr(value, key), self.returned(member.fget))

    @staticmethod
    def returned(function):
        return typing.get_type_hints(function, vars(STUBS))["return"]

    def test_everything_has_a_docstring(self):
        for name, stub in vars(STUBS).items():
            if getattr(stub, "__module__", None) != STUBS.__name__ or name == "_Pybind11Type" or not callable(stub):
                continue
            members = [getattr(stub, key) for key in dir(stub)] if isinstance(stub, type) and not name.startswith("_") else []
            members = [getattr(m, "fget", m) for m in members]
            for one in [stub, *(m for m in members if isinstance(m, types.FunctionType) and m.__name__ not in ("__init__", "__repr__"))]:
                self.assertTrue(one.__doc__, one)

    def test_luminaire_and_photometry(self):
        with tempfile.TemporaryDirectory() as folder:
            for photometry, more in (("isotropic", {}), ("table", {"gamma_deg": np.array([0, 90]), "cd_per_klm": (300, 100.0)}),
                                     ("lambertian", {"shape": "disc", "size_m": [0.3], "aim": (0, 1, 0)})):
                lamp = luxfit.Luminaire([0, 0, 2], 100, photometry, **more)
                self.expect_all(lamp)
                for path in (pathlib.Path(folder) / "lamp.ldt", os.fsencode(folder) + b"/lamp.ies"):
                    self.assertIsNone(luxfit.write_photometry(path, lamp))
                    self.expect("read_photometry", luxfit.read_photometry(path), self.returned(STUBS.read_photometry))
            self.expect("intensity_cd", lamp.intensity_cd([[0, 0, 1]]), self.returned(STUBS.Luminaire.intensity_cd))

    def test_room(self):
        room = luxfit.Room(OFFICE / "room.obj", patch_size_m=2)
        self.expect_all(room)
        lamps, albedo = (luxfit.Luminaire([3, 2, 2.5], 100),), dict.fromkeys(room.materials, 0)
        self.expect("illuminance", room.illuminance(lamps, [[3, 2, 1]], [[0, 0, 1]], albedo), self.returned(STUBS.Room.illuminance))
        self.expect("patch_light", room.patch_light(lamps, albedo), self.returned(STUBS.Room.patch_light))

    def test_session_simulation_and_result(self):
        case = python_test.FitTest()
        with tempfile.TemporaryDirectory() as folder:
            case.folder = pathlib.Path(folder)
            path = case.session()
            text = path.read_text().replace("[luxmeter]", '[scene]\nmesh = "box.obj"\n[scene.albedo]\npaint = 0.5\n[luxmeter]')
            case.write("box.obj", python_test.BOX)
            case.write("indoors.toml", text)
            out = case.folder / "out"
            result = luxfit.fit(str(path), out, luminaires=None)
            self.expect("fit", result, self.returned(STUBS.fit))
            self.expect_all(result)
            self.expect("covariance_of", result.covariance_of(tuple(result.parameter_names[:2])), self.returned(STUBS.Result.covariance_of))
            self.expect("position_covariance_m2", result.position_covariance_m2("P"), self.returned(STUBS.Result.position_covariance_m2))
            self.expect_all(luxfit.read_result(os.fsencode(out)))
            self.expect_all(luxfit.read_session(OFFICE / "session.toml"))
            for one in (path, case.folder / "indoors.toml"):
                session = luxfit.read_session(one)
                self.expect_all(session)
                self.expect_all(session.with_result(out))
                self.expect_all(luxfit.simulate(session.with_result(out), error_percent=10))

    def test_fit_room(self):
        reading = {"position_m": [1.2, 1.2, 0.741], "normal": [0, 0, 1], "state": "on", "illuminance_lx": 257.6}
        self.expect_all(luxfit.fit_room(luxfit.Room(OFFICE / "room.obj", patch_size_m=2), {"on": {"A": 1}}, readings=(reading,)))


class Mypy(unittest.TestCase):
    def expect_clean(self, done):
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_stub_and_module_agree(self):
        self.expect_clean(mypy("mypy.stubtest", "luxfit"))

    def test_documentation_and_examples_are_correct(self):
        blocks = re.findall(r"^```python\n(.*?)^```", (SOURCE / "docs" / "python.md").read_text(), re.M | re.S)
        self.assertTrue(blocks)
        with tempfile.TemporaryDirectory() as folder:
            files = [pathlib.Path(folder) / f"python_md_{i}.py" for i in range(len(blocks))]
            for file, block in zip(files, blocks):
                file.write_text(block)
            self.expect_clean(mypy("mypy", "--strict", PYI, *files, *PYI.parent.glob("*.py")))

    def test_the_modules_own_test_is_correct(self):
        self.expect_clean(mypy("mypy", "--check-untyped-defs", "--warn-unused-ignores", SOURCE / "tests/apps/python/python_test.py"))

    def test_mistakes_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "wrong.py"
            file.write_text("import luxfit\nluxfit.Room('a', unit='yd')\nluxfit.fit('a')\nluxfit.read_result('a').flux\n"
                            "luxfit.read_session('a').scene['mesh']\nluxfit.Room('a').patches['area']\n")
            done = mypy("mypy", "--strict", file)
        self.assertEqual(sorted(set(re.findall(r"wrong.py:(\d)", done.stdout))), list("23456"), done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
