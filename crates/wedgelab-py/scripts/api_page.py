"""Writes docs/python-api.md: what the package offers, with the signatures and texts of its sources.

``python crates/wedgelab-py/scripts/api_page.py`` needs nothing but Python; a test compares the page with the sources.
"""

from __future__ import annotations

import ast
import re
import textwrap
from collections.abc import Iterator
from inspect import cleandoc
from pathlib import Path

ROOT = Path(__file__).parents[3]
SOURCES = ROOT / "crates" / "wedgelab-py" / "python" / "wedgelab"
PAGE = ROOT / "docs" / "python-api.md"

# Modules in the order of the page; those with a prefix are used by it, of the others the package offers the names.
MODULES = {
    "case": "wl.",
    "sections": "wl.",
    "_motions": "wl.",
    "truck": "wl.",
    "car": "wl.",
    "nucars": "wl.nucars.",
    "result": "wl.",
    "_wedgelab": "wl.",
    "many": "wl.",
    "study": "wl.",
    "assessment": "wl.",
    "rise": "wl.",
    "probability": "wl.",
    "cluster": "wl.cluster.",
    "figures": "wl.",
    "quasi_static": "wl.",
    "step": "wl.",
    "wheelrail": "wl.wheelrail.",
    "errors": "wl.",
}
HEAD = """# Python: reference

Every class and function, with `import wedgelab as wl`. [Python](python.md) is a short tour. Quantities are texts with a unit, or
numbers in SI units. `python crates/wedgelab-py/scripts/api_page.py` writes this page from the sources of the package.
"""
Function = (ast.FunctionDef, ast.AsyncFunctionDef)


class Module:
    """A source file."""

    def __init__(self, name: str) -> None:
        path = SOURCES / f"{name}.py"
        text = (path if path.exists() else path.with_suffix(".pyi")).read_text(encoding="utf-8")
        self.lines = text.splitlines()
        self.tree = ast.parse(text)
        self.classes = {node.name: node for node in self.tree.body if isinstance(node, ast.ClassDef)}

    def offered(self) -> list[str]:
        """The names in ``__all__``."""
        for node in self.tree.body:
            if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name) and node.targets[0].id == "__all__":
                return list(ast.literal_eval(node.value))
        return []

    def head(self, node: ast.FunctionDef | ast.AsyncFunctionDef) -> str:
        """Arguments and result of a function, in one line, as the source has them."""
        lines = " ".join(line.strip() for line in self.lines[node.lineno - 1 : node.body[0].lineno])
        depth = 0
        for place, char in enumerate(lines):
            depth += (char in "([{") - (char in ")]}")
            if char == ":" and depth == 0:
                lines = lines[:place]
                break
        return re.sub(r",? ?\)", ")", lines[lines.index("(") :].replace("( ", "("))


MODULE = {name: Module(name) for name in MODULES}


def text(node: ast.AST, indent: str = "") -> str:
    """The text of a docstring, its examples in a block of code."""
    own = ast.get_docstring(node) if isinstance(node, (ast.ClassDef, ast.Module, *Function)) else None
    own = re.sub(r" *# doctest:.*", "", own or "")
    own = re.sub(r"^(>>> .*(?:\n.+)*)", r"```python\n\1\n```", own, flags=re.MULTILINE)
    return re.sub(r"\n(?=.)", f"\n{indent}", own)


def code(call: str) -> str:
    """A call in a block of code, broken between arguments where it is long."""
    kept = re.sub(r"(?<!,) ", "\0", call)
    wrapped = textwrap.wrap(kept, 120, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    lines = [line.replace("\0", " ") for line in wrapped]
    return "```text\n" + "\n".join(lines) + "\n```\n"


def without_self(head: str) -> str:
    """Arguments without the first one of a method."""
    return re.sub(r"\((self|cls)(: [\w\[\]]+)?(, )?", "(", head)


def is_shown(node: ast.stmt) -> bool:
    """Whether a member is for users: named without an underscore, and no overload."""
    if not isinstance(node, Function) or node.name.startswith("_"):
        return False
    return not any("overload" in ast.dump(decorator) or ".setter" in ast.dump(decorator) for decorator in node.decorator_list)


def lineage(name: str, module: Module) -> Iterator[tuple[ast.ClassDef, Module]]:
    """A class and those of the package that it inherits from and that the page does not name."""
    node = module.classes[name]
    yield node, module
    for base in node.bases:
        own = base.value if isinstance(base, ast.Subscript) else base
        if not isinstance(own, ast.Name):
            continue
        for other in (module, *MODULE.values()):
            if own.id in other.classes:
                if own.id not in other.offered():
                    yield from lineage(own.id, other)
                break


def fields(node: ast.ClassDef) -> Iterator[tuple[str, str]]:
    """Fields with annotations, and the texts below them."""
    for place, own in enumerate(node.body):
        if isinstance(own, ast.AnnAssign) and isinstance(own.target, ast.Name) and not own.target.id.startswith("_"):
            below = node.body[place + 1] if place + 1 < len(node.body) else None
            value = below.value if isinstance(below, ast.Expr) else None
            said = value.value if isinstance(value, ast.Constant) and isinstance(value.value, str) else ""
            yield own.target.id, cleandoc(said).replace("\n", "\n  ")


def of_class(name: str, prefix: str, module: Module) -> Iterator[str]:
    """What is said of a class."""
    family = list(lineage(name, module))
    makers = [
        (own, where)
        for node, where in family
        for own in node.body
        if isinstance(own, Function) and own.name in ("__init__", "__new__")
    ]
    head = ""
    if makers:
        maker, where = makers[0]
        head = without_self(where.head(maker)).split(" -> ")[0].replace("_Own", name)
    yield f"### {prefix}{name}\n"
    if head not in ("", "()") and "Native" not in head:
        yield code(f"{name}{head}")
    yield f"{text(family[0][0])}\n"
    if makers and text(makers[0][0]):
        yield f"{text(makers[0][0])}\n"
    seen: set[str] = set()
    entries = []
    for node, where in family:
        for field, said in fields(node):
            if field not in seen:
                seen.add(field)
                entries.append(f"- `{field}`" + (f": {said}" if said else ""))
        for own in node.body:
            if is_shown(own) and isinstance(own, Function) and own.name not in seen:
                seen.add(own.name)
                kinds = {ast.dump(decorator).split("'")[1] for decorator in own.decorator_list}
                call = "" if "property" in kinds else without_self(where.head(own)).replace("_Own", name)
                said = text(own, "  ")
                entries.append(f"- `{own.name}{call}`" + (f": {said}" if said else ""))
    if entries:
        yield "\n".join(entries) + "\n"


def page() -> str:
    """The whole page."""
    offered = Module("__init__").offered()
    parts = [HEAD]
    for name, prefix in MODULES.items():
        module = MODULE[name]
        names = [own for own in module.offered() if own in offered or prefix != "wl."]
        title, _, rest = text(module.tree).partition("\n")
        if name == "_wedgelab":
            names, title, rest = ["Quantity"], "Quantities", ""
        parts.append(f"## {title.rstrip('.')}\n")
        if rest.strip():
            parts.append(rest.strip() + "\n")
        for own in names:
            functions = [node for node in module.tree.body if isinstance(node, Function) and node.name == own]
            if own in module.classes:
                parts.extend(of_class(own, prefix, module))
            elif functions:
                parts.append(f"### {prefix}{own}\n")
                parts.append(code(f"{own}{module.head(functions[-1])}"))
                parts.append(f"{text(functions[-1])}\n")
            else:
                said = [
                    after.value.value
                    for node, after in zip(module.tree.body, module.tree.body[1:])
                    if isinstance(node, (ast.Assign, ast.AnnAssign))
                    and own in ast.dump(node.targets[0] if isinstance(node, ast.Assign) else node.target)
                    and isinstance(after, ast.Expr)
                    and isinstance(after.value, ast.Constant)
                ]
                parts.append(f"### {prefix}{own}\n")
                parts.extend(f"{cleandoc(str(one))}\n" for one in said)
    return "\n".join(parts)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
