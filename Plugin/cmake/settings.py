# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Makes sources from the table of settings, cuda/optimize/Settings.xml, which says what an entry is.

  python3 settings.py TEMPLATE OUTPUT

writes OUTPUT, if that changes it: TEMPLATE, in which lines with a mark, @limpid_...@, and elements
of the server manager's XML, such as Setting, are replaced by what the table has for them: see MARKS
and ELEMENTS. An extension of several proxies is repeated for each. In a page, what stands between <!-- limpid_... --> and <!-- end --> is replaced, so
that the page is its own template.
"""

import pathlib
import re
import sys
import textwrap
import xml.etree.ElementTree as ElementTree

TABLE = pathlib.Path(__file__).resolve().parents[2] / "cuda/optimize/Settings.xml"

#: Elements of an entry that the server manager does not know, and their attributes.
OWN = {"Class": {"choices", "constants", "range", "set", "unit"},
       "Core": {"member", "valid", "name", "unit", "error"},
       "In": None, "Panel": {"group", "shown_if"}, "Python": {"unit"}}


class Interval:
    """Valid values of a setting: "[0, inf)", of which a bracket belongs and a parenthesis does not."""

    def __init__(self, text):
        found = re.fullmatch(r"([\[(])([-\w.]+), ([-\w.]+)([\])])", text)
        if not found:
            raise ValueError(f'"{text}" is not an interval like "[0, inf)"')
        self.least, self.most = found.group(2, 3)
        self.has_least, self.has_most = found.group(1) == "[", found.group(4) == "]"

    def __str__(self):
        first, last = "[" if self.has_least else "(", "]" if self.has_most else ")"
        return f"{first}{self.least}, {self.most}{last}"

    def is_closed(self):
        """Whether there is a nearest valid value to every number."""
        return self.has_least and (self.has_most or self.most == "inf")

    def advice(self):
        """What to do about a value that is not valid."""
        if self.most == "inf":
            least = "zero" if self.least == "0" else self.least
            return f"Set it to {least} or more." if self.has_least else f"Set it above {least}."
        if self.has_least and self.has_most:
            return f"Set it between {self.least} and {self.most}."
        if self.has_most:
            return f"Set it above {self.least} and at most {self.most}."
        return f"Set it from {self.least} to below {self.most}."


class Setting:
    """An entry of the table."""

    def __init__(self, element, source):
        self.element = element
        self.source = source  #: as it is written
        self.name = element.get("name")

    def of(self, tag):
        """What the entry has for `tag`, as a mapping, with white space as in prose; or nothing."""
        element = self.element.find(tag)
        return {} if element is None else {
            name: " ".join(value.split()) for name, value in element.attrib.items()}

    def of_class(self):
        """Whether vtkVisibilitySettings has it."""
        return self.element.find("Class") is not None

    def text(self, tag):
        return " ".join((self.element.findtext(tag) or "").split())

    @property
    def default(self):
        """A list of texts."""
        return self.element.get("default_values", "").split()

    @property
    def valid(self):
        valid = self.of("Core").get("valid")
        return Interval(valid) if valid else None

    @property
    def unit(self):
        """The unit of a number, or nothing."""
        return self.of("Python").get("unit") or self.of("Class").get("unit", "")

    @property
    def in_python(self):
        """The name in the Python package."""
        return re.sub(r"(?<!^)([A-Z])", r"_\1", self.name).lower()

    def entries(self):
        """Of an enumeration."""
        return self.element.findall("EnumerationDomain/Entry")

    @property
    def constants(self):
        """The names in C++ of what can be chosen, by their values; empty if it is no choice."""
        entries = self.entries()
        names = self.of("Class").get("constants", "").split() or [
            entry.get("text").upper().replace(" ", "_") for entry in entries]
        if len(names) != len(entries):
            raise ValueError(f"{self.name} has {len(names)} constants for {len(entries)} entries")
        return dict(zip([entry.get("value") for entry in entries], names))

    @property
    def type(self):
        """The type in VTK of a value, or of each of several."""
        if self.element.tag == "ProxyProperty":
            return "vtkPiecewiseFunction*"
        if self.element.find("BooleanDomain") is not None:
            return "vtkTypeBool"
        return "int" if self.element.tag.startswith("Int") else "double"

    def shown_if(self):
        return {name: value for name, value in self.of("Panel").items() if name == "shown_if"}

    def in_proxy(self, proxy):
        """What is different in a proxy."""
        for element in self.element.findall("In"):
            if element.get("proxy") == proxy:
                return {name: value for name, value in element.attrib.items() if name != "proxy"}
        return {}

    def property(self):
        """The opening tag and the content of the server manager's property."""
        kind = self.element.tag
        tag, content = re.fullmatch(rf"(<{kind}\b[^>]*>)(.*)</{kind}>", self.source, re.S).groups()
        for own in OWN:
            content = re.sub(rf"\n +<{own}\b([^>]*/>|.*?</{own}>)", "", content, flags=re.S)
        return tag, content


def check(element):
    """Raises ValueError for what an entry cannot have."""
    for tag, known in OWN.items():
        for own in element.findall(tag):
            unknown = set() if known is None else set(own.attrib) - known
            if unknown:
                raise ValueError(f"{element.get('name')}: {tag} has {', '.join(sorted(unknown))} "
                                 f"(it may have {', '.join(sorted(known)) or 'no attributes'})")


def read_table(text=None):
    """All entries in their order."""
    text = text or TABLE.read_text(encoding="utf-8")
    settings = []
    for element in ElementTree.fromstring(text):
        check(element)
        source = re.search(rf'<{element.tag} name="{element.get("name")}".*?</{element.tag}>', text,
                           re.S)
        settings.append(Setting(element, source.group(0)))
    return settings


def core_entry(setting):
    """The call for a setting in ForEachSetting."""
    core = setting.of("Core")
    valid = "Valid()"
    if "valid" in core:
        interval = Interval(core["valid"])
        ends = [end.replace("inf", "infinity") for end in (interval.least, interval.most)]
        unit = f" {core['unit']}" if "unit" in core else ""
        texts = [f'"{text}"' for text in (core["name"], unit, core["error"], interval.advice())]
        has = ["true" if end else "false" for end in (interval.has_least, interval.has_most)]
        valid = f"Valid{{ {', '.join(ends + has + texts)} }}"
    return f"""  visit({valid},
    [](auto& settings) -> auto& {{ return settings.{core["member"]}; }});"""


def core_entries(settings):
    return "\n".join(core_entry(setting) for setting in settings if "member" in setting.of("Core"))


def of_class(settings):
    """Settings that vtkVisibilitySettings has."""
    return [setting for setting in settings if setting.of_class()]


def choices(settings):
    """The enumerations of vtkVisibilitySettings, as lines of a macro."""
    lines = []
    for setting in of_class(settings):
        if setting.constants:
            name = setting.of("Class").get("choices", f"{setting.name}s")
            values = [f"    {constant} = {value}" for value, constant in setting.constants.items()]
            lines += [f"  enum {name}", "  {", *",\n".join(values).split("\n"), "  };"]
    return in_macro(lines)


def default_in_prose(setting):
    """The default as the documentation of a class says it."""
    if setting.type == "vtkTypeBool":
        return "on" if setting.default == ["1"] else "off"
    if not setting.default:
        return "none"
    values = [setting.constants.get(value, value) for value in setting.default]
    return values[0] if len(values) == 1 else f"({', '.join(values)})"


def setter(setting):
    """What defines or declares SetName of a class."""
    name, kind, count = setting.name, setting.type, len(setting.default)
    by_hand = setting.of("Class").get("set")
    valid = setting.valid
    if by_hand:
        lines = [f"virtual void Set{name}({by_hand});"]
        if count > 1:
            each = ", ".join(f"values[{index}]" for index in range(count))
            lines += [f"virtual void Set{name}(const {kind} values[{count}])", "{",
                      f"  this->Set{name}({each});", "}"]
        return lines
    if kind.endswith("*"):
        return [f"virtual void Set{name}({kind});"]
    if count > 1:
        return [f"vtkSetVector{count}Macro({name}, {kind});"]
    if setting.constants:
        ends = list(setting.constants.values())
        return [f"LIMPID_SET_CLAMPED({name}, {kind}, {ends[0]}, {ends[-1]});"]
    if valid and valid.is_closed():
        most = {"int": "VTK_INT_MAX", "double": "VTK_DOUBLE_MAX"}[kind] \
            if valid.most == "inf" else valid.most
        return [f"LIMPID_SET_CLAMPED({name}, {kind}, {valid.least}, {most});"]
    return [f"vtkSetMacro({name}, {kind});"]


def getter(setting):
    """What defines GetName of a class, and for a switch NameOn and NameOff."""
    name, kind, count = setting.name, setting.type, len(setting.default)
    if kind.endswith("*"):
        return [f"vtkGetObjectMacro({name}, {kind[:-1]});"]
    if count > 1:
        return [f"vtkGetVector{count}Macro({name}, {kind});"]
    switch = [f"vtkBooleanMacro({name}, {kind});"] if kind == "vtkTypeBool" else []
    return [f"vtkGetMacro({name}, {kind});", *switch]


def methods(settings):
    """Setters and getters of vtkVisibilitySettings with their documentation."""
    text = ""
    for setting in of_class(settings):
        prose = setting.text("Class")
        if "Default is" not in prose:
            prose += f" Default is {default_in_prose(setting)}."
        comment = textwrap.wrap(prose, 95, break_long_words=False, break_on_hyphens=False)
        text += "\n".join(["  ///@{", "  /**", *[f"   * {line}" for line in comment], "   */",
                           *[f"  {line}" for line in setter(setting) + getter(setting)],
                           "  ///@}", "", ""])
    return text.rstrip()


def members(settings):
    """The members of vtkVisibilitySettings."""
    lines = []
    for setting in of_class(settings):
        values = [setting.constants.get(value, value) for value in setting.default] or ["nullptr"]
        count = f"[{len(values)}]" if len(values) > 1 else ""
        value = f"{{ {', '.join(values)} }}" if len(values) > 1 else values[0]
        lines.append(f"  {setting.type} {setting.name}{count} = {value};")
    return "\n".join(lines)


def forwarding(settings):
    """What owners of settings pass on, as lines of a macro."""
    lines = []
    for setting in of_class(settings):
        count = len(setting.default)
        if setting.type == "vtkTypeBool":
            lines.append(f"  LIMPID_FORWARD_SWITCH({setting.name})")
        else:
            kind = f"VECTOR{count}" if count > 1 else "SETTING"
            lines.append(f"  LIMPID_FORWARD_{kind}({setting.name}, {setting.type})")
    return in_macro(lines)


def every(settings):
    """DO of every setting of vtkVisibilitySettings, as lines of a macro."""
    return in_macro([f"  DO({setting.name})" for setting in of_class(settings)])


def every_of_core(settings):
    """DO of every setting of the core, its name in Python and its member, as lines of a macro."""
    return in_macro([f'  DO({setting.name}, {setting.in_python}, {setting.of("Core")["member"]})'
                     for setting in settings if "member" in setting.of("Core")])


def in_macro(lines):
    return "\n".join(f"{line:<99}\\" for line in lines)


def python_default(setting):
    """The default of the Python package's Settings, as Python has it."""
    defaults = setting.in_proxy("ExtinctionOptimizer").get("default_values", "").split()
    values = defaults or setting.default
    if setting.constants:
        return f'"{python_choice(setting, values[0])}"'
    if len(values) > 1:
        return f"({', '.join(values)})"
    if setting.type == "vtkTypeBool":
        return str(values == ["1"])
    return values[0] if setting.type == "int" or re.search("[.e]", values[0]) else f"{values[0]}.0"


def python_choice(setting, value):
    """What the Python package calls a value of a choice."""
    texts = {entry.get("value"): entry.get("text") for entry in setting.entries()}
    return texts[value].lower().replace(" ", "_")


def python_choices_of(setting):
    """The values of a choice in quotes, with commas between them."""
    return ", ".join(f'"{python_choice(setting, value)}"' for value in setting.constants)


def python_type(setting):
    """The annotation of a field of the Python package's Settings."""
    if setting.constants:
        return f"Literal[{python_choices_of(setting)}]"
    if len(setting.default) > 1:
        return f"tuple[{', '.join([setting.type.replace('double', 'float')] * len(setting.default))}]"
    return {"vtkTypeBool": "bool", "int": "int", "double": "float"}[setting.type]


def python_field(setting):
    """A field of the Python package's Settings."""
    declared = f"    {setting.in_python}: {python_type(setting)}"
    line = f"{declared} = {python_default(setting)}"
    return line if len(line) <= 100 else broken(declared, f" = {python_default(setting)}")


def broken(declared, rest=""):
    """The declaration of a choice on several lines."""
    head, _, choices = declared.partition("Literal[")
    lines = textwrap.wrap(choices[:-1], 100 - 8, break_long_words=False)
    return "\n".join([f"{head}Literal[", *[f"        {line}" for line in lines], f"    ]{rest}"])


def python_item(setting):
    """An item of the mapping of keyword arguments that are settings."""
    line = f"    {setting.in_python}: {python_type(setting)}"
    return line if len(line) <= 100 else broken(line)


def python_parameter(setting):
    """An entry of a numpy-style docstring: name, type and default, then sentences with valid values
    and the unit."""
    kind = f"{{{python_choices_of(setting)}}}" if setting.constants else python_type(setting)
    unit = setting.of("Python").get("unit", "")
    facts = [f"Range {setting.valid}"] if setting.valid else []
    facts += [unit if unit == "dimensionless" else f"unit: {unit}"] if unit else []
    text = setting.text("Python")
    if facts:
        text += f" {', '.join(facts)}."
    prose = textwrap.wrap(text, 92, break_long_words=False, break_on_hyphens=False)
    return "\n".join([f"    {setting.in_python} : {kind}, default {python_default(setting)}",
                      *[f"        {line}" for line in prose]])


def of_python(settings):
    return [setting for setting in settings if setting.text("Python")]


def python_fields(settings):
    """The fields of the Python package's Settings."""
    return "\n".join(map(python_field, of_python(settings)))


def python_items(settings):
    """The items of the mapping of keyword arguments that are settings."""
    return "\n".join(map(python_item, of_python(settings)))


def python_parameters(settings):
    """The section Parameters of the docstring of the Python package's Settings."""
    return "\n".join(map(python_parameter, of_python(settings)))


def python_choices(settings):
    """The enumerations of the extension module for settings that are a choice."""
    return "\n".join(f'    "{setting.in_python}": _core.{setting.name},'
                     for setting in of_python(settings) if setting.constants)


def values_in_prose(setting):
    """The valid values as a page says them."""
    if setting.constants:
        return ", ".join(entry.get("text") for entry in setting.entries())
    if setting.type == "vtkTypeBool":
        return "off, on"
    if not setting.valid:
        return setting.of("Class").get("range", "")
    return f"{len(setting.default)} of {setting.valid}" if len(setting.default) > 1 else \
        str(setting.valid)


def explained(text):
    """The first sentence of a documentation; all of it if that is about one of several values."""
    text = re.sub(r"\s+", " ", text).strip().replace("**", "*")
    return text if text.startswith("*") else \
        re.match(r"(.*?(?<!Eq)(?<!Eqs)\.)( |$)", text).group(1)


def row(*cells):
    """A row of a table."""
    return f"| {' | '.join(cells)} |"


def reference(settings):
    """A table of all settings, for a page."""
    lines = [row("property", "in Python", "unit", "values", "default", "meaning"),
             row(*["---"] * 6)]
    for setting in settings:
        in_python = f"`{setting.in_python}`" if setting.text("Python") else ""
        if not setting.of_class():
            lines.append(row(f"`{setting.name}`", in_python, unit_of(setting.element),
                             values_of(setting.element), default_of(setting.element),
                             explained(setting.text("Documentation"))))
            continue
        shown = {entry.get("value"): entry.get("text") for entry in setting.entries()}
        own = [f", {element.get('proxy')} {element.get('default_values')}"
               for element in setting.element.findall("In") if element.get("default_values")]
        default = " ".join(shown.get(value, value) for value in setting.default) or "none"
        if setting.type == "vtkTypeBool":
            default, own = [re.sub("0$", "off", re.sub("1$", "on", text))
                            for text in (default, "".join(own))]
        lines.append(row(f"`{setting.name}`", in_python, setting.unit, values_in_prose(setting),
                         f"{default}{''.join(own)}", explained(setting.text("Class"))))
    return "\n".join(lines)


#: Units of properties that are numbers, but not dimensionless.
UNITS = {"AvoidanceAngle": "degrees", "CameraDistance": "radius of the volume",
         "CameraFocalPoint": "length", "CameraParallelScale": "length", "CameraPosition": "length",
         "CameraViewAngle": "degrees", "EaseTime": "s", "ElevationRange": "degrees",
         "ExtinctionArray": "1/length", "InteractiveFrameTime": "s", "ReferenceArray": "1/length",
         "SampleDistance": "smallest spacing", "ScalarOpacityUnitDistance": "length",
         "SeparationAngle": "degrees", "SphereRadius": "radius of the volume"}

#: What values the domains of the server manager allow.
DOMAINS = {"BooleanDomain": "off, on", "ArrayListDomain": "an array", "FileListDomain": "a file",
           "RangedTransferFunctionDomain": "a function"}


def domain_of(element):
    return next((domain for domain in element if domain.tag.endswith("Domain")), None)


def unit_of(element):
    """The unit of a property of the server manager."""
    domain = domain_of(element)
    is_number = domain is not None and domain.tag.endswith("RangeDomain")
    return UNITS.get(element.get("name"), "dimensionless" if is_number else "")


def values_of(element):
    """The valid values of a property of the server manager, as a page says them."""
    domain = domain_of(element)
    if domain is None:
        return "a button" if element.tag == "Property" else "a list"
    if domain.tag in DOMAINS:
        return DOMAINS[domain.tag]
    if domain.tag == "EnumerationDomain":  # the first text of each value
        texts = {entry.get("value"): entry.get("text") for entry in reversed(domain)}
        return ", ".join(texts[value] for value in sorted(texts, key=int) if texts[value])
    least, most = (domain.get(end, "").split(" ")[0] for end in ("min", "max"))
    return f"[{least}, {f'{most}]' if most else 'inf)'}" if least else "any"


def default_of(element):
    """The default of a property of the server manager, as a page says it."""
    default = element.get("default_values", "")
    domain = domain_of(element)
    kind = "" if domain is None else domain.tag
    if kind == "ArrayListDomain":
        default = default.split(";")[-1].strip("()").replace("None", "")
    if kind == "BooleanDomain":
        default = {"0": "off", "1": "on"}[default]
    for entry in element.findall("EnumerationDomain/Entry"):
        if entry.get("value") == default:
            default = entry.get("text")
            break
    return default.replace(";", ", ") or "none"


def properties(path, names):
    """Tables of the properties that filters or displays have of their own, from an XML template."""
    lines = []
    for proxy in ElementTree.parse(TABLE.parents[2] / path).getroot().iter():
        own = [element for element in proxy if element.tag.endswith("Property")
               and element.findtext("Documentation") and element.tag != "InputProperty"
               and not element.get("information_only")]
        if own and proxy.tag.endswith("Proxy"):
            name = names.get(proxy.get("name"), proxy.get("label"))
            lines += ["", f"### {name}", "", row("property", "unit", "values", "default", "meaning"),
                      row(*["---"] * 5)]
            lines += [row(f"`{element.get('name')}`", unit_of(element), values_of(element),
                          default_of(element), explained(element.findtext("Documentation")))
                      for element in own]
    return "\n".join(lines[1:])


def properties_of_filters(_):
    return properties("Filters/LimpidFilters.xml.in",
                      {"Scene": "Extinction Optimizer and Viewpoint Search"})


def properties_of_display(_):
    return properties("Representations/LimpidRepresentations.xml.in",
                      {"OptimizedVolumeRepresentation": "Optimized Volume"})


#: What replaces a mark, of all settings.
MARKS = {"choices": choices, "core_entries": core_entries, "every": every,
         "every_of_core": every_of_core, "forwarding": forwarding, "members": members,
         "methods": methods, "python_choices": python_choices, "python_fields": python_fields,
         "properties_of_display": properties_of_display, "properties_of_filters": properties_of_filters,
         "python_items": python_items, "python_parameters": python_parameters,
         "reference": reference}


def attributes_of(use):
    """The attributes of an element as they are written."""
    return dict(re.findall(r'(\w+)="([^"]*)"', use))


def expanded(setting, attributes):
    """The property of an entry for a proxy. Its attributes replace those of the entry; shown_if,
    such as "Method=0", names another property and the value with which this one is shown."""
    tag, content = setting.property()
    for name, value in attributes.items():
        if name == "shown_if":
            other, shown = value.split("=")
            content += ('<Hints><PropertyWidgetDecorator type="GenericDecorator" '
                        f'mode="visibility" property="{other}" value="{shown}"/></Hints>\n')
        else:
            tag = re.sub(rf'\s+{name}="[^"]*"', "", tag)[:-1] + f' {name}="{value}">'
    return f"{tag}{content}</{setting.element.tag}>"


def one(attributes, settings):
    """The property for <Setting name="ViewWeight" proxy="ViewpointSearch" .../>."""
    name, proxy = attributes.pop("name"), attributes.pop("proxy", None)
    for setting in settings:
        if setting.name == name:
            return [expanded(setting, {**attributes, **setting.in_proxy(proxy)})]
    raise ValueError(f"{TABLE.name} has no entry for {name}")


def of_group(group, proxy, settings):
    """The entries of a group that a proxy has, and what is different in it."""
    found = [(setting, setting.in_proxy(proxy)) for setting in settings
             if setting.of("Panel").get("group") == group]
    if not found:
        raise ValueError(f"{TABLE.name} has no entry of the group {group}")
    return [(setting, own) for setting, own in found if "absent" not in own]


def several(attributes, settings):
    """The properties for <Settings group="Views" proxy="ViewpointSearch" .../>."""
    found = of_group(attributes.pop("group"), attributes.pop("proxy"), settings)
    return [expanded(setting, {**attributes, **setting.shown_if(), **own}) for setting, own in found]


def names(attributes, settings):
    """What a panel's group has for <SettingNames group="Views" proxy="ViewpointSearch"/>."""
    return [f'<Property name="{setting.name}"/>'
            for setting, _ in of_group(attributes["group"], attributes["proxy"], settings)]


#: What replaces an element of the server manager's XML.
ELEMENTS = {"Setting": one, "Settings": several, "SettingNames": names}


def repeated(extension):
    """An extension for each of the proxies that it names, <Extension name="A B">: without elements
    that are not for all of them, <Property name="Shade" only="B"/>, where they are not."""
    def of(proxy):
        text = extension.group().replace(f'name="{extension.group(1)}"', f'name="{proxy}"', 1)
        text = re.sub(r'^( *)<(\w+)[^>]* only="([^"]*)"(?:/>|>.*?^\1</\2>)\n',
                      lambda part: part.group() if proxy in part.group(3).split() else "", text,
                      flags=re.M | re.S)
        return re.sub(r'\s+only="[^"]*"', "", text)
    return "".join(of(proxy) for proxy in extension.group(1).split())


def filled(template, settings):
    """The text of a template with all that the table has for it."""
    def with_indent(use):
        indent, kind, attributes = use.groups()
        return "\n".join(indent + text for text in
                         ELEMENTS[kind](attributes_of(attributes), settings))

    template = re.sub(r'^ *<Extension name="([^"]* [^"]*)">.*?</Extension>\n', repeated, template,
                      flags=re.M | re.S)
    text = re.sub(rf"^( *)<({'|'.join(ELEMENTS)})\b([^>]*)/>$", with_indent, template, flags=re.M)
    text = re.sub(r"(?<=^<!-- limpid_)(\w+)( -->\n).*?(?=^<!-- end -->)",
                  lambda mark: f"{mark.group(1)}{mark.group(2)}{MARKS[mark.group(1)](settings)}\n",
                  text, flags=re.M | re.S)
    return re.sub(r"^ *@limpid_(\w+)@$", lambda mark: MARKS[mark.group(1)](settings), text,
                  flags=re.M)


def write(path, text):
    """Writes a file, unless it has this text: what is made of it need not be made again."""
    path = pathlib.Path(path)
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def main(template, output):
    write(output, filled(pathlib.Path(template).read_text(encoding="utf-8"), read_table()))


if __name__ == "__main__":
    main(*sys.argv[1:])
