# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Makes sources from the table of settings, cuda/optimize/Settings.xml, which says what an entry is.

  python3 settings.py TEMPLATE OUTPUT

writes OUTPUT, if that changes it: TEMPLATE, in which lines with a mark, @limpid_...@, and elements
of the server manager's XML, such as Setting, are replaced by what the table has for them: see MARKS
and ELEMENTS.
"""

import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

TABLE = pathlib.Path(__file__).resolve().parents[2] / "cuda/optimize/Settings.xml"

#: Elements of an entry that the server manager does not know.
OWN = ("Core", "In", "Panel")


class Interval:
    """Valid values of a setting: "[0, inf)", of which a bracket belongs and a parenthesis does not."""

    def __init__(self, text):
        found = re.fullmatch(r"([\[(])([-\w.]+), ([-\w.]+)([\])])", text)
        if not found:
            raise ValueError(f'"{text}" is not an interval like "[0, inf)"')
        self.least, self.most = found.group(2, 3)
        self.has_least, self.has_most = found.group(1) == "[", found.group(4) == "]"

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


def read_table():
    """All entries in their order."""
    text = TABLE.read_text(encoding="utf-8")
    settings = []
    for element in ElementTree.fromstring(text):
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


#: What replaces a mark, of all settings.
MARKS = {"core_entries": core_entries}


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
    """The property for <Setting name="ViewWeight" .../>."""
    name = attributes.pop("name")
    for setting in settings:
        if setting.name == name:
            return [expanded(setting, attributes)]
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


def filled(template, settings):
    """The text of a template with all that the table has for it."""
    def with_indent(use):
        indent, kind, attributes = use.groups()
        return "\n".join(indent + text for text in
                         ELEMENTS[kind](attributes_of(attributes), settings))

    text = re.sub(rf"^( *)<({'|'.join(ELEMENTS)})\b([^>]*)/>$", with_indent, template, flags=re.M)
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
