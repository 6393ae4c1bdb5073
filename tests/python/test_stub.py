"""The stub says what the module has: the same names, the same arguments, the same defaults."""
import ast
import inspect

import numpy as np

from notebook import ROOT, main, twinarm

import unittest

STUB = ast.parse((ROOT / "app" / "python" / "twinarm" / "__init__.pyi").read_text(encoding="utf-8"))


def arguments(function):
    """[(name, kind, default)] of a definition in the stub."""
    a, found = function.args, []
    defaults = [None] * (len(a.args) - len(a.defaults)) + a.defaults
    for arg, default in zip(a.args, defaults):
        found.append((arg.arg, "either", default))
    for arg, default in zip(a.kwonlyargs, a.kw_defaults):
        found.append((arg.arg, "by name", default))
    return [(name, kind, "none" if d is None else ast.literal_eval(d)) for name, kind, d in found]


def reported(function):
    """The same of the module, from the first line of its documentation."""
    if inspect.isfunction(function) or inspect.isbuiltin(function) and function.__text_signature__:
        kinds = {inspect.Parameter.POSITIONAL_OR_KEYWORD: "either", inspect.Parameter.KEYWORD_ONLY: "by name"}
        return [(p.name, kinds[p.kind], "none" if p.default is p.empty else p.default)
                for p in inspect.signature(function).parameters.values()]
    line = function.__doc__.splitlines()[0]
    head = line[:line.rindex(" -> ")] if " -> " in line else line
    return arguments(ast.parse(f"def {head}: ...").body[0])


def defined(body):
    """{name: node} of classes, functions, properties and variables."""
    names = {}
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            names.setdefault(node.name, node)
        elif isinstance(node, ast.AnnAssign):
            names[node.target.id] = node
    return names


def is_property(node):
    return isinstance(node, ast.FunctionDef) and any(
        isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)


def setters(body):
    return {node.name for node in body if isinstance(node, ast.FunctionDef) and any(
        isinstance(d, ast.Attribute) and d.attr == "setter" for d in node.decorator_list)}


class Stub(unittest.TestCase):
    def test_it_names_what_the_module_has_and_nothing_else(self):
        public = {n for n in dir(twinarm) if not n.startswith("_")} | {"__version__"}
        self.assertEqual(set(defined(STUB.body)), public)
        for name, node in defined(STUB.body).items():
            if not isinstance(node, ast.ClassDef) or name == "InputError":
                continue
            there = getattr(twinarm, name)
            own = {n for n in vars(there) if not n.startswith("_")}
            own |= {n for n in ("__getitem__", "__contains__", "__len__", "__iter__",
                                "__enter__", "__exit__") if n in vars(there)}
            stated = set(defined(node.body)) - {"__init__"}
            self.assertEqual(stated, own, name)
            for member, inner in defined(node.body).items():
                here = vars(there).get(member)
                self.assertEqual(is_property(inner), isinstance(here, property), f"{name}.{member}")
                if isinstance(here, property):
                    self.assertEqual(member in setters(node.body), here.fset is not None, member)

    def test_each_function_takes_the_arguments_that_it_states(self):
        checked = 0
        for name, node in defined(STUB.body).items():
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(arguments(node), reported(getattr(twinarm, name)), name)
                checked += 1
            for inner in node.body if isinstance(node, ast.ClassDef) else []:
                if not isinstance(inner, ast.FunctionDef) or inner.decorator_list:
                    continue
                if name.endswith("Simulation") or inner.name != "__init__":
                    there = getattr(getattr(twinarm, name), inner.name)
                    found = reported(there)
                    self.assertEqual(arguments(inner), found, f"{name}.{inner.name}")
                    checked += 1
        self.assertGreater(checked, 25)

    def test_everything_says_what_it_is_with_shapes_and_units(self):
        for name, node in defined(STUB.body).items():
            there = getattr(twinarm, name)
            if isinstance(node, ast.AnnAssign):
                continue
            self.assertGreater(len(there.__doc__ or ""), 20, name)
            returns_array = isinstance(node, ast.FunctionDef) and "Array" in ast.unparse(node.returns)
            if returns_array:
                self.assertRegex(there.__doc__, r"\(.*\)", name)
                self.assertRegex(there.__doc__, r"\[.*(m|rad|kg|s).*\]", name)
            for member, inner in defined(node.body if isinstance(node, ast.ClassDef) else []).items():
                if name == "InputError" or member == "__iter__":
                    continue
                doc = getattr(there, member).__doc__
                self.assertTrue(doc and doc.strip(), f"{name}.{member}")
                if is_property(inner) and ast.unparse(inner.returns) == "Array":
                    self.assertRegex(doc, r"\[", f"{name}.{member}: unit")

    def test_what_the_stub_calls_an_array_is_one(self):
        model = twinarm.load("assets/robots/puma560/puma560.urdf")
        node = defined(STUB.body)["Model"]
        for member, inner in defined(node.body).items():
            if is_property(inner) and ast.unparse(inner.returns) == "Array":
                value = getattr(model, member)
                self.assertIsInstance(value, np.ndarray)
                self.assertEqual(value.dtype, np.float64)


if __name__ == "__main__":
    main()
