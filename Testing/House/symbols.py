# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Functions, types and members that the product defines and does not use.

    python3 symbols.py

lists them, each with its file and with the folders of tests and documents that use it, if any. A name
counts as used if it stands anywhere in the product but where it is declared or defined: sources are
read as tokens, and names are not resolved. So a name that something else has, too, is not listed.
Classes of VTK and of Qt are left out: users, XML and Qt call those by name.
"""

import collections
import functools
import re

import house

SOURCES = ("*.h", "*.cxx", "*.cu")
PRODUCT = ("cuda", "Filters", "Representations", "Plugin")
TOKEN = re.compile(r"[A-Za-z_]\w*|::|->|&&|\|\||[-+*/%&|^!=<>]=|\d[\w.]*|\S")
SKIPPED = re.compile(r'R"(?P<end>\w*)\(.*?\)(?P=end)"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
DIRECTIVE = re.compile(r"^[ \t]*#(?:\\\n|.)*$", re.MULTILINE)
IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
NOT_A_TYPE = {"return", "throw", "new", "delete", "else", "case", "co_return", "not", "sizeof", "goto",
              "decltype", "noexcept", "if", "while", "for", "switch", "catch"}

Symbol = collections.namedtuple("Symbol", "name path folders")


def tokens_of(text):
    """The tokens of a source, without comments, strings and directives of the preprocessor; and the
    names in what the latter define, which are uses."""
    text = SKIPPED.sub(" ", text)
    macros = " ".join(re.sub(r"^\s*#\s*define\s+\w+(\([^)]*\))?", "", line)
                      for line in DIRECTIVE.findall(text) if re.match(r"\s*#\s*define", line))
    return TOKEN.findall(DIRECTIVE.sub(" ", text)), set(IDENTIFIER.findall(macros))


def without_parameters(statement):
    """A statement without the parameters of the templates that it begins with."""
    while statement[:2] == ["template", "<"]:
        depth = 0
        for end, token in enumerate(statement):
            depth += (token == "<") - (token == ">")
            if token == ">" and depth == 0:
                break
        statement = statement[end + 1:]
    return statement


def classes_of(statement):
    """The name of the class that a statement opens, if it does, and of the classes that this is in. A
    macro may precede them."""
    statement = without_parameters(statement)
    for i, token in enumerate(statement):
        if token in ("class", "struct", "union"):
            head = statement[i + 1:]
            head = head[:head.index(":")] if ":" in head else head
            head = [token for token in head if token != "final"]
            return {name for name, after in zip(head, head[1:] + ["::"]) if after == "::"}
    return set()


def statements(tokens):
    """Tuples of a statement's tokens, whether it stands in the body of a function, and the names of the
    classes whose text it belongs to. A statement ends at a semicolon or at a brace."""
    scopes = [(False, frozenset())]
    statement = []
    for token in tokens:
        if token not in ("{", "}", ";"):
            statement.append(token)
            continue
        in_function, owners = scopes[-1]
        own = owners | classes_of(statement) | (set() if in_function else qualifiers_in(statement))
        yield statement, in_function, own
        if token == "{":
            is_scope = any(word in without_parameters(statement) for word in
                           ("namespace", "class", "struct", "enum", "union", "extern"))
            scopes.append((in_function or not is_scope, own))
        elif token == "}" and len(scopes) > 1:
            scopes.pop()
        statement = []
    yield statement, False, frozenset()


def qualifiers_in(statement):
    """The classes that a statement defines a member of: those in front of the name it declares."""
    found = set()
    for i in declared_in(statement):
        i -= statement[i - 1] == "~"
        while i >= 2 and statement[i - 1] == "::":
            i -= 2
            found.add(statement[i])
    return found


def declared_in(statement):
    """The positions in a statement, which is in no function's body, of the names that it declares."""
    depth = 0
    for i, token in enumerate(statement):
        before = statement[i - 1] if i else ""
        after = statement[i + 1] if i + 1 < len(statement) else ""
        if token in "(=" and token:
            if token == "=" and "operator" not in statement[:i]:
                return
            depth += token == "("
        elif token == ")":
            depth -= 1
        if depth or not IDENTIFIER.fullmatch(token):
            continue
        if before in ("class", "struct", "enum", "union") or (before == "using" and after == "="):
            yield i
        elif after in ("", "=") and (before in (">", "*", "&", "]") or (
                IDENTIFIER.fullmatch(before) and before not in NOT_A_TYPE | {"enum", "using"})):
            yield i
        elif after == "(" and (before in (">", "*", "&", "&&", "::", "~") or (
                IDENTIFIER.fullmatch(before) and before not in NOT_A_TYPE)):
            yield i
            return


def read(text):
    """The names that a source declares or defines, and those that it uses."""
    declared, used = set(), set()
    tokens, in_macros = tokens_of(text)
    used |= in_macros
    for statement, in_function, owners in statements(tokens):
        if statement[:1] == ["friend"]:
            continue
        positions = set() if in_function else set(declared_in(statement))
        for i, token in enumerate(statement):
            if i in positions:
                declared.add(token)
            elif IDENTIFIER.fullmatch(token) and token not in owners:
                used.add(token)
    return declared, used


def is_called_by_name(path):
    return path.name.startswith("vtk") or path.parts[:2] == ("Plugin", "Gui")


@functools.lru_cache
def unused():
    """The symbols, ordered by name."""
    sources = {path: read(house.text(path)) for path in house.files(*SOURCES, under=PRODUCT)}
    used = set().union(*(names for _, names in sources.values()))
    places = {}
    for path, (declared, _) in sources.items():
        if not is_called_by_name(path):
            for name in declared - used:
                places.setdefault(name, path)
    users = collections.defaultdict(set)
    for path in house.files(*SOURCES, under=["Testing", "Documentation"]):
        for name in set(IDENTIFIER.findall(house.text(path))) & places.keys():
            users[name].add(str(path.parent))
    return [Symbol(name, str(path), sorted(users[name])) for name, path in sorted(places.items())]


def main():
    for symbol in unused():
        print(f"{symbol.path}: {symbol.name}: {', '.join(symbol.folders) or 'used nowhere'}")


if __name__ == "__main__":
    main()
