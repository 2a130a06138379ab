# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Documents a VTK class from the comments of its header: its description and its public methods.

  ```{cpp-header} Filters/vtkCameraPath.h
  ```

The header may be a template of the table of settings. VTK's macros are written as the methods that
they declare.
"""

import re
import sys
import textwrap

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

import conf

sys.path.append(str(conf.ROOT / "Plugin" / "cmake"))
import settings  # pylint: disable=wrong-import-position

#: What macros declare; {0} is the first argument and so on.
MACROS = {
    r"vtkSetMacro|vtkSetClampMacro|LIMPID_SET_CLAMPED": "void Set{0}({1} value);",
    r"vtkGetMacro": "{1} Get{0}();",
    r"vtkBooleanMacro": "void {0}On();\nvoid {0}Off();",
    r"vtkSetVector2Macro|LIMPID_SET_CLAMPED_VECTOR2": "void Set{0}({1} first, {1} second);",
    r"vtkSetVector3Macro": "void Set{0}({1} x, {1} y, {1} z);",
    r"vtkSetVector6Macro": "void Set{0}({1} values[6]);",
    r"vtkGetVector\dMacro": "{1}* Get{0}();",
    r"vtkGetObjectMacro": "{1}* Get{0}();",
    r"vtkSetStringMacro|vtkSetFilePathMacro": "void Set{0}(const char* value);",
    r"vtkGetStringMacro|vtkGetFilePathMacro": "const char* Get{0}();",
}

COMMENT = r"/\*\*\n(.*?)\n *\*/"
MEMBER = re.compile(r"^  (?:/\*\*\n(?P<long>.*?)\n   \*/|(?P<short>(?:///(?!@).*\n(?:  (?=///))?)+))\n?"
                    r"(?P<code>.*?)(?=^ *///|^ */\*\*|^\n|\Z)", re.S | re.M)


def header(path):
    text = (conf.ROOT / path).read_text(encoding="utf-8")
    return settings.filled(text, settings.read_table()) if path.endswith(".in") else text


def prose(comment):
    """The text of a comment without its stars."""
    return textwrap.dedent(re.sub(r"^ *(\*|///) ?", "", comment, flags=re.M))


def declared(code):
    """Declarations without bodies, and macros as the methods that they declare."""
    def method(macro):
        arguments = [argument.strip() for argument in macro.group(2).split(",")]
        for names, text in MACROS.items():
            if re.fullmatch(names, macro.group(1)):
                return text.format(*arguments)
        return macro.group()

    code = re.sub(r"\b(\w+)\(([^()]*)\);", method, textwrap.dedent(code).strip())
    return re.sub(r"\s*\{ .* \}$", ";", code, flags=re.M)


def paragraphs(text):
    """Nodes of a text in which what is indented keeps its lines."""
    for part in re.findall(r"(?:^\S.*\n?)+|(?:^ .*\n?)+", text, re.M):
        if part.startswith(" "):
            part = textwrap.dedent(part).rstrip()
            yield nodes.literal_block(part, part, language="none")
        else:
            yield nodes.paragraph("", "", *linked(" ".join(part.split())))


def linked(text):
    """Text with links to the classes of the page."""
    for piece in re.split(r"(\bvtk[A-Z]\w+(?:::\w+)?)", text):
        name = piece.split("::")[0]
        if name in Header.classes:
            yield nodes.reference("", piece, refuri=f"#{name.lower()}", internal=True)
        elif piece:
            yield nodes.Text(piece)


class Header(SphinxDirective):
    """The directive cpp-header."""

    required_arguments = 1

    #: That have headers on the page of VTK classes.
    classes = frozenset(re.findall(r"^## (vtk\w+)$", (conf.ROOT / "Documentation/VtkClasses.md")
                                   .read_text(encoding="utf-8"), re.M))

    def run(self):
        path = self.arguments[0]
        self.env.note_dependency(str(conf.ROOT / path))
        text = header(path)
        about = prose(re.search(COMMENT, text, re.S).group(1))
        brief = re.search(r"@brief +(.*)\n", about).group(1)
        about = re.sub(r"@(class|brief) .*\n", "", about)
        about = re.sub(r"@sa\b", "See also:", about)
        name, bases, body = re.search(
            r"^class \w*EXPORT (\w+)(?: final)?\s+: (.*?)\n\{\npublic:\n(.*?)^(?:protected|private):",
            text, re.S | re.M).groups()
        bases = " ".join(re.sub(r"\bpublic ", "", bases).split())
        described = [nodes.paragraph("", "", nodes.literal("", f"{name} : {bases}"),
                                       nodes.Text(f", in {path.removesuffix('.in')}: {brief}.")),
                       *paragraphs(about.strip())]
        methods = nodes.definition_list()
        for member in MEMBER.finditer(body):
            code = declared(member.group("code"))
            if code:
                methods += method_item(code, prose(member.group("long") or member.group("short")))
        return [*described, *([methods] if methods.children else [])]


def method_item(code, text):
    lines = [nodes.literal("", line, classes=["cpp"]) for line in code.split("\n")]
    term = nodes.term()
    for number, line in enumerate(lines):
        term += [nodes.raw("", "<br/>", format="html")] * (number > 0) + [line]
    return nodes.definition_list_item("", term, nodes.definition("", *paragraphs(text)))


def setup(app):
    app.add_directive("cpp-header", Header)
    return {"parallel_read_safe": True}
